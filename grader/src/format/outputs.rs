//! Writes the output files. This is the only module of [`format`](crate::format) that accesses
//! files and the environment.

use std::collections::BTreeMap;
use std::env;
use std::path::{Path, PathBuf};

use judging::assignment::{Task, TaskInfo};
use judging::sanitize::sanitize_line;

use crate::error::Error;
use crate::format::{FormatContext, FormatSpec, MethodLocation, OutputSpec, StudentView};
use crate::handed_out::HandedOut;
use crate::machine::files;
use crate::report::atomic_write;
use crate::report::text::HintDetail;
use crate::submission::Submission;

/// The requested output files and the context for rendering them.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    files: Vec<Output>,
    context: FormatContext,
}

/// The output file of one format.
#[derive(Clone, Debug)]
struct Output {
    format: &'static FormatSpec,
    path: PathBuf,
    /// Text that other commands wrote to the file earlier. The output is appended to it.
    existing_text: String,
}

impl Outputs {
    /// Resolves the path of each requested output. A path in the request takes precedence over the
    /// platform's path. If neither path is given, the output goes to a file in `folder`. Fails if
    /// the environment lacks a variable that a format needs.
    pub fn new(
        specs: &[OutputSpec],
        folder: &Path,
        submitted: &Path,
        submission: &Submission,
        hints: HintDetail,
    ) -> Result<Self, Error> {
        let mut outputs = Outputs {
            files: Vec::new(),
            context: FormatContext {
                folder: folder_in_checkout(submitted, &checkout(), submission.handed_out),
                methods: find_methods(submission),
                variables: BTreeMap::new(),
                hints,
            },
        };
        for spec in specs {
            read_variables(spec.format, &mut outputs.context.variables)?;
            outputs.files.push(resolve_output(spec, folder)?);
        }
        Ok(outputs)
    }

    /// Writes each file atomically. `view` is only called if there are files to write.
    pub fn write(&self, view: &dyn Fn() -> StudentView) -> Result<(), Error> {
        if self.is_empty() {
            return Ok(());
        }
        let view = &view();
        for Output {
            format,
            path,
            existing_text,
        } in &self.files
        {
            let Some(render) = format.render else {
                continue;
            };
            let text = format!("{existing_text}{}", render(view, &self.context));
            atomic_write::write(&text, path)?;
        }
        Ok(())
    }

    /// Returns the commands that the requested formats print for the CI runner.
    pub fn runner_commands(&self, view: &StudentView) -> String {
        let files = self.files.iter();
        let commands = files.filter_map(|output| output.format.runner_commands);
        commands.map(|render| render(view, &self.context)).collect()
    }

    /// Returns whether no output was requested.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// Returns the paths of the requested files, except the score file.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        let files = self.files.iter();
        let rendered = files.filter(|output| output.format.render.is_some());
        rendered.map(|output| output.path.as_path())
    }
}

fn resolve_output(spec: &OutputSpec, folder: &Path) -> Result<Output, Error> {
    let format = spec.format;
    let shared = format.shared_file.and_then(env::var_os);
    let shared = shared.filter(|path| !path.is_empty()).map(PathBuf::from);
    let (path, existing_text) = match (&spec.path, shared) {
        (Some(path), _) => (path.clone(), String::new()),
        (None, None) => (folder.join(format.file), String::new()),
        (None, Some(path)) => {
            let existing_text = files::read_if_exists(&path)?.unwrap_or_default();
            (path, existing_text)
        }
    };
    Ok(Output {
        format,
        path,
        existing_text,
    })
}

/// Reads the environment variables that a format needs. Fails if one is missing.
fn read_variables(
    format: &FormatSpec,
    known: &mut BTreeMap<&'static str, String>,
) -> Result<(), Error> {
    for variable in format.variables {
        let value = env::var(variable).ok().filter(|value| !value.is_empty());
        let value = value.ok_or_else(|| {
            Error::User(format!(
                "--format {} needs the environment variable {variable}, which is not set: grade on \
                 the platform's runner, or set {}",
                format.id,
                format.variables.join(", ")
            ))
        })?;
        known.insert(variable, value);
    }
    Ok(())
}

/// Returns the checkout's folder, which is `GITHUB_WORKSPACE` or the current folder.
fn checkout() -> PathBuf {
    let named = env::var_os("GITHUB_WORKSPACE").map(PathBuf::from);
    named.unwrap_or_else(|| env::current_dir().unwrap_or_default())
}

/// Returns the folder of the task files relative to the checkout. The result is empty if the files
/// aren't below the checkout.
fn folder_in_checkout(submitted: &Path, checkout: &Path, handed_out: &HandedOut) -> String {
    let folders = handed_out.folders_in(submitted);
    let below = folders.first();
    let folder = below.and_then(|below| submitted.join(below).canonicalize().ok());
    let relative = folder.and_then(|folder| {
        let relative = folder.strip_prefix(checkout.canonicalize().ok()?).ok()?;
        let relative = relative.to_string_lossy().replace('\\', "/");
        Some(sanitize_line(&relative, usize::MAX))
    });
    relative.unwrap_or_default()
}

/// Finds the method for each task in the submission's files.
fn find_methods(submission: &Submission) -> BTreeMap<Task, MethodLocation> {
    let location = |task: &TaskInfo| {
        let line = submission.task_methods(task).map(|method| method.line);
        let file = task.file;
        (task.task(), MethodLocation { file, line })
    };
    let tasks = submission.handed_out.assignment.tasks.iter();
    tasks.map(location).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::format::tests::sample;
    use crate::handed_out::RAYS;

    /// The folder with the starter's files, relative to the package. Cargo runs the tests in the
    /// package's folder.
    const STARTER: &str = "starter";

    fn outputs(formats: &[&str], folder: &Path) -> Outputs {
        let starter = Path::new(env!("CARGO_MANIFEST_DIR")).join(STARTER);
        let submission = Submission::collect(&starter, &RAYS).unwrap();
        let specs: Vec<_> = formats.iter().map(|text| text.parse().unwrap()).collect();
        let outputs = Outputs::new(
            &specs,
            folder,
            STARTER.as_ref(),
            &submission,
            HintDetail::Nudge,
        );
        outputs.unwrap()
    }

    #[test]
    fn each_format_gets_its_file_in_the_folder_or_at_the_requested_path() {
        let folder = tempfile::tempdir().unwrap();
        let requested = folder.path().join("mine.xml");
        let junit = format!("junit={}", requested.display());
        let outputs = outputs(&["json", "text", &junit], folder.path());
        let paths: Vec<&Path> = outputs.paths().collect();
        assert_eq!(paths, [folder.path().join("report.txt"), requested.clone()]);
        outputs.write(&sample::open).unwrap();
        let text = fs::read_to_string(folder.path().join("report.txt")).unwrap();
        assert!(text.contains("9 / 28"), "{text}");
        assert!(fs::read_to_string(requested).unwrap().starts_with("<?xml"));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn without_outputs_no_view_is_made() {
        let outputs = Outputs::default();
        assert!(outputs.is_empty());
        let view = || panic!("nothing is to be written");
        outputs.write(&view).unwrap();
    }

    #[test]
    fn an_output_follows_the_text_of_earlier_commands() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.txt");
        let mut outputs = outputs(&["text"], folder.path());
        assert!(!outputs.is_empty());
        "before\n".clone_into(&mut outputs.files[0].existing_text);
        outputs.write(&sample::open).unwrap();
        let text = fs::read_to_string(path).unwrap();
        assert!(text.starts_with("before\n\n  ann"), "{text}");
    }

    #[test]
    fn only_some_formats_print_commands() {
        let commands = |formats: &[&str]| {
            let outputs = outputs(formats, "out".as_ref());
            outputs.runner_commands(&sample::open())
        };
        assert_eq!(commands(&["text", "junit"]), "");
        assert!(commands(&["text", "github=out/a.md"]).starts_with("::error file="));
    }

    /// Tests cannot set environment variables, so this test uses a variable that Cargo sets to the
    /// path of a file.
    #[test]
    fn a_file_that_the_platform_names_keeps_its_text() {
        static SHARED: FormatSpec = FormatSpec {
            file: "own.txt",
            shared_file: Some("CARGO_MANIFEST_PATH"),
            ..FormatSpec::EMPTY
        };
        let Some(manifest) = env::var_os("CARGO_MANIFEST_PATH") else {
            return;
        };
        let output = |path: Option<PathBuf>| {
            let format = &SHARED;
            resolve_output(&OutputSpec { format, path }, "out".as_ref()).unwrap()
        };
        let shared = output(None);
        assert_eq!(shared.path, PathBuf::from(manifest));
        assert!(shared.existing_text.contains("name = \"grader\""));
        let requested = output(Some("mine.txt".into()));
        assert_eq!(requested.path, PathBuf::from("mine.txt"));
        assert_eq!(requested.existing_text, "");
    }

    #[test]
    fn a_format_names_a_variable_that_is_not_set() {
        static NEEDS_BOTH: FormatSpec = FormatSpec {
            id: "needy",
            variables: &["CARGO_MANIFEST_DIR", "NO_TEST_SETS_THIS"],
            ..FormatSpec::EMPTY
        };
        let mut known = BTreeMap::new();
        let error = read_variables(&NEEDS_BOTH, &mut known).unwrap_err();
        let expected = "--format needy needs the environment variable NO_TEST_SETS_THIS, which is \
                        not set: grade on the platform's runner, or set CARGO_MANIFEST_DIR, \
                        NO_TEST_SETS_THIS";
        assert_eq!((&*error.to_string(), error.exit_code()), (expected, 2));
        let keys: Vec<&str> = known.into_keys().collect();
        assert_eq!(keys, ["CARGO_MANIFEST_DIR"]);
    }

    #[test]
    fn the_folder_of_the_files_is_relative_to_the_checkout() {
        let checkout = tempfile::tempdir().unwrap();
        let folder_of = |submitted: &str| {
            folder_in_checkout(&checkout.path().join(submitted), checkout.path(), &RAYS)
        };
        // Not all files have to exist.
        fs::create_dir_all(checkout.path().join("a3/src")).unwrap();
        fs::write(checkout.path().join("a3/src/bvh.rs"), "").unwrap();
        assert_eq!(["a3/src", "a3"].map(folder_of), ["a3/src"; 2]);
        fs::write(checkout.path().join("bbox.rs"), "").unwrap();
        assert_eq!(["", "none"].map(folder_of), [""; 2]);
        let elsewhere = checkout.path().join("a3");
        let outside = folder_in_checkout(checkout.path(), &elsewhere, &RAYS);
        assert_eq!(outside, "");
    }

    #[test]
    fn the_checkout_is_the_current_folder_if_no_platform_names_another() {
        let folder = outputs(&[], "out".as_ref()).context.folder;
        // If the tests run on GitHub, the checkout is the whole workspace.
        let current = env::current_dir().unwrap().canonicalize().unwrap();
        let named = env::var_os("GITHUB_WORKSPACE").map(PathBuf::from);
        let is_elsewhere = named.is_some_and(|named| {
            let named = named.canonicalize();
            !named.is_ok_and(|checkout| current.starts_with(checkout))
        });
        assert_eq!(folder.ends_with(STARTER), !is_elsewhere, "{folder}");
        let without_files = folder_in_checkout("tests".as_ref(), &checkout(), &RAYS);
        assert_eq!(without_files, "");
    }
}
