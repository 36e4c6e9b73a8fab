//! Measures how fast and at what cost the viewer draws, for the table in
//! `grader/benches/README.md`.
//!
//! Each round measures every quantity once, so a busy machine affects all of them. Quantities are
//! compared within a round.

#[expect(dead_code, reason = "the tests use more of this module")]
#[path = "../../tests/it/harness.rs"]
mod harness;

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use std::{fs, thread};

use bench_support::{BareRustc, Cost, baseline, change, is_short, median, repetitions};
use grader::workspace::Workspace;
use serde_json::{Value, json};
use tempfile::TempDir;
use test_support::processes::{cpu_time, family, peak_memory};
use test_support::{Chromium, DESKTOP};

use harness::{Submission, Viewer, workspace};

const ROUNDS: usize = 7;
/// The scene whose camera is moved.
const SCENE: &str = "checkered-teapot";
const SIZE: &str = "320x240";
/// The number of samples per pixel for measuring the ray rate.
const SAMPLES: u32 = 128;
/// How long to measure an idle viewer.
const IDLE: Duration = Duration::from_secs(20);
/// How long to measure an idle viewer in the short version of the benchmark.
const BRIEFLY_IDLE: Duration = Duration::from_secs(1);

fn main() {
    moves_and_rays();
    saves();
    idle();
    large_mesh();
}

/// Measures the time from a camera movement to the first picture, and the ray rate compared with
/// that of `cargo render`.
fn moves_and_rays() {
    let arguments = &format!("{SCENE} --size {SIZE} --samples {SAMPLES}");
    let viewer = Viewer::start(&Submission::reference(), arguments);
    let folder = TempDir::new().expect("a folder can be created");
    let mut build = Command::new(env!("CARGO"));
    build.args(["build", "-q", "--package", "reference-light"]);
    if !cfg!(debug_assertions) {
        build.arg("--release");
    }
    let status = build.current_dir(workspace()).status();
    assert!(
        status.is_ok_and(|status| status.success()),
        "{build:?} failed"
    );
    let (mut moves, mut ratios, mut costs) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..repetitions(ROUNDS) {
        let before = viewer.wait_for_picture();
        let start = Instant::now();
        viewer.send(&json!({ "move": { "orbit": [0.1, 0.0] } }));
        viewer.wait_for(|state| state["picture"] != before["picture"]);
        viewer.get("/picture");
        moves.push(1e3 * start.elapsed().as_secs_f64());
        // The scene's own camera produces the same rays as `cargo render`.
        let cpu = cpu_time_of(&viewer);
        viewer.send(&json!("own_camera"));
        let state = viewer.wait_for_picture();
        let cpu = cpu_time_of(&viewer)
            .zip(cpu)
            .map(|(now, before)| now - before);
        let rate = state["rays_per_second"].as_f64().expect("it is a number");
        let mut of_render = 0.0;
        let render = Cost::of(|| of_render = rate_of_render(folder.path()));
        ratios.push(1e-6 * rate / of_render);
        // The pictures are the same, so the ray counts are too.
        costs.extend(cpu.map(|cpu| render.cpu.as_secs_f64() / cpu.as_secs_f64()));
    }
    moves.sort_by(f64::total_cmp);
    let slowest = moves.last().expect("there are rounds");
    print(
        "from a camera move to the first coarse picture",
        &format!("{:.0} ms (slowest {slowest:.0} ms)", median(moves.clone())),
    );
    let ratio = "rays per second, compared with `cargo render`";
    for (quantity, values) in [(ratio, ratios), ("the same, per second of CPU time", costs)] {
        if let Some(least) = values.iter().copied().reduce(f64::min) {
            print(
                quantity,
                &format!("{:.2} (least {least:.2})", median(values)),
            );
        }
    }
}

/// Returns the rate reported by `cargo render`, in millions of rays per second.
fn rate_of_render(folder: &Path) -> f64 {
    let program = Path::new(env!("CARGO_BIN_EXE_view")).with_file_name("reference-light");
    let mut command = Command::new(program);
    command.args([SCENE, "--size", SIZE, "--samples", &SAMPLES.to_string()]);
    command.arg("--out");
    let output = command
        .arg(folder.join("picture.png"))
        .current_dir(workspace())
        .output()
        .expect("the program has been built");
    let text = String::from_utf8_lossy(&output.stdout).into_owned()
        + &String::from_utf8_lossy(&output.stderr);
    let rate = text.split_once(" Mrays/s").map(|(before, _)| before);
    let rate = rate.and_then(|before| before.rsplit(' ').next()?.parse().ok());
    rate.unwrap_or_else(|| panic!("no rate in {text}"))
}

/// Measures the time from saving a file to the first picture.
fn saves() {
    let root = workspace();
    let submission = Submission::reference();
    let arguments = &format!("{SCENE} --size {SIZE} --samples 1");
    let viewer = Viewer::start(&submission, arguments);
    viewer.wait_for_picture();
    let found = Workspace::find().expect("the benchmark runs in the workspace");
    let bare = BareRustc::prepare(&found.cache_folder().join("dependencies"));
    let folder = baseline(&root);
    let (mut times, mut shares) = (Vec::new(), Vec::new());
    for round in 0..repetitions(ROUNDS) {
        change(&root, folder.path(), round);
        let compile = Cost::of_program(&mut bare.compile(folder.path()))
            .wall
            .as_secs_f64();
        let before = viewer.wait_for_picture();
        let start = Instant::now();
        change(&root, submission.path(), round);
        // While the files are being compiled, the old picture is shown in grey.
        viewer.wait_for(|state| state["picture"] != before["picture"] && is_fresh(state));
        viewer.get("/picture");
        let took = start.elapsed().as_secs_f64();
        times.push(took);
        shares.push(took / (1.5 * compile + 0.3));
    }
    print(
        "from a save to the first coarse picture",
        &format!(
            "{:.0} ms; {:.2} of the limit (1.5 F + 0.3 s)",
            1e3 * median(times),
            median(shares)
        ),
    );
}

fn is_fresh(state: &Value) -> bool {
    state["build"] == "ready" && state["is_stale"] == false
}

/// Measures the CPU time that the viewer and its programs use while a page shows a complete
/// picture.
fn idle() {
    let arguments = &format!("{SCENE} --size {SIZE} --samples 4");
    let viewer = Viewer::start(&Submission::reference(), arguments);
    let chromium = Chromium::start();
    let mut tab = chromium.as_ref().map(Chromium::tab);
    if let Some(tab) = &mut tab {
        tab.open_url(
            &format!("http://127.0.0.1:{}{}", viewer.port, viewer.first),
            DESKTOP,
        );
    }
    viewer.wait_for_picture();
    thread::sleep(Duration::from_secs(2));
    let (Some(before), start) = (cpu_time_of(&viewer), Instant::now()) else {
        return print("idle viewer", "not known on this system");
    };
    thread::sleep(if is_short() { BRIEFLY_IDLE } else { IDLE });
    let used = cpu_time_of(&viewer)
        .unwrap_or_default()
        .saturating_sub(before);
    let share = 100.0 * used.as_secs_f64() / start.elapsed().as_secs_f64();
    let page = if tab.is_some() {
        "open in Chromium"
    } else {
        "not open in a browser"
    };
    print(
        "idle viewer",
        &format!("{share:.2}% of a core, page {page}"),
    );
}

/// Measures the memory and time needed to show meshes with a million triangles.
fn large_mesh() {
    let folder = TempDir::new().expect("a folder can be created");
    let scenes = workspace().join("scenes");
    let text = fs::read_to_string(scenes.join("checkered-teapot.json")).expect("the scene exists");
    let mut scene: Value = serde_json::from_str(&text).expect("the scene is valid");
    let shapes = scene["shapes"].as_array_mut().expect("shapes are a list");
    let mut teapot = shapes[0].clone();
    for number in 1..256 {
        teapot["mesh"]["translate"] = json!([number % 16, 0, number / 16]);
        shapes.push(teapot.clone());
    }
    let path = folder.path().join("large.json");
    fs::write(&path, scene.to_string()).expect("the scene can be written");
    fs::copy(scenes.join("teapot.obj"), folder.path().join("teapot.obj")).expect("the mesh exists");
    let path = path.to_str().expect("the path is text");
    let start = Instant::now();
    let viewer = Viewer::start(
        &Submission::reference(),
        &format!("{path} --size {SIZE} --samples 1"),
    );
    viewer.wait_for_picture();
    let first = start.elapsed().as_secs_f64();
    viewer.explain([160, 120], None);
    let state = viewer.wait_for(|state| state["has_tree"] == true);
    viewer.get("/tree");
    let mib = |process| {
        peak_memory(process).map_or("unknown".to_owned(), |bytes| (bytes >> 20).to_string())
    };
    let programs: Vec<String> = family(viewer.process())
        .into_iter()
        .skip(1)
        .map(mib)
        .collect();
    print(
        "meshes of a million triangles",
        &format!(
            "picture after {first:.1} s; at most {} MiB in the viewer and {} MiB in its programs ({} of which draw)",
            mib(viewer.process()),
            programs.join(", "),
            state["programs"]
        ),
    );
}

/// Returns the CPU time used by a viewer and its programs.
fn cpu_time_of(viewer: &Viewer) -> Option<Duration> {
    family(viewer.process()).into_iter().map(cpu_time).sum()
}

fn print(quantity: &str, result: &str) {
    println!("{quantity:48}{result}");
}
