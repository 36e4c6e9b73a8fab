//! The command that asks the same once more.

use std::path::{Path, PathBuf};

/// What of a command line says who was asked what: it stands in every command that a report gives.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Again {
    /// The submission, unless it is the student's own.
    pub submission: Option<PathBuf>,
    /// The exam, unless it is the practice exam.
    pub exam: Option<PathBuf>,
}

impl Again {
    /// One question alone.
    pub fn replay(&self, item: &str, number: usize) -> String {
        self.command(&format!("--replay {item}#{number}"))
    }

    /// One task alone.
    pub fn task(&self, task: &str) -> String {
        self.command(&format!("--task {task}"))
    }

    fn command(&self, what: &str) -> String {
        let submission = self.submission.iter().map(|path| word(path));
        let exam = self
            .exam
            .iter()
            .flat_map(|path| ["--exam".to_owned(), word(path)]);
        let words = ["cargo grade".to_owned()].into_iter();
        let words: Vec<String> = words
            .chain(submission)
            .chain(exam)
            .chain([what.to_owned()])
            .collect();
        words.join(" ")
    }
}

/// A path as one word of a command line.
fn word(path: &Path) -> String {
    let text = path.to_string_lossy().into_owned();
    let is_plain = |c: char| c.is_alphanumeric() || "_-./:\\+,@%".contains(c);
    match !text.is_empty() && text.chars().all(is_plain) {
        true => text,
        false => format!("'{}'", text.replace('\'', r"'\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::Again;

    #[test]
    fn a_command_names_what_is_not_the_students_own() {
        let own = Again::default();
        assert_eq!(
            own.replay("sphere.uv", 7),
            "cargo grade --replay sphere.uv#7"
        );
        let others = Again {
            submission: Some("handed in/O'Hara".into()),
            exam: Some("final.json".into()),
        };
        assert_eq!(
            others.task("sphere"),
            r"cargo grade 'handed in/O'\''Hara' --exam final.json --task sphere"
        );
    }
}
