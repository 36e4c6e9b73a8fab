//! The lines that a student wrote, without comments and without the lines that were handed out.

use crate::handed_out::TaskFile;
use crate::handed_out::tokens::{tokens, without_comments};

/// Returns the lines of a task file's text that weren't in the starter, without comments and empty
/// lines. Two lines are equal if their tokens are equal. Only lines in the same order as in the
/// starter are considered handed out, so that the braces of a student's own code are kept. A byte
/// order mark, which some editors write, is ignored.
pub fn own_lines(file: &TaskFile, text: &str) -> String {
    let text = text.trim_start_matches('\u{feff}');
    let (text, starter) = (without_comments(text), without_comments(file.starter));
    let (lines, given) = (code_lines(&text), code_lines(&starter));
    let is_given = longest_common(&lines, &given);
    let own = lines.iter().zip(is_given).filter(|(_, is_given)| !is_given);
    let own = own.map(|((line, _), _)| format!("{}\n", line.trim_end()));
    own.collect()
}

/// A line of code, with its tokens.
type CodeLine<'a> = (&'a str, Vec<&'a str>);

/// Returns the lines that have tokens.
fn code_lines(text: &str) -> Vec<CodeLine<'_>> {
    let lines = text.lines().map(|line| (line, tokens(line)));
    lines.filter(|(_, tokens)| !tokens.is_empty()).collect()
}

/// The maximum size of the table in [`longest_common`]. No file that a student writes by hand comes
/// close to it.
const MAX_TABLE: usize = 10_000_000;

/// Returns, for each line, whether it belongs to a longest common subsequence with `given`.
fn longest_common(lines: &[CodeLine], given: &[CodeLine]) -> Vec<bool> {
    if lines.len().saturating_mul(given.len()) > MAX_TABLE {
        let is_given = |line: &CodeLine| given.iter().any(|other| other.1 == line.1);
        return lines.iter().map(is_given).collect();
    }
    // lengths[i][j] is the length of the longest common subsequence of the lines from `i` on and
    // the given lines from `j` on.
    let mut lengths = vec![vec![0u32; given.len() + 1]; lines.len() + 1];
    for i in (0..lines.len()).rev() {
        for j in (0..given.len()).rev() {
            lengths[i][j] = if lines[i].1 == given[j].1 {
                lengths[i + 1][j + 1] + 1
            } else {
                lengths[i + 1][j].max(lengths[i][j + 1])
            };
        }
    }
    let mut is_given = vec![false; lines.len()];
    let (mut i, mut j) = (0, 0);
    while i < lines.len() && j < given.len() {
        if lines[i].1 == given[j].1 {
            is_given[i] = true;
            (i, j) = (i + 1, j + 1);
        } else if lengths[i + 1][j] >= lengths[i][j + 1] {
            i += 1;
        } else {
            j += 1;
        }
    }
    is_given
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handed_out::RAYS;

    #[test]
    fn only_what_was_added_is_left() {
        let sphere = RAYS.task_file("sphere.rs").unwrap();
        assert_eq!(own_lines(sphere, sphere.starter), "");
        let stub = sphere
            .starter
            .lines()
            .find(|line| line.contains("todo!("))
            .unwrap();
        let own = "        // Mine.\n        if ray.dir.x > 0.0 { /* no */\n            return None;\n        }\n        None";
        let text = sphere.starter.replacen(stub, own, 1).replace("    ", "\t");
        let expected = "\t\tif ray.dir.x > 0.0 {\n\t\t\treturn None;\n\t\t}\n\t\tNone\n";
        assert_eq!(own_lines(sphere, &text), expected);
        assert_eq!(own_lines(sphere, "fn (\n}\n"), "fn (\n");
    }
}
