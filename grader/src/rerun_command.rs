//! The commands that a report prints for grading a question or a task again.

use std::path::{Path, PathBuf};

/// The options that every printed command must repeat to refer to the same submission and exam.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RerunCommand {
    /// The path of the submission, or `None` for the default one.
    pub submission: Option<PathBuf>,
    /// The path of the exam file, or `None` for the practice exam.
    pub exam: Option<PathBuf>,
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

    /// Returns the command that shows the tree or the shapes of one question in the viewer, for one's
    /// own work and the practice exam. Questions about the camera have neither.
    pub fn view(&self, item: &str, number: usize) -> Option<String> {
        let is_own = self.submission.is_none() && self.exam.is_none();
        let has_scene = !item.starts_with("camera.");
        (is_own && has_scene).then(|| format!("cargo view --item {item}#{number}"))
    }

    fn command(&self, what: &str) -> String {
        let submission = self.submission.iter().map(|path| shell_word(path));
        let exam = self
            .exam
            .iter()
            .flat_map(|path| ["--exam".to_owned(), shell_word(path)]);
        let words = ["cargo grade".to_owned()].into_iter();
        let words: Vec<String> = words
            .chain(submission)
            .chain(exam)
            .chain([what.to_owned()])
            .collect();
        words.join(" ")
    }
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
    use super::RerunCommand;

    #[test]
    fn command_names_a_given_submission_and_exam() {
        let own = RerunCommand::default();
        assert_eq!(
            own.replay("sphere.uv", 7),
            "cargo grade --replay sphere.uv#7"
        );
        let view = own.view("sphere.uv", 7);
        assert_eq!(view.as_deref(), Some("cargo view --item sphere.uv#7"));
        assert_eq!(own.view("camera.corners", 1), None);
        let others = RerunCommand {
            submission: Some("handed in/O'Hara".into()),
            exam: Some("final.json".into()),
        };
        assert_eq!(
            others.task("sphere"),
            r"cargo grade 'handed in/O'\''Hara' --exam final.json --task sphere"
        );
        assert_eq!(others.view("sphere.uv", 7), None);
    }
}
