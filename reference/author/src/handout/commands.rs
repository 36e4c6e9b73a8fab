//! Checks the handout's commands against the definitions of the command lines.

use std::collections::BTreeSet;

use clap::{Args, CommandFactory, Parser};
use class::cli::{ClassArguments, Cli as ClassCli};
use grader::cli::Arguments;
use grader::hand_in::HandInArguments;
use grader::handed_out::ASSIGNMENTS;

use super::SourceFile;
use super::pages::{Page, Snippet};
use crate::cli::Cli;

/// The files that define the options of `cargo render` and `cargo view`. Each option is a field of
/// a struct. The files are read as text, because the crates aren't linked here.
const OPTIONS: [&str; 2] = [
    "student/framework/src/harness/cli/options.rs",
    "grader/view/src/cli.rs",
];
/// The flags of `cargo examples`. The code that parses them isn't linked here.
const EXAMPLES_FLAGS: [&str; 1] = ["--nocapture"];
/// Commands in the handout that run other programs.
pub(super) const OTHER_COMMANDS: [&str; 10] = [
    "rustc",
    "rustup",
    "git",
    "cd",
    "unzip",
    "gcc",
    "xcode-select",
    "wsl",
    "sudo",
    "explorer.exe",
];

/// Returns the unknown commands, flags and arguments on a page, each with its line number.
/// `aliases` are the cargo aliases of this repository.
pub fn unknown_commands(
    page: &Page,
    sources: &[SourceFile],
    aliases: &BTreeSet<String>,
) -> Vec<String> {
    let inline = page.inline_code.iter().filter(|code| {
        let text = code.text.as_str();
        text.starts_with("cargo ") || text.starts_with("rustup ") || text.starts_with("--")
    });
    let all = page.commands.iter().chain(inline);
    let problem = |snippet: &Snippet| match snippet.text.strip_prefix("--") {
        Some(_) => unknown_flag(&snippet.text, sources),
        None => unknown_command(&snippet.text, sources, aliases),
    };
    all.filter_map(|snippet| Some(page.problem(snippet, &problem(snippet)?)))
        .collect()
}

fn unknown_command(
    text: &str,
    sources: &[SourceFile],
    aliases: &BTreeSet<String>,
) -> Option<String> {
    // A redirection with `>` isn't part of the command.
    let words = text.split_whitespace().take_while(|word| *word != ">");
    let words: Vec<&str> = words.collect();
    let (cargo, rest) = words.split_first()?;
    if *cargo != "cargo" {
        let known = OTHER_COMMANDS.contains(cargo);
        return (!known).then(|| format!("unknown command {cargo}"));
    }
    let (command, arguments) = rest.split_first()?;
    let own = ["install", "test", "build"].contains(command) || aliases.contains(*command);
    if !own {
        return Some(format!("cargo has no command {command}"));
    }
    // Replace placeholders with valid values so that clap accepts them.
    let arguments = arguments.iter().map(|word| match *word {
        "ITEM#N" | "ITEM#NUMBER" => "sphere.from_inside#7",
        "N" => "60",
        other => other,
    });
    let line: Vec<&str> = [*command].into_iter().chain(arguments).collect();
    let message = |error: clap::Error| error.use_stderr().then(|| error.to_string());
    let message = match *command {
        "grade" => Arguments::try_parse_from(&line).map_or_else(message, |arguments| {
            let error = arguments.resolve().err()?;
            Some(format!("error: {error}"))
        }),
        "handin" => HandInArguments::try_parse_from(&line)
            .err()
            .and_then(message),
        "author" => Cli::try_parse_from(&line).err().and_then(message),
        "class" => ClassCli::try_parse_from(&line).err().and_then(message),
        "render" | "render-reference" | "view" => {
            let mut flags = line.iter().filter(|word| word.starts_with("--"));
            return flags.find_map(|flag| unknown_flag(flag, sources));
        }
        "examples" => return unknown_example(&line[1..], sources),
        _ => None,
    }?;
    let first = message.lines().next().unwrap_or_default();
    Some(format!("`{text}`: {first}"))
}

/// Returns a problem if no command accepts the flag.
fn unknown_flag(text: &str, sources: &[SourceFile]) -> Option<String> {
    let flag = text.split([' ', '=']).next().unwrap_or(text);
    let name = flag.trim_start_matches('-');
    let mut commands = vec![
        Arguments::command(),
        HandInArguments::command(),
        ClassArguments::augment_args(clap::Command::default()),
    ];
    commands.extend(Cli::command().get_subcommands().cloned());
    let mut arguments = commands.iter().flat_map(clap::Command::get_arguments);
    let field = format!(" {}:", name.replace('-', "_"));
    let is_known = EXAMPLES_FLAGS.contains(&flag)
        || arguments.any(|argument| argument.get_long() == Some(name))
        || sources
            .iter()
            .any(|source| OPTIONS.contains(&&*source.path) && source.text.contains(&field));
    (!is_known).then(|| format!("no command has the flag {flag}"))
}

/// Returns the problem with the first argument of `cargo examples` that is neither the name of a
/// file nor a flag of the test harness. Returns `None` if there is no such argument.
fn unknown_example(words: &[&str], sources: &[SourceFile]) -> Option<String> {
    let unknown = words.iter().find(|word| {
        let files = ASSIGNMENTS.map(|it| format!("{}/src/{word}.rs", it.student));
        !EXAMPLES_FLAGS.contains(word) && !sources.iter().any(|it| files.contains(&it.path))
    })?;
    Some(format!(
        "there is no file with examples called {unknown}.rs"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problems(markdown: &str) -> Vec<String> {
        let source = |path: &str, text: &str| SourceFile {
            path: path.to_owned(),
            text: text.to_owned(),
        };
        let sources = [
            source(OPTIONS[0], "    pub(super) view: View,"),
            source(OPTIONS[1], "    pub no_open: bool,"),
            source("student/src/bvh.rs", ""),
            source("student/light/src/path.rs", ""),
        ];
        let aliases = [
            "grade", "handin", "author", "class", "render", "view", "examples",
        ];
        let aliases = aliases.map(str::to_owned);
        unknown_commands(&Page::new("a.md", markdown), &sources, &aliases.into())
    }

    #[test]
    fn known_commands_and_flags_pass() {
        let text = "```sh\ncargo grade --task sphere  # one task\ncargo author exams --check\n\
                    cargo examples bvh path --nocapture\ncargo class a.zip --dry-run\ncargo author exam --seed 7 > b\n```\n`--hints` `--shard 1/8` `cargo render cornell-box --view depth` `--view` `cargo view flat --no-open` `cargo handin --out a.zip`";
        assert_eq!(problems(text), [""; 0]);
    }

    #[test]
    fn reports_each_unknown_command_or_flag_with_its_line() {
        let text = "```sh\ncargo grade --taks sphere\ncargo grade --task spheres\ncargo gradee\n\
                    cargo render a --views\ncargo examples tree\nmake\ncargo handin --zip\ncargo class a --shard 9/8\ncargo view --opens\n```\n`--hint`";
        let problems = problems(text);
        let starts = [
            "a.md:2: `cargo grade --taks sphere`: error: unexpected argument '--taks' found",
            "a.md:3: `cargo grade --task spheres`: error: invalid value 'spheres' for '--task <TASK>'",
            "a.md:4: cargo has no command gradee",
            "a.md:5: no command has the flag --views",
            "a.md:6: there is no file with examples called tree.rs",
            "a.md:7: unknown command make",
            "a.md:8: `cargo handin --zip`: error: unexpected argument '--zip' found",
            "a.md:9: `cargo class a --shard 9/8`: error: invalid value '9/8'",
            "a.md:10: no command has the flag --opens",
            "a.md:12: no command has the flag --hint",
        ];
        assert_eq!(problems.len(), starts.len(), "{problems:#?}");
        for (problem, start) in problems.iter().zip(starts) {
            assert!(problem.starts_with(start), "{problem}");
        }
    }
}
