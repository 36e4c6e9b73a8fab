//! Writes all that is generated.
fn main() {}
