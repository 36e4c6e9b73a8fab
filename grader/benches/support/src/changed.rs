//! Creates submissions that earn all points and differ from each other.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

/// Returns a new folder with the reference's files.
pub fn submission(root: &Path) -> TempDir {
    let folder = TempDir::new().expect("a folder can be created");
    copy(root, folder.path());
    folder
}

/// Returns a new folder with the reference's files, for bare compiler calls. Its `lib.rs` lacks the
/// module `world`, which only the probe needs.
pub fn baseline(root: &Path) -> TempDir {
    let folder = submission(root);
    let lib = folder.path().join("lib.rs");
    let text = fs::read_to_string(&lib).expect("the file was copied");
    fs::write(&lib, text.replace("pub mod world;\n", "")).expect("the file can be written");
    folder
}

/// Copies the reference's files to a folder.
pub fn copy(root: &Path, folder: &Path) {
    let files = fs::read_dir(root.join("reference/src")).expect("there is a reference");
    for file in files.flatten() {
        fs::copy(file.path(), folder.join(file.file_name())).expect("the reference can be read");
    }
}

/// Changes a constant in two hot functions of the submission, so that nothing can be reused.
pub fn change(root: &Path, folder: &Path, round: usize) {
    for (file, text_to_change) in [
        ("sphere.rs", "discriminant < 0.0"),
        ("triangle.rs", "determinant == 0.0"),
    ] {
        let path = root.join("reference/src").join(file);
        let text = fs::read_to_string(path).expect("the reference can be read");
        assert!(
            text.contains(text_to_change),
            "{file} has no {text_to_change}"
        );
        let changed = text.replace(
            text_to_change,
            &format!("{text_to_change} || ray.range.max < -{round}.5"),
        );
        fs::write(folder.join(file), changed).expect("the file can be written");
    }
}
