//! Known mistakes, as small changes to the reference: `reference/mistakes/TASK/*.toml`.

use std::fs;
use std::path::{Path, PathBuf};

use grader::exam::Task;
use grader::section::Section;
use serde::Deserialize;

use crate::proof::sources::{ReadError, Sources, read};

/// A known wrong solution.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// The task's id, a dot, and a name: `sphere.far_first`.
    pub id: String,
    /// What such code does.
    pub title: String,
    /// Where real people were seen to make it: numbers of the list in `reference/mistakes/README.md`.
    #[serde(default)]
    pub seen: Vec<String>,
    /// For students: a question that leads there.
    pub nudge: String,
    /// For students: what is wrong, in words.
    pub hint: String,
    /// The section of the handout that teaches it, where that is not what teaches the items that
    /// show it.
    #[serde(default)]
    pub section: Option<Section>,
    /// The items that it fails, whatever the seed.
    pub fails: Vec<String>,
    /// What makes the reference wrong; nearly always one change.
    #[serde(rename = "change")]
    pub changes: Vec<Change>,
}

/// Another text in the place of one that stands in a file exactly once.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// Which of the five files; without one, the task's own.
    pub file: Option<String>,
    /// As it stands in the reference.
    pub was: String,
    /// As the mistake has it.
    pub now: String,
}

/// The catalogue can not be used.
#[derive(Debug, thiserror::Error)]
pub enum CatalogueError {
    /// A file or folder can not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A file is not a catalogue.
    #[error("{}: {source}", path.display())]
    Toml {
        /// Which.
        path: PathBuf,
        /// Line, column, and what is wrong there.
        source: toml::de::Error,
    },
    /// An id is not as it has to be.
    #[error("{}: the id `{id}` has no task before its dot, or stands twice", path.display())]
    Id {
        /// Where.
        path: PathBuf,
        /// The id.
        id: String,
    },
    /// The reference has changed under a mistake.
    #[error(
        "{id} does not apply any more: its `was` stands {count} times in reference/src/{file}; \
         adapt it in reference/mistakes"
    )]
    DoesNotApply {
        /// The mistake.
        id: String,
        /// The file that it changes.
        file: String,
        /// How often, where once is wanted.
        count: usize,
    },
}

/// All known mistakes of the workspace at `root`: by task, and then as they stand in the files.
pub fn mistakes(root: &Path) -> Result<Vec<Mistake>, CatalogueError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        mistake: Vec<Mistake>,
    }

    let mut all: Vec<Mistake> = Vec::new();
    for task in Task::ALL {
        for path in files(&root.join("reference/mistakes").join(task.id()))? {
            let file: File =
                toml::from_str(&read(&path)?).map_err(|source| CatalogueError::Toml {
                    path: path.clone(),
                    source,
                })?;
            for mistake in file.mistake {
                let known = all.iter().any(|other| other.id == mistake.id);
                if known || !mistake.id.starts_with(&format!("{task}.")) {
                    let id = mistake.id;
                    return Err(CatalogueError::Id { path, id });
                }
                all.push(mistake);
            }
        }
    }
    Ok(all)
}

fn files(folder: &Path) -> Result<Vec<PathBuf>, ReadError> {
    let entries = fs::read_dir(folder).map_err(|source| ReadError {
        path: folder.to_owned(),
        source,
    })?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| {
        path.extension()
            .is_some_and(|extension| extension == "toml")
    });
    paths.sort();
    Ok(paths)
}

impl Mistake {
    /// Whose points it must cost.
    pub fn task(&self) -> Task {
        let of = |task: &Task| self.id.split('.').next() == Some(task.id());
        let task = Task::ALL.into_iter().find(of);
        task.expect("ids were checked when they were read")
    }

    /// The tasks that may lose points: its own, and for two mistakes that hide each other those of
    /// the items that must fail.
    pub fn tasks(&self) -> Vec<Task> {
        let failed = |task: &Task| {
            let of_task = |id: &String| id.split('.').next() == Some(task.id());
            *task == self.task() || self.fails.iter().any(of_task)
        };
        Task::ALL.into_iter().filter(failed).collect()
    }

    /// The reference with this mistake.
    pub fn apply(&self, reference: &Sources) -> Result<Sources, CatalogueError> {
        let mut sources = reference.clone();
        for change in &self.changes {
            let file = change.file.as_deref().unwrap_or(self.task().file());
            let text = sources.text(file).unwrap_or_default();
            let times = text.matches(&change.was).count();
            if times != 1 {
                return Err(CatalogueError::DoesNotApply {
                    id: self.id.clone(),
                    file: file.to_owned(),
                    count: times,
                });
            }
            let text = text.replacen(&change.was, &change.now, 1);
            sources = sources.with_file(file, text);
        }
        Ok(sources)
    }
}
