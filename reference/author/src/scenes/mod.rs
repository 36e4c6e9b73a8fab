//! The meshes in the folder `scenes`, generated from formulas and published tables.

mod gyroid;
mod obj;
mod surface_net;
mod teapot;

use crate::generated_file::GeneratedFile;

/// Returns the generated files of the folder `scenes`.
pub fn generated_files() -> Vec<GeneratedFile> {
    vec![
        GeneratedFile::new("scenes/gyroid.obj", gyroid::obj()),
        GeneratedFile::new("scenes/teapot.obj", teapot::obj()),
    ]
}
