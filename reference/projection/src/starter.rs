//! The starter: the reference's files with stubs instead of the solutions.

use crate::marks::{Line, MarkError, lines_without_marks, lines_without_solutions};

/// Returns the starter's text for a marked file of the reference.
pub fn starter(reference: &str) -> Result<String, MarkError> {
    let mut starter = String::with_capacity(reference.len());
    for line in lines_without_solutions(reference)? {
        match line {
            Line::Given(line) => starter.extend([line, "\n"]),
            Line::Starter(indentation, text) => starter.extend([indentation, text, "\n"]),
        }
    }
    Ok(starter)
}

/// Returns the solved text for a marked file of the reference, without the marks.
pub fn solution(reference: &str) -> Result<String, MarkError> {
    // Fail if there are wrong marks.
    lines_without_solutions(reference)?;
    let lines = lines_without_marks(reference);
    Ok(lines.flat_map(|line| [line, "\n"]).collect())
}

#[cfg(test)]
mod tests {
    use super::{solution, starter};

    #[test]
    fn the_solution_has_no_marks() {
        let source = "fn f() {\n    // solution\n    // starter: todo!(\"1\")\n    // Why.\n    \
                      let x = 1;\n    // end solution\n}\n";
        let solved = "fn f() {\n    // Why.\n    let x = 1;\n}\n";
        assert_eq!(solution(source).unwrap(), solved);
        assert!(solution("// solution\n").is_err());
    }

    #[test]
    fn replaces_a_solution_by_its_starter_lines() {
        let source = "fn f() {\n    // solution\n    // starter: todo!(\"1\")\n    // Why.\n    \
                      let x = 1;\n    // end solution\n}\n";
        assert_eq!(starter(source).unwrap(), "fn f() {\n    todo!(\"1\")\n}\n");
    }

    #[test]
    fn starter_lines_work_outside_a_solution_and_may_be_empty() {
        let source = "// starter: #[ignore]\n#[test]\n// starter:\nfn f() {}\n";
        assert_eq!(
            starter(source).unwrap(),
            "#[ignore]\n#[test]\n\nfn f() {}\n"
        );
    }

    #[test]
    fn marks_within_a_sentence_are_ignored() {
        let source = "// solution of the equation\n/// starter: no\n";
        assert_eq!(starter(source).unwrap(), source);
    }
}
