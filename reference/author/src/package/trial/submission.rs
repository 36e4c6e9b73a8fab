//! The submissions of a trial and the points they must get.

use std::path::Path;

use anyhow::{Result, ensure};
use grader::files;
use grader::handed_out::HandedOut;

use crate::authoring::{Attack, Authoring};
use crate::package::Platform;

/// The folder with the corpus of hostile submissions.
const CORPUS: &str = "grader/tests/hostile/entries";
/// The placeholders in the corpus, and the files that they stand for. The attacks look for these
/// files.
const TARGETS: [(&str, &str); 2] = [
    ("@KEY@", "/opt/pathtracing/exam.json"),
    ("@OUT@", "/opt/pathtracing/target/graded"),
];
/// The text that an attack prints if it has read a file.
pub const REACHED: &str = "reached: ";

/// A submission in a trial.
#[derive(Clone, Debug)]
pub struct TrialSubmission {
    /// The submission's name in messages.
    pub name: &'static str,
    /// The points that the submission must get, or `None` if there is nothing to grade.
    pub points: Option<u64>,
    /// The names and texts of its task files.
    pub files: Vec<(&'static str, String)>,
}

/// Returns the submissions for a platform's trial: the reference, the starter, a submission without
/// any task files and, if the exam is secret, one that tries to steal it.
pub fn submissions(
    authoring: &Authoring,
    workspace: &Path,
    platform: Platform,
) -> Result<Vec<TrialSubmission>> {
    let handed_out = authoring.handed_out;
    let submission = |name, points, files| TrialSubmission {
        name,
        points,
        files,
    };
    let names = handed_out.file_names();
    let reference = names.map(|name| {
        let path = workspace.join(handed_out.reference).join(name);
        Ok((name, files::read_to_string(path)?))
    });
    let files = handed_out.files.iter();
    let starter: Vec<_> = files
        .map(|file| (file.name, file.starter.to_owned()))
        .collect();
    let mut submissions = vec![
        submission(
            "the reference",
            Some(100),
            reference.collect::<Result<_>>()?,
        ),
        submission("the starter", Some(0), starter.clone()),
        submission("an empty submission", None, Vec::new()),
    ];
    if platform == Platform::Gradescope {
        let files = with_attacks(starter, authoring.attacks, workspace)?;
        submissions.push(submission("a malicious submission", Some(0), files));
    }
    Ok(submissions)
}

fn with_attacks(
    mut files: Vec<(&'static str, String)>,
    attacks: &[Attack],
    workspace: &Path,
) -> Result<Vec<(&'static str, String)>> {
    for Attack {
        file: attacked,
        method: head,
        entry,
    } in attacks
    {
        let text = files::read_to_string(workspace.join(CORPUS).join(format!("{entry}.rs")))?;
        // Drop the entry's description, which is for readers of the corpus.
        let code = text.lines().filter(|line| !line.starts_with("//!"));
        let mut attack: String = code.flat_map(|line| [line, "\n"]).collect();
        for (placeholder, path) in TARGETS {
            attack = attack.replace(placeholder, path);
        }
        for (_, text) in files.iter_mut().filter(|(name, _)| name == attacked) {
            ensure!(text.contains(head), "{attacked} does not contain `{head}`");
            *text = text.replacen(head, &format!("{head}\n        attack();"), 1) + &attack;
        }
    }
    Ok(files)
}

impl TrialSubmission {
    /// Writes the submission's files into a folder, replacing the task files there.
    pub fn write_to(&self, handed_out: &HandedOut, folder: &Path) -> Result<()> {
        files::create_dir_all(folder)?;
        for name in handed_out.file_names() {
            files::remove_if_exists(folder.join(name))?;
        }
        for (name, text) in &self.files {
            files::write(folder.join(name), text)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::authoring::RAYS;

    #[test]
    fn the_attacks_are_called_in_the_starter() {
        let workspace = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
        let all = submissions(&RAYS, workspace, Platform::Gradescope).unwrap();
        let attacking = &all.last().unwrap().files;
        let attacks = attacking.iter().filter(|(_, text)| {
            text.contains("attack();") && text.contains("fn attack()") && !text.contains('@')
        });
        assert_eq!(attacks.count(), RAYS.attacks.len());
    }
}
