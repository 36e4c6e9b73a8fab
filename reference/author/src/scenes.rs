//! The meshes of the folder `scenes`: all ours, made here from formulas and published tables.

mod gyroid;
mod obj;
mod surface_net;
mod teapot;

use crate::generated::Generated;

/// The files in the folder `scenes` that are made.
pub fn generated() -> Vec<Generated> {
    vec![
        Generated::new("scenes/gyroid.obj", gyroid::obj()),
        Generated::new("scenes/teapot.obj", teapot::obj()),
    ]
}
