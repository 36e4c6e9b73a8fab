//! The marks in the reference's task files. The files are read line by line, without parsing Rust:
//!
//! ```text
//! // solution          starts a region with a solution
//! // starter: todo!()  in the starter, this line takes the place of the region, uncommented
//! // end solution      ends the region
//! ```
//!
//! `// starter:` also works outside a region. All other lines outside regions are given code.

/// An error in the marks of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{line}: {problem}")]
pub struct MarkError {
    /// The number of the line with the mark, counted from 1.
    pub line: usize,
    /// The problem on that line.
    pub problem: MarkProblem,
}

/// A problem with a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MarkProblem {
    /// A region starts inside another.
    #[error("`// solution` inside a solution: end the previous one with `// end solution` first")]
    Nested,
    /// An end mark is not in a region.
    #[error("this `// end solution` has no `// solution` above it")]
    NotStarted,
    /// A region is never ended.
    #[error("this `// solution` has no `// end solution`")]
    NotEnded,
    /// A region contains no line for the starter.
    #[error(
        "this `// solution` has no `// starter:` line: add one with the code that students get"
    )]
    NoStarterLine,
}

/// A line that isn't part of a solution.
pub(crate) enum Line<'a> {
    /// A line of given code.
    Given(&'a str),
    /// A line of the starter: its indentation, and the text after the mark.
    Starter(&'a str, &'a str),
}

/// The role of a line in a marked file.
enum LineKind<'a> {
    Begin,
    End,
    Starter(&'a str, &'a str),
    Other,
}

fn classify(line: &str) -> LineKind<'_> {
    let text = line.trim_start();
    let indentation = &line[..line.len() - text.len()];
    match text {
        "// solution" => LineKind::Begin,
        "// end solution" => LineKind::End,
        "// starter:" => LineKind::Starter("", ""),
        _ => text
            .strip_prefix("// starter: ")
            .map_or(LineKind::Other, |rest| LineKind::Starter(indentation, rest)),
    }
}

/// Returns the lines of a marked file that aren't marks.
pub(crate) fn lines_without_marks(source: &str) -> impl Iterator<Item = &str> {
    let is_mark = |line: &&str| !matches!(classify(line), LineKind::Other);
    source.lines().filter(move |line| !is_mark(line))
}

/// Returns the lines of a marked file that aren't part of a solution.
pub(crate) fn lines_without_solutions(source: &str) -> Result<Vec<Line<'_>>, MarkError> {
    let error = |line, problem| Err(MarkError { line, problem });
    let mut lines = Vec::new();
    // The first line of the open region, and whether it contains a line for the starter.
    let mut open: Option<(usize, bool)> = None;
    for (number, line) in (1..).zip(source.lines()) {
        match (classify(line), &mut open) {
            (LineKind::Begin, None) => open = Some((number, false)),
            (LineKind::Begin, Some(_)) => return error(number, MarkProblem::Nested),
            (LineKind::End, None) => return error(number, MarkProblem::NotStarted),
            (LineKind::End, Some((begin, false))) => {
                return error(*begin, MarkProblem::NoStarterLine);
            }
            (LineKind::End, Some((_, true))) => open = None,
            (LineKind::Starter(indentation, rest), region) => {
                lines.push(Line::Starter(indentation, rest));
                *region = region.map(|(begin, _)| (begin, true));
            }
            (LineKind::Other, None) => lines.push(Line::Given(line)),
            (LineKind::Other, Some(_)) => {}
        }
    }
    match open {
        Some((begin, _)) => error(begin, MarkProblem::NotEnded),
        None => Ok(lines),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_each_problem_with_its_line() {
        let cases = [
            ("\n// solution\n// starter: x\n", 2, MarkProblem::NotEnded),
            ("\n// end solution\n", 2, MarkProblem::NotStarted),
            (
                "// solution\n// starter:\n// solution\n",
                3,
                MarkProblem::Nested,
            ),
            (
                "x\n// solution\ny\n// end solution\n",
                2,
                MarkProblem::NoStarterLine,
            ),
        ];
        for (source, line, problem) in cases {
            let error = lines_without_solutions(source).err();
            assert_eq!(error, Some(MarkError { line, problem }), "{source:?}");
        }
    }
}
