//! The trial of Gradescope's zip: set up and run as the platform does it, on a root of its own,
//! without a network.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use grader::given::TASK_FILES;
use serde::Deserialize;
use zip::ZipArchive;

use crate::package::trial::{NotTried, at};

/// Where it is tried, from the workspace's root.
const PLACE: &str = "target/package/gradescope";
/// How a machine like the platform's is entered.
const ENTER: &str = include_str!("../own/gradescope/trial.sh");
/// What it has for itself.
const NAMESPACES: [&str; 4] = ["--mount", "--net", "--pid", "--fork"];
/// Half of the platform's ten minutes, at half of a core.
const LONGEST: Duration = Duration::from_secs(150);
/// What Gradescope lays beside a submission; none of it changes a score.
const METADATA: &str = r#"{"id": 1, "created_at": "2026-11-20T21:09:58.000000-08:00", "users": [],
"assignment": {"due_date": "2026-11-21T00:00:00.000000-08:00", "total_points": "100.0"},
"submission_method": "upload", "previous_submissions": []}"#;

/// What is read of `results.json`.
#[derive(Deserialize)]
struct Results {
    score: u32,
    output: String,
    #[serde(default)]
    tests: Vec<Test>,
}

#[derive(Deserialize)]
struct Test {
    max_score: u32,
}

/// A machine like the platform's.
struct Machine {
    root: PathBuf,
    toolchain: PathBuf,
}

/// Tries the zip, and tells what is not as it should be.
pub fn check(workspace: &Path, zip: &Path) -> Result<Vec<String>, NotTried> {
    if !can_enter() {
        eprintln!("SKIPPED: the zip is tried as root only, on Linux with namespaces");
        return Ok(Vec::new());
    }
    let workspace = &workspace.canonicalize().map_err(at(workspace))?;
    let machine = Machine::lay_out(&workspace.join(PLACE), zip)?;
    let mut complaints = Vec::new();
    let (is_in_order, said) = machine.run("/autograder/source/setup.sh")?;
    if !is_in_order {
        return Ok(vec![format!("setup.sh failed:\n{said}")]);
    }
    let trials = [
        ("the reference", Some("reference/src"), 100),
        ("the starter", Some("grader/starter"), 0),
        ("an empty submission", None, 0),
    ];
    for (whose, files, points) in trials {
        machine.submit(files.map(|files| workspace.join(files)).as_deref())?;
        let began = Instant::now();
        let (is_in_order, said) = machine.run("/autograder/run_autograder")?;
        let took = began.elapsed();
        println!("{:6.1} s  {whose}", took.as_secs_f64());
        match machine.results() {
            Some(results) if is_in_order && results.fits(points, files.is_some()) => {}
            Some(results) => complaints.push(format!(
                "{whose} has {} points and should have {points}: {}\n{said}",
                results.score, results.output
            )),
            None => complaints.push(format!("{whose} has no results.json:\n{said}")),
        }
        if took > LONGEST {
            complaints.push(format!("{whose} took {took:.0?}, and may take {LONGEST:?}"));
        }
    }
    Ok(complaints)
}

impl Results {
    fn fits(&self, points: u32, has_tests: bool) -> bool {
        let max: u32 = self.tests.iter().map(|test| test.max_score).sum();
        self.score == points && max == if has_tests { 100 } else { 0 }
    }
}

/// Whether this system gives us a machine of our own.
fn can_enter() -> bool {
    let mut unshare = Command::new("unshare");
    let tried = unshare.args(NAMESPACES).arg("true").output();
    tried.is_ok_and(|output| output.status.success())
}

impl Machine {
    /// As when the zip was uploaded.
    fn lay_out(root: &Path, zip: &Path) -> Result<Self, NotTried> {
        let cargo = env::var_os("CARGO").ok_or(NotTried::NoCargo)?;
        let toolchain = Path::new(&cargo).parent().and_then(Path::parent);
        let toolchain = toolchain.ok_or(NotTried::NoCargo)?.to_owned();
        if root.exists() {
            fs::remove_dir_all(root).map_err(at(root))?;
        }
        let autograder = root.join("autograder");
        let source = autograder.join("source");
        fs::create_dir_all(&source).map_err(at(&source))?;
        let file = fs::File::open(zip).map_err(at(zip))?;
        ZipArchive::new(file)?.extract(&source)?;
        let entry = autograder.join("run_autograder");
        fs::copy(source.join("run_autograder"), &entry).map_err(at(&entry))?;
        let metadata = autograder.join("submission_metadata.json");
        fs::write(&metadata, METADATA).map_err(at(&metadata))?;
        Ok(Machine {
            root: root.to_owned(),
            toolchain,
        })
    }

    /// Lays a submission there, or an empty one, and takes the last one's results away.
    fn submit(&self, files: Option<&Path>) -> Result<(), NotTried> {
        for folder in ["autograder/submission", "autograder/results"] {
            let folder = self.root.join(folder);
            if folder.exists() {
                fs::remove_dir_all(&folder).map_err(at(&folder))?;
            }
            fs::create_dir_all(&folder).map_err(at(&folder))?;
        }
        let submission = self.root.join("autograder/submission");
        for file in TASK_FILES.iter().filter(|_| files.is_some()) {
            let from = files.unwrap_or(&submission).join(file.name);
            fs::copy(&from, submission.join(file.name)).map_err(at(&from))?;
        }
        Ok(())
    }

    /// Runs a script there, and tells whether it ended well and what it said.
    fn run(&self, script: &str) -> Result<(bool, String), NotTried> {
        let output = Command::new("unshare")
            .args([
                "--mount", "--net", "--pid", "--fork", "sh", "-c", ENTER, "sh",
            ])
            .args([&self.root, &self.toolchain])
            .arg(script)
            .output()
            .map_err(at(Path::new("unshare")))?;
        let said = [output.stdout, output.stderr].concat();
        Ok((
            output.status.success(),
            String::from_utf8_lossy(&said).into_owned(),
        ))
    }

    fn results(&self) -> Option<Results> {
        let results = self.root.join("autograder/results/results.json");
        serde_json::from_slice(&fs::read(results).ok()?).ok()
    }
}
