//! Submissions that earn everything, and of which no two are the same.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

const TASK_FILES: [&str; 5] = ["camera.rs", "triangle.rs", "sphere.rs", "bbox.rs", "bvh.rs"];
const GIVEN_FILES: [&str; 2] = ["lib.rs", "primitive.rs"];

/// The reference's files, in a folder of their own.
pub fn submission(root: &Path) -> TempDir {
    let folder = TempDir::new().expect("there is room for a folder");
    copy(root, folder.path());
    folder
}

/// The same for the bare compiler: the probe's way in needs `world`, the floor does not.
pub fn baseline(root: &Path) -> TempDir {
    let folder = submission(root);
    let lib = folder.path().join("lib.rs");
    let text = fs::read_to_string(&lib).expect("it was copied");
    fs::write(&lib, text.replace("pub mod world;\n", "")).expect("it can be written");
    folder
}

/// Puts the reference's files there.
pub fn copy(root: &Path, folder: &Path) {
    for file in TASK_FILES.into_iter().chain(GIVEN_FILES) {
        let source = root.join("reference/src").join(file);
        fs::copy(source, folder.join(file)).expect("the reference is there");
    }
}

/// Really changes the submission: a constant in two hot functions.
pub fn change(root: &Path, folder: &Path, round: usize) {
    for (file, place) in [
        ("sphere.rs", "discriminant < 0.0"),
        ("triangle.rs", "determinant == 0.0"),
    ] {
        let path = root.join("reference/src").join(file);
        let text = fs::read_to_string(path).expect("the reference is there");
        assert!(text.contains(place), "{file} has no {place}");
        let changed = text.replace(place, &format!("{place} || ray.range.max < -{round}.5"));
        fs::write(folder.join(file), changed).expect("it can be written");
    }
}
