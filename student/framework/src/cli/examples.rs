//! The command that runs the worked examples in the task files. They are tests, so that an editor
//! can run them, too; but cargo takes a name that no test has as a success.

use std::collections::BTreeSet;
use std::env;
use std::io;
use std::process::{Command, ExitCode, Output, Stdio};

use crate::suggestion::suggestion;

/// Runs the examples whose paths contain one of the names on the command line, or all of them.
/// Flags are passed to the test harness. Exit codes: 2 if no example has such a name, else cargo's.
pub fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match run(&arguments) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("cannot run cargo: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &[String]) -> io::Result<ExitCode> {
    let list = cargo_test()
        .arg("--list")
        .stderr(Stdio::inherit())
        .output()?;
    if !list.status.success() {
        return Ok(exit_code(list.status.code()));
    }
    let known = example_paths(&list);
    let mut names = arguments.iter().filter(|name| !name.starts_with('-'));
    if let Some(message) = names.find_map(|name| unknown_name(name, &known)) {
        eprintln!("{message}");
        return Ok(ExitCode::from(2));
    }
    let status = cargo_test()
        .arg("--include-ignored")
        .args(arguments)
        .status()?;
    Ok(exit_code(status.code()))
}

/// Returns the command up to the arguments of the test harness. It uses the release profile, so
/// that it shares compiled dependencies with `cargo render`.
fn cargo_test() -> Command {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["test", "-q", "--release", "-p", "student", "--lib", "--"]);
    command
}

/// Returns the paths of the examples, such as `sphere::tests::from_outside`.
fn example_paths(list: &Output) -> Vec<String> {
    let list = String::from_utf8_lossy(&list.stdout);
    let paths = list.lines().filter_map(|line| line.strip_suffix(": test"));
    paths.map(str::to_owned).collect()
}

/// Returns a message if no example's path contains the name.
fn unknown_name(name: &str, known: &[String]) -> Option<String> {
    if known.iter().any(|path| path.contains(name)) {
        return None;
    }
    let files = known.iter().filter_map(|path| path.split("::").next());
    let files: Vec<&str> = BTreeSet::from_iter(files).into_iter().collect();
    Some(format!(
        "no example is called `{name}`{}; there are examples in: {}",
        suggestion(name, &files),
        files.join(", ")
    ))
}

fn exit_code(code: Option<i32>) -> ExitCode {
    ExitCode::from(code.and_then(|code| u8::try_from(code).ok()).unwrap_or(1))
}

#[cfg(test)]
mod tests {
    use super::unknown_name;

    #[test]
    fn names_the_files_with_examples_if_no_example_has_the_name() {
        let known = ["bvh::tests::a_row", "sphere::tests::from_outside"].map(str::to_owned);
        for name in ["sphere", "from_outside", "bvh::"] {
            assert_eq!(unknown_name(name, &known), None);
        }
        assert_eq!(
            unknown_name("sphre", &known).as_deref(),
            Some(
                "no example is called `sphre` (did you mean sphere?); there are examples in: bvh, \
                 sphere"
            )
        );
    }
}
