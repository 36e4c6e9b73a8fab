//! The catalogues of mistakes. Mistakes are small changes to the reference or to a variant. The
//! folder `mistakes` of an assignment's solutions contains:
//!
//! - Known mistakes in `TASK/*.toml`, with hints for students.
//! - Independent mistakes in `independent/*.toml`: known mistakes in a variant's code, where they
//!   look as they would in the solution of a student who never saw the reference.
//! - Code in `same_answers/*.toml` that gives the same answers as known mistakes, but for other
//!   reasons. The hints for those mistakes must be true of this code too.
//! - Other forms of the reference's code in `forms.toml`. Known mistakes are recorded in these forms,
//!   too.
//! - Unknown mistakes in `unknown/*.toml`. They have no hints of their own, so they show whether
//!   wrong code gets false hints.
//!
//! [`methods`](crate::solutions::methods) reads further unknown mistakes.

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use grader::files;
use grader::handed_out::HandedOut;
use judging::assignment::Task;
use judging::section::Section;
use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::solutions::Solutions;
use crate::solutions::read_toml;
use crate::solutions::solution::{Expected, Solution};
use crate::solutions::sources::Sources;

/// A wrong solution, as written in a catalogue.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// The task's id, a dot, and a name, such as `sphere.far_first`.
    pub id: String,
    /// A description of what the wrong code does. An independent mistake takes its description from
    /// the known mistake.
    #[serde(default)]
    pub title: String,
    /// The id of the variant that contains an independent mistake.
    #[serde(default)]
    pub variant: Option<String>,
    /// Where the mistake was seen, as numbers that `reference/mistakes/README.md` explains.
    #[serde(default)]
    pub seen: Vec<String>,
    /// A question for students that helps them find the mistake.
    #[serde(default)]
    pub nudge: String,
    /// An explanation of the mistake for students.
    #[serde(default)]
    pub hint: String,
    /// The mistake whose nudge and hint this mistake shares, because the exam cannot tell them
    /// apart. The texts must fit both.
    #[serde(default)]
    pub same_hint_as: Option<String>,
    /// Other mistakes that every sentence of the hint is also true of.
    #[serde(default)]
    pub also_true_of: Vec<String>,
    /// Pairs of other mistakes that together have the same effect. The hint is also true of code
    /// that contains both mistakes of a pair.
    #[serde(default)]
    pub true_of_pairs: Vec<[String; 2]>,
    /// The handout section about the mistake, if it isn't the section that the failed items refer
    /// to.
    #[serde(default)]
    pub section: Option<Section>,
    /// Additional tasks that may lose points. Only used if the entry combines two mistakes that
    /// hide each other.
    #[serde(default)]
    pub other_tasks: Vec<Task>,
    /// Additional known mistakes whose hints are true of an independent or unknown mistake.
    #[serde(default)]
    pub true_hints: Vec<String>,
    /// The changes to the reference or the variant. There is nearly always only one.
    #[serde(rename = "change")]
    pub changes: Vec<Change>,
}

/// The replacement of a string that occurs exactly once in a file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// The task file to change. Defaults to the file of the mistake's task, or of the variant.
    pub file: Option<String>,
    /// The text to replace.
    pub was: String,
    /// The replacement.
    pub now: String,
}

/// Reads all known mistakes of an assignment in the workspace at `root`, ordered by task and then
/// by file. A task without a folder doesn't have any mistakes.
pub fn mistakes(root: &Path, handed_out: &HandedOut) -> Result<Vec<Mistake>> {
    let mut all: Vec<Mistake> = Vec::new();
    for task in handed_out.assignment.tasks() {
        for mistake in read_mistakes(root, handed_out, task.id())? {
            let known = all.iter().any(|other| other.id == mistake.id);
            if known || !mistake.id.starts_with(&format!("{task}.")) {
                bail!(
                    "mistakes/{task}: the id `{}` must be unique and begin with its task's id \
                     and a dot, such as `camera.`",
                    mistake.id
                );
            }
            all.push(mistake);
        }
    }
    share_hints(&mut all)?;
    Ok(all)
}

/// Copies the nudge and the hint to each mistake that shares those of another mistake. Checks the
/// ids that mistakes use to refer to each other.
fn share_hints(mistakes: &mut [Mistake]) -> Result<()> {
    let known = mistakes.to_vec();
    let find = |id: &String| known.iter().find(|other| other.id == *id);
    for mistake in mistakes {
        let is_complete = match &mistake.same_hint_as {
            None => !mistake.nudge.is_empty() && !mistake.hint.is_empty(),
            Some(other) => {
                let has_none = mistake.nudge.is_empty() && mistake.hint.is_empty();
                let other = find(other).filter(|other| {
                    has_none && other.same_hint_as.is_none() && other.task() == mistake.task()
                });
                other.is_some_and(|other| {
                    mistake.nudge.clone_from(&other.nudge);
                    mistake.hint.clone_from(&other.hint);
                    true
                })
            }
        };
        let others = mistake.also_true_of.iter();
        let mut others = others.chain(mistake.true_of_pairs.iter().flatten());
        if !is_complete || !others.all(|other| find(other).is_some()) {
            bail!(
                "{}: add a `nudge` and a `hint`, or set `same_hint_as` to another mistake in the same task \
                 that has both; `also_true_of` and `true_of_pairs` must name other mistakes",
                mistake.id
            );
        }
    }
    Ok(())
}

/// Reads the `[[mistake]]` entries of the TOML files in a folder of the catalogue, in the order of
/// the files.
fn read_mistakes(root: &Path, handed_out: &HandedOut, folder: &str) -> Result<Vec<Mistake>> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        mistake: Vec<Mistake>,
    }

    let files: Vec<File> = read_folder(root, handed_out, folder)?;
    Ok(files.into_iter().flat_map(|file| file.mistake).collect())
}

/// Reads the TOML files in a folder of the catalogue. Returns an empty list if the folder doesn't
/// exist.
pub(super) fn read_folder<T: DeserializeOwned>(
    root: &Path,
    handed_out: &HandedOut,
    folder: &str,
) -> Result<Vec<T>> {
    let folder = root.join(format!("{}/mistakes/{folder}", handed_out.solutions()));
    if !folder.exists() {
        return Ok(Vec::new());
    }
    let mut paths = files::read_dir(folder)?;
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    paths.iter().map(|path| read_toml(path)).collect()
}

/// Reads the independent mistakes and applies them to their variants.
pub fn independent_mistakes(solutions: &Solutions) -> Result<Vec<Solution>> {
    let all = solutions.read_catalogue("independent")?.into_iter();
    all.map(|mistake| mistake.in_variant(solutions)).collect()
}

/// Another way to write part of the reference. Students who write their code in this way give
/// different answers when they make a known mistake.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Form {
    /// The task whose mistakes are made in this form, too.
    task: Task,
    /// The changes to the reference.
    #[serde(rename = "change")]
    changes: Vec<Change>,
}

/// Applies the known mistakes to the other forms of the reference's code. Each solution has the id
/// of its mistake. A mistake isn't applied to a form that changes the same code.
pub(super) fn mistakes_in_other_forms(
    root: &Path,
    catalogue: &[Mistake],
    reference: &Sources,
) -> Result<Vec<Solution>> {
    #[derive(Default, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Forms {
        form: Vec<Form>,
    }

    let handed_out = reference.handed_out();
    let path = root.join(format!("{}/mistakes/forms.toml", handed_out.solutions()));
    let forms: Forms = if path.exists() {
        read_toml(&path)?
    } else {
        Forms::default()
    };
    let mut all = Vec::new();
    for Form { task, changes } in forms.form {
        let file = handed_out.assignment.info(task).file;
        let form = apply_changes(reference, &changes, file).map_err(|(file, count)| {
            anyhow!(
                "{}: each `was` must occur once in {}/{file}, but one occurs {count} times",
                path.display(),
                handed_out.reference
            )
        })?;
        let of_task = catalogue.iter().filter(|mistake| mistake.task() == task);
        all.extend(of_task.filter_map(|mistake| mistake.solution(&form).ok()));
    }
    Ok(all)
}

/// Reads the code that gives the same answers as known mistakes, but for other reasons. Each
/// solution is the reference with a few changes.
pub fn other_causes(solutions: &Solutions) -> Result<Vec<Solution>> {
    let all = solutions.read_catalogue("same_answers")?.into_iter();
    all.map(|mistake| {
        if solutions.mistake(&mistake.id).is_none() {
            bail!(
                "{} in mistakes/same_answers is not a known mistake",
                mistake.id
            );
        }
        let mut other = mistake.solution(solutions.recorder.reference())?;
        other.id += " for another reason";
        Ok(other)
    })
    .collect()
}

/// Reads the unknown mistakes and applies them to the reference.
pub fn unknown_mistakes(solutions: &Solutions) -> Result<Vec<Solution>> {
    let all = solutions.read_catalogue("unknown")?.into_iter();
    all.map(|mistake| {
        solutions.check_unknown(&mistake.id, &mistake.true_hints, "unknown")?;
        let mut unknown = mistake.solution(solutions.recorder.reference())?;
        unknown.expected.true_hints = mistake.true_hints;
        Ok(unknown)
    })
    .collect()
}

impl Solutions {
    fn read_catalogue(&self, folder: &str) -> Result<Vec<Mistake>> {
        read_mistakes(self.workbench.root(), self.workbench.handed_out(), folder)
    }

    /// Returns the task of a wrong solution that isn't a known mistake. Checks the ids in the
    /// solution's entry in the catalogue.
    pub(super) fn check_unknown(
        &self,
        id: &str,
        true_hints: &[String],
        folder: &str,
    ) -> Result<Task> {
        let is_known = |id: &str| self.mistake(id).is_some();
        let are_known = true_hints.iter().all(|hint| is_known(hint));
        let task = Task::in_id(id).filter(|_| !is_known(id) && are_known);
        task.ok_or_else(|| {
            anyhow!(
                "{id} in mistakes/{folder}: its id must begin with a task's name and a dot, \
                 and must not be the id of a known mistake; `true_hints` must name known mistakes"
            )
        })
    }
}

impl Mistake {
    /// Returns the task in which the mistake must cost points.
    pub fn task(&self) -> Task {
        Task::in_id(&self.id).expect("ids were checked when they were read")
    }

    /// Returns the reference with this mistake.
    pub fn solution(&self, reference: &Sources) -> Result<Solution> {
        let mut changes = self.changes.iter();
        Ok(Solution {
            id: self.id.clone(),
            title: self.title.clone(),
            sources: self.apply(reference)?,
            expected: Expected {
                tasks: [&[self.task()], &self.other_tasks[..]].concat(),
                true_hints: vec![self.id.clone()],
                keeps_state: changes.any(|change| change.now.contains("static ")),
                ..Expected::default()
            },
        })
    }

    /// Returns the variant with this mistake.
    pub fn in_variant(&self, solutions: &Solutions) -> Result<Solution> {
        let name = self.variant.as_deref().unwrap_or_default();
        let id = format!("{} in {name}", self.id);
        let is_known = |id: &String| solutions.mistake(id).is_some();
        let mut variants = solutions.variants.iter();
        let known = solutions.mistake(&self.id);
        let variant = variants.find(|variant| variant.id == name);
        let found = known.zip(variant).filter(|(known, variant)| {
            let solved = &variant.expected.tasks;
            solved.contains(&known.task()) && self.true_hints.iter().all(is_known)
        });
        let Some((known, variant)) = found else {
            bail!(
                "{id}: the catalogue of mistakes must contain the mistake and its `true_hints`, \
                 and variants.toml must contain a variant with this id that solves the mistake's \
                 task"
            );
        };
        let mut expected = known.expected.clone();
        expected.true_hints.extend(self.true_hints.iter().cloned());
        let own_file = format!("{}.rs", name.split('.').next().unwrap_or_default());
        let sources = apply_changes(&variant.sources, &self.changes, &own_file);
        Ok(Solution {
            title: known.title.clone(),
            sources: sources.map_err(|(file, count)| {
                anyhow!(
                    "{id} no longer applies: its `was` must occur once in the variant's {file}, \
                        but occurs {count} times; update `was` in mistakes/independent"
                )
            })?,
            expected,
            id,
        })
    }

    /// Returns the files of the reference with this mistake.
    pub fn apply(&self, reference: &Sources) -> Result<Sources> {
        let handed_out = reference.handed_out();
        let own_file = handed_out.assignment.info(self.task()).file;
        apply_changes(reference, &self.changes, own_file).map_err(|(file, count)| {
            anyhow!(
                "{} no longer applies: its `was` must occur once in {}/{file}, but occurs {count} \
                    times; update `was` in the catalogue of mistakes",
                self.id,
                handed_out.reference
            )
        })
    }
}

/// Applies changes to a solution. A change that names no file applies to `own_file`. If the text to
/// be replaced doesn't occur exactly once, the error consists of the file's name and the number of
/// occurrences.
fn apply_changes(
    base: &Sources,
    changes: &[Change],
    own_file: &str,
) -> Result<Sources, (String, usize)> {
    let mut sources = base.clone();
    for change in changes {
        let file = change.file.as_deref().unwrap_or(own_file);
        let text = sources.text(file).unwrap_or_default();
        let count = text.matches(&change.was).count();
        if count != 1 {
            return Err((file.to_owned(), count));
        }
        let text = text.replacen(&change.was, &change.now, 1);
        sources = sources.with_file(file, text);
    }
    Ok(sources)
}
