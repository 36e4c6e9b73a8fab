//! Renders nothing: a toy has no pictures.

fn main() {}
