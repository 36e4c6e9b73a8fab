//! The catalogue of known mistakes, which are small changes to the reference:
//! `mistakes/TASK/*.toml` in the folder of an assignment's solutions.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use grader::files::{self, PathError};
use grader::handed_out::HandedOut;
use judging::assignment::Task;
use judging::section::Section;
use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::solutions::failed_items::{FailedItems, FailedItemsError};
use crate::solutions::sources::Sources;
use crate::solutions::toml_file::{TomlFileError, read_toml};

/// A known wrong solution.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// The task's id, a dot, and a name, such as `sphere.far_first`.
    pub id: String,
    /// A description of what the wrong code does.
    pub title: String,
    /// The sources in which the mistake was seen, by their numbers in
    /// `reference/mistakes/README.md`.
    #[serde(default)]
    pub seen: Vec<String>,
    /// A question for students that helps them find the mistake.
    #[serde(default)]
    pub nudge: String,
    /// An explanation for students of what is wrong.
    #[serde(default)]
    pub hint: String,
    /// The mistake whose nudge and hint this one shares, because the exam cannot tell them apart, so
    /// that the texts must fit both.
    #[serde(default)]
    pub same_hint_as: Option<String>,
    /// Other mistakes of which every sentence of the hint is also true.
    #[serde(default)]
    pub also_true_of: Vec<String>,
    /// Pairs of other mistakes that together do the same, so that the hint is true of code that makes
    /// both.
    #[serde(default)]
    pub true_of_pairs: Vec<[String; 2]>,
    /// The section of the handout about the mistake, if it differs from the section of the items
    /// that fail.
    #[serde(default)]
    pub section: Option<Section>,
    /// The tasks in addition to its own that may lose points, for two combined mistakes that hide
    /// each other.
    #[serde(default)]
    pub other_tasks: Vec<Task>,
    /// The items that fail with every seed, from the generated list.
    #[serde(skip)]
    pub fails: Vec<String>,
    /// The changes to the reference. Nearly always, there is only one.
    #[serde(rename = "change")]
    pub changes: Vec<Change>,
}

impl Mistake {
    /// Returns whether the code keeps something from one call to the next.
    pub fn keeps_state(&self) -> bool {
        self.changes
            .iter()
            .any(|change| change.now.contains("static "))
    }
}

/// A replacement of a text that occurs exactly once in a file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// The task file to change. By default, the file of the mistake's task.
    pub file: Option<String>,
    /// The text in the reference that is replaced.
    pub was: String,
    /// The text that replaces it.
    pub now: String,
}

/// The reason why the catalogue cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CatalogueError {
    /// A folder cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// A file of the catalogue cannot be read or is invalid.
    #[error(transparent)]
    Toml(#[from] TomlFileError),
    /// The list of failed items cannot be used.
    #[error(transparent)]
    FailedItems(#[from] FailedItemsError),
    /// An id does not begin with the id of its task, or is used twice.
    #[error(
        "{}: the id `{id}` must be unique and begin with the id of its task and a dot, such as \
         `camera.`",
        path.display()
    )]
    Id {
        /// The path of the file.
        path: PathBuf,
        /// The id that is not allowed.
        id: String,
    },
    /// A mistake has no texts, or refers to another mistake for them in a wrong way.
    #[error(
        "{id}: give it a `nudge` and a `hint`, or name in `same_hint_as` another mistake of its task \
         that has them; `also_true_of` and `true_of_pairs` name other mistakes"
    )]
    Texts {
        /// The id of the mistake.
        id: String,
    },
    /// The text that a mistake changes no longer occurs exactly once in the reference.
    #[error(
        "{id} no longer applies: its `was` occurs {count} times in {file} instead of once; adapt it in \
         the catalogue of mistakes"
    )]
    DoesNotApply {
        /// The id of the mistake.
        id: String,
        /// The path of the file that it changes.
        file: String,
        /// The number of occurrences.
        count: usize,
    },
}

/// Reads all known mistakes of an assignment in the workspace at `root`, ordered by task and then
/// by file. A task without a folder has none.
pub fn mistakes(root: &Path, handed_out: &HandedOut) -> Result<Vec<Mistake>, CatalogueError> {
    let folder = root.join(handed_out.solutions()).join("mistakes");
    let failed = FailedItems::load(root, handed_out)?;
    let mut all: Vec<Mistake> = Vec::new();
    for task in handed_out.assignment.tasks() {
        for (path, mut mistake) in read_mistakes::<Mistake>(&folder.join(task.id()))? {
            mistake.fails = failed.of_mistake(&mistake.id).to_vec();
            let known = all.iter().any(|other| other.id == mistake.id);
            if known || !mistake.id.starts_with(&format!("{task}.")) {
                let id = mistake.id;
                return Err(CatalogueError::Id { path, id });
            }
            all.push(mistake);
        }
    }
    share_hints(&mut all)?;
    Ok(all)
}

/// Copies the texts that mistakes share, and checks the ids by which mistakes refer to each other.
fn share_hints(mistakes: &mut [Mistake]) -> Result<(), CatalogueError> {
    let texts: BTreeMap<String, (String, String)> = mistakes
        .iter()
        .filter(|mistake| mistake.same_hint_as.is_none())
        .map(|mistake| {
            let texts = (mistake.nudge.clone(), mistake.hint.clone());
            (mistake.id.clone(), texts)
        })
        .collect();
    let ids: BTreeSet<String> = mistakes.iter().map(|mistake| mistake.id.clone()).collect();
    for mistake in mistakes {
        let own_task = mistake.task();
        let is_complete = match &mistake.same_hint_as {
            None => !mistake.nudge.is_empty() && !mistake.hint.is_empty(),
            Some(other) => {
                let has_none = mistake.nudge.is_empty() && mistake.hint.is_empty();
                let same_task = Task::in_id(other) == Some(own_task);
                let shared = texts.get(other).filter(|_| has_none && same_task);
                shared.is_some_and(|(nudge, hint)| {
                    mistake.nudge.clone_from(nudge);
                    mistake.hint.clone_from(hint);
                    true
                })
            }
        };
        let others = mistake.also_true_of.iter();
        let mut others = others.chain(mistake.true_of_pairs.iter().flatten());
        let are_known = others.all(|other| ids.contains(other));
        if !is_complete || !are_known {
            return Err(CatalogueError::Texts {
                id: mistake.id.clone(),
            });
        }
    }
    Ok(())
}

/// Reads the `[[mistake]]` entries of the TOML files in a folder, in the order of the files, each with
/// the path of its file. There are none if the folder does not exist.
pub(super) fn read_mistakes<T: DeserializeOwned>(
    folder: &Path,
) -> Result<Vec<(PathBuf, T)>, CatalogueError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File<T> {
        mistake: Vec<T>,
    }

    if !folder.exists() {
        return Ok(Vec::new());
    }
    let mut all = Vec::new();
    for path in files::read_dir(folder)? {
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let file: File<T> = read_toml(&path)?;
            all.extend(
                file.mistake
                    .into_iter()
                    .map(|mistake| (path.clone(), mistake)),
            );
        }
    }
    Ok(all)
}

impl Mistake {
    /// Returns the task that must lose points.
    pub fn task(&self) -> Task {
        Task::in_id(&self.id).expect("ids were checked when they were read")
    }

    /// Returns the tasks that may lose points: the mistake's own, and the others that it declares.
    pub fn tasks(&self) -> impl Iterator<Item = Task> {
        std::iter::once(self.task()).chain(self.other_tasks.iter().copied())
    }

    /// Returns the reference with this mistake.
    pub fn apply(&self, reference: &Sources) -> Result<Sources, CatalogueError> {
        let handed_out = reference.handed_out();
        let own_file = handed_out.assignment.info(self.task()).file;
        let sources = reference.clone();
        apply_changes(sources, &self.changes, own_file, |file, count| {
            CatalogueError::DoesNotApply {
                id: self.id.clone(),
                file: format!("{}/{file}", handed_out.reference),
                count,
            }
        })
    }
}

/// Applies changes to a solution: to `own_file`, or to the files that they name. A text that does
/// not occur exactly once is an error, which `does_not_apply` makes of the file and the number of
/// occurrences.
pub(super) fn apply_changes<E>(
    mut sources: Sources,
    changes: &[Change],
    own_file: &str,
    does_not_apply: impl Fn(&str, usize) -> E,
) -> Result<Sources, E> {
    for change in changes {
        let file = change.file.as_deref().unwrap_or(own_file);
        let text = sources.text(file).unwrap_or_default();
        let count = text.matches(&change.was).count();
        if count != 1 {
            return Err(does_not_apply(file, count));
        }
        let text = text.replacen(&change.was, &change.now, 1);
        sources = sources.with_file(file, text);
    }
    Ok(sources)
}
