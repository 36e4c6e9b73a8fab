//! The commands that a report prints for grading a question or a task again.

use std::path::{Path, PathBuf};

use maud::html;

/// The options that every printed command must repeat to refer to the same submission and exam.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RerunCommand {
    /// The id of the assignment, or `None` for the default.
    pub assignment: Option<&'static str>,
    /// The path of the submission, or `None` for the default.
    pub submission: Option<PathBuf>,
    /// The path of the exam file, or `None` for the practice exam.
    pub exam: Option<PathBuf>,
    /// Whether the submission may only run in a sandbox.
    pub is_untrusted: bool,
}

impl RerunCommand {
    /// Returns the command that runs one question again.
    pub fn replay(&self, item: &str, number: usize) -> String {
        self.command(&format!("--replay {item}#{number}"))
    }

    /// Returns the command that grades one task again.
    pub fn task(&self, task: &str) -> String {
        self.command(&format!("--task {task}"))
    }

    /// Returns the command that shows the tree or the shapes of one question in the viewer, which
    /// only accepts the practice exam.
    pub fn view(&self, item: &str, number: usize) -> Option<String> {
        let is_practice = self.exam.is_none();
        let submission = self.submission.iter();
        let words = submission.flat_map(|path| ["--submission".to_owned(), shell_word(path)]);
        let question = format!("--item {item}#{number}");
        is_practice.then(|| self.join("cargo view", words, question))
    }

    fn command(&self, what: &str) -> String {
        let submission = self.submission.iter().map(|path| shell_word(path));
        let exam = self
            .exam
            .iter()
            .flat_map(|path| ["--exam".to_owned(), shell_word(path)]);
        self.join("cargo grade", submission.chain(exam), what.to_owned())
    }

    /// Returns a command that repeats the options. `words` are the arguments that name the
    /// submission.
    fn join(&self, start: &str, words: impl Iterator<Item = String>, end: String) -> String {
        let assignment = self.assignment.map(|id| format!("--assignment {id}"));
        let untrusted = self.is_untrusted.then(|| "--untrusted".to_owned());
        let all = [start.to_owned()].into_iter().chain(words);
        let options = assignment.into_iter().chain(untrusted);
        let words: Vec<String> = all.chain(options).chain([end]).collect();
        words.join(" ")
    }
}

/// Returns a report page whose commands refer to the submission at `to` instead of `from`.
pub fn with_moved_submission(page: &str, from: &Path, to: &Path) -> String {
    let [from, to] = [from, to].map(|path| html! { (shell_word(path)) }.into_string());
    page.replace(&from, &to)
}

/// Quotes a path for a command line, if necessary.
fn shell_word(path: &Path) -> String {
    let text = path.to_string_lossy().into_owned();
    let is_plain = |c: char| c.is_alphanumeric() || "_-./:\\+,@%".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        text
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn command_names_a_given_submission_exam_and_assignment() {
        let own = RerunCommand::default();
        let final_exam = RerunCommand {
            assignment: None,
            submission: Some("handed in/O'Hara".into()),
            exam: Some("final.json".into()),
            is_untrusted: false,
        };
        let untrusted = RerunCommand {
            assignment: None,
            submission: Some("alice.zip".into()),
            exam: None,
            is_untrusted: true,
        };
        let other = RerunCommand {
            assignment: Some("light"),
            ..RerunCommand::default()
        };
        for (command, again, view) in [
            (
                other,
                "cargo grade --assignment light ",
                Some("cargo view --assignment light "),
            ),
            (own, "cargo grade ", Some("cargo view ")),
            (
                final_exam,
                r"cargo grade 'handed in/O'\''Hara' --exam final.json ",
                None,
            ),
            (
                untrusted,
                "cargo grade alice.zip --untrusted ",
                Some("cargo view --submission alice.zip --untrusted "),
            ),
        ] {
            assert_eq!(command.task("sphere"), format!("{again}--task sphere"));
            let replay = format!("{again}--replay sphere.uv#7");
            assert_eq!(command.replay("sphere.uv", 7), replay);
            let view = view.map(|view| format!("{view}--item sphere.uv#7"));
            assert_eq!(command.view("sphere.uv", 7), view);
        }
    }

    #[test]
    fn a_page_that_is_moved_names_the_moved_submission() {
        let page = |path: &str| {
            let command = RerunCommand {
                submission: Some(path.into()),
                ..RerunCommand::default()
            };
            html! { (command.task("sphere")) }.into_string()
        };
        let (from, to) = ("/part one/\"a\".zip", "/all/<a>.zip");
        assert_ne!(page(from), page(to));
        let moved = with_moved_submission(&page(from), from.as_ref(), to.as_ref());
        assert_eq!(moved, page(to));
    }
}
