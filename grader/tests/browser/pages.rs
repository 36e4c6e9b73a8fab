//! Report pages of several submissions, written by the real binary. Each submission is graded once.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use grader::handed_out::{HandedOut, LIGHT, RAYS};

/// Unfolds everything on a page. Initially, only the first failed item of each task is unfolded.
pub const OPEN_ALL: &str =
    "for (const details of document.querySelectorAll('details')) details.open = true; 0";

/// The page of a submission where everything is correct.
pub static PERFECT: LazyLock<PathBuf> = LazyLock::new(|| page("perfect", &RAYS, |_| {}));

/// The page of a submission where nothing has been written yet.
pub static STARTER: LazyLock<PathBuf> = LazyLock::new(|| {
    page("starter", &RAYS, |source| {
        copy(&RAYS, RAYS.starter, source);
    })
});

/// The largest page: every quantity in every picture is wrong and differs from pixel to pixel.
pub static NOISY: LazyLock<PathBuf> = LazyLock::new(|| page("noisy", &RAYS, add_noise));

/// The page of a submission that fails in many ways and tries to take over the page.
pub static HOSTILE: LazyLock<PathBuf> = LazyLock::new(|| page("broken", &RAYS, add_hostile_text));

/// The page of a submission to part two with a drawing of each kind.
pub static LIT: LazyLock<PathBuf> = LazyLock::new(|| page("lit", &LIGHT, add_light_mistakes));

/// Returns all five pages.
pub fn all() -> [&'static Path; 5] {
    [&PERFECT, &STARTER, &NOISY, &HOSTILE, &LIT].map(|page| page.as_path())
}

fn add_light_mistakes(source: &Path) {
    let swapped = "sample_cosine_hemisphere(Vec2::new(random.y, random.x))";
    for (file, from, to) in [
        ("material.rs", "sample_cosine_hemisphere(random)", swapped),
        ("material.rs", "incoming.z * FRAC_1_PI", "FRAC_1_PI"),
        (
            "material.rs",
            "-out.x, -out.y, out.z",
            "-out.x, out.y, out.z",
        ),
        ("lights.rs", "target < power", "target > power"),
        ("lights.rs", "share * light.pdf", "light.pdf"),
        ("environment.rs", "(luminance(*pixel) * sine)", "(sine)"),
        ("environment.rs", "1.0 - 2.0 * random.x", "random.x"),
    ] {
        replace(source, file, from, to);
    }
}

fn add_noise(source: &Path) {
    let noise = "(ray.dir.x * 7e4).sin() * (ray.dir.y * 9e4).cos()";
    let distance = format!("distance: t + t * ({noise}).max(0.0),");
    let normal = format!("normal: glam::Vec3::splat({noise}) + ray.dir,");
    let fraction = "(fraction * sensor + (fraction * 5e4).map(f32::sin))";
    let smooth =
        "normal: (w * self.p0.normal + u * self.p1.normal + v * self.p2.normal).normalize(),";
    let [leaf, larger] = [
        "max_leaf_size: max_leaf_size.max(1)",
        "max_leaf_size: 2 * max_leaf_size",
    ];
    replace(source, "camera.rs", "(fraction * sensor)", fraction);
    replace(source, "triangle.rs", "distance: t,", &distance);
    replace(source, "triangle.rs", smooth, &normal);
    replace(source, "sphere.rs", "distance: t,", &distance);
    replace(source, "sphere.rs", "            normal,\n", &normal);
    replace(source, "bvh.rs", leaf, larger);
}

fn add_hostile_text(source: &Path) {
    let attack = r#"</script><script>document.title = \"taken\"</script><img src=x onerror='document.title = 1'>\u{202e}"#;
    let panic = format!(
        "if ray.dir.x > 0.0 {{ println!(\"{attack}\"); panic!(\"{attack}\"); }} Some(Trace {{"
    );
    let exit = "if pixel.x > 3 { std::process::exit(0); } let height =";
    let print = "println!(\"asking {self:?} for {ray:?}\"); let inverse =";
    replace(source, "camera.rs", "let height =", exit);
    replace(source, "triangle.rs", "Some(Trace {", &panic);
    replace(
        source,
        "sphere.rs",
        "ray.dir.length",
        "ray.direction.length",
    );
    replace(source, "bbox.rs", "let inverse =", print);
}

/// Grades a copy of the reference after `prepare` has changed it. Returns the path of the page. The
/// page stays in the target folder until the next run.
fn page(name: &str, handed_out: &HandedOut, prepare: impl FnOnce(&Path)) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("pages")
        .join(name);
    let source = folder.join("alice");
    fs::create_dir_all(&source).unwrap();
    copy(handed_out, handed_out.reference, &source);
    prepare(&source);
    let output = Command::new(env!("CARGO_BIN_EXE_grader"))
        .current_dir(workspace())
        .arg(&source)
        .args(["--assignment", handed_out.assignment.id])
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

/// Copies an assignment's files from a folder in the workspace.
fn copy(handed_out: &HandedOut, from: &str, to: &Path) {
    let from = workspace().join(from);
    let names = handed_out.file_names();
    for file in names.filter(|file| from.join(file).is_file()) {
        fs::copy(from.join(file), to.join(file)).unwrap();
    }
}

/// Replaces text in a file. Panics if the file doesn't contain it.
fn replace(source: &Path, file: &str, from: &str, to: &str) {
    let path = source.join(file);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{file} does not contain {from:?}");
    fs::write(path, text.replace(from, to)).unwrap();
}
