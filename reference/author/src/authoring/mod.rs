//! Assignments as their authors see them. Everything about exams, proofs and packages is derived
//! from this data, so adding an assignment doesn't change any other module.

mod light;
mod rays;

use grader::handed_out::HandedOut;

use crate::items::AuthoredTask;

pub use light::LIGHT;
pub use rays::RAYS;

/// The assignments that `--assignment` selects from. The first is the default.
pub static ASSIGNMENTS: [&Authoring; 2] = [&RAYS, &LIGHT];

/// An assignment as its authors see it. Its solutions other than the reference (mistakes, variants
/// and equivalent mutants) are files in the folder [`HandedOut::solutions`].
#[derive(Debug)]
pub struct Authoring {
    /// The assignment as handed out to students.
    pub handed_out: &'static HandedOut,
    /// The file of the practice exam, relative to the workspace's root.
    pub practice_exam: &'static str,
    /// The tasks, in lecture order. The keys for rendered pictures are recorded from the reference,
    /// because nothing else can provide them.
    pub tasks: &'static [&'static AuthoredTask],
    /// The folders and files with oracles, relative to the workspace's root. Their formulas are
    /// secret.
    pub oracles: &'static [&'static str],
    /// The attacks to try on a package whose exam is secret.
    pub attacks: &'static [Attack],
}

/// An attack from the corpus of hostile submissions, called from a task's method.
#[derive(Debug)]
pub struct Attack {
    /// The task file.
    pub file: &'static str,
    /// The first line of the method that calls the attack.
    pub method: &'static str,
    /// The name of the entry in the corpus, without `.rs`.
    pub entry: &'static str,
}

impl Authoring {
    /// Returns the assignment with this id, or a human-readable message if it doesn't exist.
    pub fn find(id: &str) -> Result<&'static Authoring, String> {
        let handed_out = HandedOut::find(id)?;
        let mut all = ASSIGNMENTS.into_iter();
        let found = all.find(|authoring| authoring.handed_out == handed_out);
        found.ok_or_else(|| format!("the assignment `{id}` has no entry in authoring/mod.rs"))
    }
}
