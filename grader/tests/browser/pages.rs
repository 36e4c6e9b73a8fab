//! Pages of several submissions, as the real binary writes them, each graded once.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

const TASK_FILES: [&str; 5] = ["camera.rs", "triangle.rs", "sphere.rs", "bbox.rs", "bvh.rs"];

/// All is right.
pub static PERFECT: LazyLock<PathBuf> = LazyLock::new(|| page("perfect", |_| {}));

/// Nothing is written yet.
pub static STARTER: LazyLock<PathBuf> = LazyLock::new(|| {
    page("starter", |source| {
        copy(&workspace().join("grader/starter"), source);
    })
});

/// Every picture is wrong, in all that it is judged by and nowhere the same: the largest page.
pub static NOISY: LazyLock<PathBuf> = LazyLock::new(|| page("noisy", add_noise));

/// Fails in many ways, and would take the page over if it could.
pub static HOSTILE: LazyLock<PathBuf> = LazyLock::new(|| page("broken", add_hostile_text));

/// All four.
pub fn all() -> [&'static Path; 4] {
    [&PERFECT, &STARTER, &NOISY, &HOSTILE].map(|page| page.as_path())
}

fn add_noise(source: &Path) {
    let noise = "(ray.dir.x * 7e4).sin() * (ray.dir.y * 9e4).cos()";
    let distance = format!("distance: t + t * ({noise}).max(0.0),");
    let normal = format!("normal: glam::Vec3::splat({noise}) + ray.dir,");
    let place = "(place * sensor + (place * 5e4).map(f32::sin))";
    let smooth =
        "normal: (w * self.p0.normal + u * self.p1.normal + v * self.p2.normal).normalize(),";
    let [leaf, larger] = [
        "max_leaf_size: max_leaf_size.max(1)",
        "max_leaf_size: 2 * max_leaf_size",
    ];
    replace(source, "camera.rs", "(place * sensor)", place);
    replace(source, "triangle.rs", "distance: t,", &distance);
    replace(source, "triangle.rs", smooth, &normal);
    replace(source, "sphere.rs", "distance: t,", &distance);
    replace(source, "sphere.rs", "            normal,\n", &normal);
    replace(source, "bvh.rs", leaf, larger);
}

fn add_hostile_text(source: &Path) {
    let words = r#"</script><script>document.title = \"taken\"</script><img src=x onerror='document.title = 1'>\u{202e}"#;
    let panic = format!(
        "if ray.dir.x > 0.0 {{ println!(\"{words}\"); panic!(\"{words}\"); }} Some(Trace {{"
    );
    for case in ["exiting", "not_compiling", "printing"] {
        copy(
            &workspace().join("grader/tests/submissions").join(case),
            source,
        );
    }
    replace(source, "triangle.rs", "Some(Trace {", &panic);
}

/// The page of the reference, changed. It stays in the target folder until the next run.
fn page(name: &str, prepare: impl FnOnce(&Path)) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("pages")
        .join(name);
    let source = folder.join("alice");
    fs::create_dir_all(&source).unwrap();
    copy(&workspace().join("reference/src"), &source);
    prepare(&source);
    let output = Command::new(env!("CARGO_BIN_EXE_grader"))
        .current_dir(workspace())
        .arg(&source)
        .arg("--out")
        .arg(&folder)
        .output()
        .unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    folder.join("report.html")
}

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn copy(from: &Path, to: &Path) {
    for file in TASK_FILES.iter().filter(|file| from.join(file).is_file()) {
        fs::copy(from.join(file), to.join(file)).unwrap();
    }
}

/// Replaces text that must be there.
fn replace(source: &Path, file: &str, from: &str, to: &str) {
    let path = source.join(file);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{file} has no {from:?} any more");
    fs::write(path, text.replace(from, to)).unwrap();
}
