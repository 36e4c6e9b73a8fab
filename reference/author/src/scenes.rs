//! The meshes of the folder `scenes`: all ours, made here from formulas and published tables.

mod gyroid;
mod obj;
mod surface_net;
mod teapot;

use crate::generated_file::GeneratedFile;

/// The files in the folder `scenes` that are made.
pub fn generated_files() -> Vec<GeneratedFile> {
    vec![
        GeneratedFile::new("scenes/gyroid.obj", gyroid::obj()),
        GeneratedFile::new("scenes/teapot.obj", teapot::obj()),
    ]
}
