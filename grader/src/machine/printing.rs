//! Prints to standard output and standard error. All programs print through this module, because a
//! CI system executes commands that it finds in a log, and logs contain students' names and texts.
//!
//! The commands are `::name …::` at the start of a line on GitHub, `##[name …]` anywhere in a line
//! on GitHub and Azure, `##vso[name …]` on Azure, and `##teamcity[name …]` on TeamCity.

use std::fmt::Display;

use console::AnsiCodeIterator;
use judging::sanitize::sanitize;

/// Prints text to standard output.
pub fn print(text: impl Display) {
    anstream::print!("{}", without_commands(&text.to_string()));
}

/// Prints a line to standard output.
pub fn print_line(line: impl Display) {
    print(format_args!("{line}\n"));
}

/// Prints a line to standard error.
pub fn print_error_line(line: impl Display) {
    anstream::eprintln!("{}", without_commands(&line.to_string()));
}

/// Prints an error that ends the program.
pub fn print_error(error: impl Display) {
    let error = sanitize(&error.to_string(), usize::MAX);
    print_error_line(format_args!("error: {error}"));
}

/// Prints the grader's own commands for the CI system. Their data must be escaped.
pub fn print_commands(commands: &str) {
    anstream::print!("{commands}");
}

/// Returns a count and the thing counted, such as `1 file` or `3 files`.
pub fn counted(count: usize, thing: &str) -> String {
    match count {
        1 => format!("1 {thing}"),
        count => format!("{count} {thing}s"),
    }
}

/// Wraps text into lines of at most this many characters, unless a single word is longer.
pub fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            let fits = line.chars().count() + 1 + word.chars().count() <= width;
            if !line.is_empty() && !fits {
                lines.push(std::mem::take(&mut line));
            }
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
        lines.push(line);
    }
    lines
}

/// Prints the help that the user requested, or the error in the command line, and exits.
#[expect(clippy::exit, reason = "clap exits in the same way")]
pub fn exit_with(error: &clap::Error) -> ! {
    let text = error.render().ansi().to_string();
    if error.use_stderr() {
        print_error_line(text.trim_end_matches('\n'));
    } else {
        print(text);
    }
    std::process::exit(error.exit_code())
}

/// Returns the text with a backslash inserted into everything that a CI system would execute. A
/// shell ignores the backslash, so paths can still be copied. The text may contain colours, which
/// may be removed later.
pub fn without_commands(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    // The number of colons in the line so far, or `None` if the line contains anything else.
    let mut colons = Some(0);
    // The number of `#` characters just before this character, up to 2. There may be letters after
    // the second one.
    let mut number_signs = 0;
    for (piece, is_colour) in AnsiCodeIterator::new(text) {
        if is_colour {
            safe.push_str(piece);
            continue;
        }
        for c in piece.chars() {
            if (c == ':' && colons == Some(1)) || (c == '[' && number_signs == 2) {
                safe.push('\\');
            }
            safe.push(c);
            number_signs = match c {
                '#' => 2.min(number_signs + 1),
                'a'..='z' | 'A'..='Z' if number_signs == 2 => 2,
                // Terminals and colour filters remove control characters.
                c if c.is_control() && !"\r\n".contains(c) => number_signs,
                _ => 0,
            };
            colons = match c {
                '\u{2028}' | '\u{2029}' => Some(0),
                c if c.is_control() => Some(0),
                c if c.is_whitespace() && colons == Some(0) => Some(0),
                ':' if colons == Some(0) => Some(1),
                _ => None,
            };
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Returns whether a runner would execute something in this text.
    fn has_command(text: &str) -> bool {
        let mut lines = text.split(['\n', '\r']);
        let starts_with_colons = lines.any(|line| line.trim_start().starts_with("::"));
        let markers = ["##[", "##vso[", "##teamcity["];
        starts_with_colons || markers.iter().any(|marker| text.contains(marker))
    }

    #[test]
    fn breaks_the_commands_of_each_system() {
        for (text, safe) in [
            ("::error::x", ":\\:error::x"),
            ("a\n \u{3000}::error::x", "a\n \u{3000}:\\:error::x"),
            ("x\r::b::", "x\r:\\:b::"),
            ("\u{1b}[1m::error::x", "\u{1b}[1m:\\:error::x"),
            (":\u{1b}[1m:error::x", ":\u{1b}[1m\\:error::x"),
            ("../##[set-env name=a]b", "../##\\[set-env name=a]b"),
            ("a ###[error]", "a ###\\[error]"),
            ("a ##vso[task]", "a ##vso\\[task]"),
            ("a ##teamcity[x]", "a ##teamcity\\[x]"),
            ("#\u{1b}[0m#[error]", "#\u{1b}[0m#\\[error]"),
        ] {
            assert_eq!(without_commands(text), safe);
        }
    }

    #[test]
    fn paths_of_code_and_attributes_stay() {
        let text = "sphere.rs:3: glam::Vec3\n#[inline] x[0] r##\"a\"## # [b]\n:-)";
        assert_eq!(without_commands(text), text);
    }

    proptest! {
        #[test]
        fn no_command_is_left(text in "([:# \\[\n\r\t]|##|vso|[0-9]|\u{2003}){0,12}") {
            let safe = without_commands(&text);
            prop_assert!(!has_command(&safe), "{safe:?}");
            prop_assert_eq!(safe.replace('\\', ""), text);
        }
    }

    #[test]
    fn wraps_between_words() {
        assert_eq!(wrap("one two three", 7), ["one two", "three"]);
        assert_eq!(wrap("a\nlonger-than-that", 4), ["a", "longer-than-that"]);
    }
}
