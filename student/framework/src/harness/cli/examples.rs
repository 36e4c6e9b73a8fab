//! The command that runs the worked examples in the task files. They are tests, so that an editor
//! can run them too. However, `cargo test` succeeds even if no test matches the given name.

use std::collections::BTreeSet;
use std::env;
use std::io;
use std::path::Path;
use std::process::{Command, ExitCode, Output, Stdio};
use std::time::Duration;

use clap::Parser;

use crate::harness::cli::progress::Notice;
use crate::suggestion::suggestion;

/// The time after which a student should be told that an example is still running.
const LONG: Duration = Duration::from_secs(5);

/// Runs the worked examples in your task files
///
/// Exit codes: 0 all examples pass; 101 an example fails, or a file does not compile; 2 no example
/// matches the name.
#[derive(Clone, Debug, Parser)]
#[command(name = "cargo examples", bin_name = "cargo examples")]
struct Arguments {
    /// A file or task, such as `sphere`, or part of an example's name; default: all examples
    #[arg(value_name = "NAME")]
    names: Vec<String>,

    /// Show what your code prints, even if the example passes
    #[arg(long)]
    nocapture: bool,
}

/// Runs all examples, or only those that are in a specified file or whose paths contain a specified
/// name. The exit code is 2 if a name matches no example. Otherwise, it is cargo's exit code.
pub fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("cannot run cargo: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> io::Result<ExitCode> {
    let packages = packages(&arguments.names);
    let list = cargo_test(&packages)
        .arg("--list")
        .stderr(Stdio::inherit())
        .output()?;
    if !list.status.success() {
        return Ok(exit_code(list.status.code()));
    }
    let known = example_paths(&list);
    let names = || arguments.names.iter().map(|name| file_of_task(name));
    if let Some(message) = names().find_map(|name| unknown_name(name, &known)) {
        eprintln!("{message}");
        return Ok(ExitCode::from(2));
    }
    let names = names().map(|name| filter(name, &known));
    let notice = Notice::after(
        LONG,
        "still running: an example that isn't listed above may be in an infinite loop (press \
         Ctrl-C to stop it)"
            .to_owned(),
    );
    let status = cargo_test(&packages)
        .args(["--include-ignored", "--format", "pretty"])
        .args(arguments.nocapture.then_some("--nocapture"))
        .args(names)
        .status()?;
    drop(notice);
    Ok(exit_code(status.code()))
}

/// Returns the cargo command, to which arguments for the test harness can be appended. The command
/// uses the release profile, so that it shares compiled dependencies with `cargo render`.
fn cargo_test(packages: &[&str]) -> Command {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["test", "-q", "--release", "--lib"]);
    command.args(packages.iter().flat_map(|package| ["-p", package]));
    command.arg("--");
    command
}

/// The packages with examples, and the folders of their sources, relative to this package.
const PACKAGES: [(&str, &str); 2] = [("student", "../src"), ("light", "../light/src")];

/// Returns the packages to test: those that contain the named files, or all packages if a name
/// isn't the name of a file. This way, a part that doesn't compile yet doesn't keep the other
/// part's examples from running.
fn packages(names: &[String]) -> Vec<&'static str> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let has = |sources: &str, name: &String| {
        let file = format!("{}.rs", file_of_task(name));
        folder.join(sources).join(file).is_file()
    };
    let is_file = |name: &String| PACKAGES.iter().any(|(_, sources)| has(sources, name));
    let are_files = !names.is_empty() && names.iter().all(is_file);
    let of_names = PACKAGES
        .into_iter()
        .filter(|(_, sources)| !are_files || names.iter().any(|name| has(sources, name)));
    of_names.map(|(package, _)| package).collect()
}

/// Returns the paths of the examples, such as `sphere::tests::from_outside`.
fn example_paths(list: &Output) -> Vec<String> {
    let list = String::from_utf8_lossy(&list.stdout);
    let paths = list.lines().filter_map(|line| line.strip_suffix(": test"));
    paths.map(str::to_owned).collect()
}

/// Returns a name without `.rs`. If it is the name of a task and the task's file has a different
/// name, returns the file's name.
fn file_of_task(name: &str) -> &str {
    match name.trim_end_matches(".rs") {
        "build" | "traverse" => "bvh",
        "lambertian" | "specular" => "material",
        name => name,
    }
}

/// Returns the harness's filter for a name. A file's name selects the examples in that file, but
/// not examples in other files whose names contain that name.
fn filter(name: &str, known: &[String]) -> String {
    let of_file = format!("{name}::");
    let is_file = known.iter().any(|path| path.starts_with(&of_file));
    if is_file { of_file } else { name.to_owned() }
}

/// Returns a message if no example's path contains the name.
fn unknown_name(name: &str, known: &[String]) -> Option<String> {
    if known.iter().any(|path| path.contains(name)) {
        return None;
    }
    let files = known.iter().filter_map(|path| path.split("::").next());
    let files: Vec<&str> = BTreeSet::from_iter(files).into_iter().collect();
    Some(format!(
        "no example matches `{name}`{}; there are examples in: {}",
        suggestion(name, &files),
        files.join(", ")
    ))
}

fn exit_code(code: Option<i32>) -> ExitCode {
    ExitCode::from(code.and_then(|code| u8::try_from(code).ok()).unwrap_or(1))
}

#[cfg(test)]
mod tests {
    use super::{filter, packages, unknown_name};

    #[test]
    fn a_file_selects_the_package_that_it_is_in() {
        let of =
            |names: &[&str]| packages(&names.iter().map(ToString::to_string).collect::<Vec<_>>());
        assert_eq!(of(&["sphere", "traverse"]), ["student"]);
        assert_eq!(of(&["specular"]), ["light"]);
        assert_eq!(of(&["sphere", "lights.rs"]), ["student", "light"]);
        assert_eq!(of(&["sphere", "from_outside"]), ["student", "light"]);
        assert_eq!(of(&[]), ["student", "light"]);
    }

    #[test]
    fn a_files_name_means_the_examples_in_it() {
        let known = [
            "bvh::tests::a_sphere_is_found",
            "sphere::tests::from_outside",
        ];
        let known = known.map(str::to_owned);
        assert_eq!(filter("sphere", &known), "sphere::");
        assert_eq!(filter("from_outside", &known), "from_outside");
    }

    #[test]
    fn names_the_files_with_examples_if_no_example_has_the_name() {
        let known = ["bvh::tests::a_row", "sphere::tests::from_outside"].map(str::to_owned);
        for name in ["sphere", "from_outside", "bvh::"] {
            assert_eq!(unknown_name(name, &known), None);
        }
        assert_eq!(
            unknown_name("sphre", &known).as_deref(),
            Some(
                "no example matches `sphre` (did you mean sphere?); there are examples in: bvh, \
                 sphere"
            )
        );
    }
}
