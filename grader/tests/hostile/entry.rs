//! Describes one hostile submission: its changes to a correct submission, and its permitted
//! results.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use grader::handed_out::{HandedOut, RAYS};
use grader::sandbox::Isolation;
use serde::Deserialize;

use crate::canary::Canaries;
use crate::packaging::{Packaging, pack};

/// In an entry with several files, the file whose text is appended to a task file. All other files,
/// except the description, are added to the task files or replace them.
const ATTACK_FILE: &str = "attack.rs";
const EXPECT_FILE: &str = "expect.toml";
/// The file that describes the entries without files of their own.
const PACKAGED_FILE: &str = "packaged.toml";
/// The prefix of the lines that describe an entry.
const DESCRIPTION: &str = "//!";
/// A function that converts a value to a different type via a soundness hole in the language.
const HOLE: &str = include_str!("hole.rs");

/// A hostile submission, read from `entries/`.
#[derive(Clone)]
pub struct Entry {
    pub name: String,
    pub expect: Expectation,
    /// The assignment that is handed in.
    handed_out: &'static HandedOut,
    /// The text that is appended to a task file.
    attack: String,
    /// The folder of an entry with several files.
    folder: Option<PathBuf>,
}

/// The description of an entry.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// A description of the attack in one sentence: "It …".
    pub does: String,
    /// The lowest isolation level that withstands this attack. The attack is skipped at lower
    /// levels.
    #[serde(default = "Expectation::any_level")]
    pub least: Isolation,
    /// The task files that the attack is added to.
    #[serde(default)]
    base: Base,
    /// The task file that the attack is appended to.
    into: Option<String>,
    /// Other task files that get the same text and the same calls.
    #[serde(default)]
    also_into: Vec<String>,
    /// Whether the attack calls the function in `hole.rs`.
    #[serde(default)]
    uses_hole: bool,
    /// The methods that get `call` as their first statement, in the file that the attack is
    /// appended to.
    #[serde(default)]
    within: Vec<String>,
    /// The statement to insert at the beginning of the methods in `within`.
    #[serde(default = "Expectation::default_call")]
    call: String,
    /// The form in which the entry is submitted. `None` for a plain folder.
    pack: Option<Packaging>,
    /// Part of the error message, if the entry is rejected without being graded.
    pub refused: Option<String>,
    /// The maximum number of points for each task affected by the attack. All other tasks must get
    /// the same points as without the attack.
    #[serde(default)]
    pub points: BTreeMap<String, u64>,
    /// The permitted verdicts, in addition to `pass`, for the items of the tasks in `points`.
    #[serde(default)]
    pub verdicts: Vec<String>,
    /// Text that the report must contain.
    pub says: Option<String>,
    /// The maximum wall time, in seconds.
    #[serde(default = "default_wall_seconds")]
    wall: u64,
    /// Whether the entry only runs with `--all` or when it is named on the command line.
    #[serde(default)]
    pub slow: bool,
    #[serde(default)]
    pub arguments: Vec<String>,
    /// The places in other assignments, by assignment id, that the attack is also run at.
    #[serde(default)]
    also: BTreeMap<String, Target>,
}

/// The place of an attack in another assignment.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Target {
    /// The task file that the attack is appended to.
    into: String,
    /// The methods that get `call` as their first statement.
    within: Vec<String>,
    /// See [`Expectation::call`].
    #[serde(default = "Expectation::default_call")]
    call: String,
    /// See [`Expectation::points`].
    #[serde(default)]
    points: BTreeMap<String, u64>,
}

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Base {
    #[default]
    Reference,
    Starter,
}

impl Expectation {
    fn any_level() -> Isolation {
        Isolation::None
    }

    fn default_call() -> String {
        "attack();".to_owned()
    }
}

/// Returns the default wall time limit: about ten times as long as an entry takes on an idle
/// machine, so that entries don't fail on a busy one.
fn default_wall_seconds() -> u64 {
    240
}

impl Entry {
    /// Reads all entries, sorted by name.
    pub fn all(folder: &Path) -> Vec<Self> {
        let mut entries = Entry::packaged(&read(&folder.join(PACKAGED_FILE)));
        let paths = fs::read_dir(folder).expect("the corpus exists");
        let paths = paths.map(|entry| entry.expect("the folder can be read").path());
        let others = paths.filter(|path| !path.ends_with(PACKAGED_FILE));
        entries.extend(others.map(Entry::read));
        let elsewhere: Vec<Entry> = entries.iter().flat_map(Entry::elsewhere).collect();
        entries.extend(elsewhere);
        entries.sort_by(|one, other| one.name.cmp(&other.name));
        entries
    }

    /// Reads an entry that is a file or a folder.
    fn read(path: PathBuf) -> Self {
        let name = path.file_stem().expect("the entry has a name");
        let name = name.to_string_lossy().into_owned();
        let (description, attack, folder) = if path.is_dir() {
            let attack = fs::read_to_string(path.join(ATTACK_FILE)).unwrap_or_default();
            (read(&path.join(EXPECT_FILE)), attack, Some(path))
        } else {
            let text = read(&path);
            let lines = text.split_inclusive('\n');
            let (description, attack): (Vec<&str>, Vec<&str>) =
                lines.partition(|line| line.starts_with(DESCRIPTION));
            let description = description.concat().replace(DESCRIPTION, "");
            (description, attack.concat(), None)
        };
        Entry {
            handed_out: &RAYS,
            expect: toml::from_str(&description).unwrap_or_else(|error| panic!("{name}: {error}")),
            attack,
            folder,
            name,
        }
    }

    /// Reads the entries without files.
    fn packaged(descriptions: &str) -> Vec<Self> {
        let descriptions: BTreeMap<String, Expectation> =
            toml::from_str(descriptions).unwrap_or_else(|error| panic!("{PACKAGED_FILE}: {error}"));
        let entry = |(name, expect)| Entry {
            name,
            expect,
            handed_out: &RAYS,
            attack: String::new(),
            folder: None,
        };
        descriptions.into_iter().map(entry).collect()
    }

    /// Returns the same attack on each of the other assignments that its description names.
    fn elsewhere(&self) -> impl Iterator<Item = Entry> {
        self.expect.also.iter().map(|(assignment, target)| {
            let target = target.clone();
            Entry {
                name: format!("{} in {assignment}", self.name),
                handed_out: HandedOut::find(assignment).expect("the id of an assignment"),
                expect: Expectation {
                    into: Some(target.into),
                    within: target.within,
                    call: target.call,
                    points: target.points,
                    ..self.expect.clone()
                },
                ..self.clone()
            }
        })
    }

    /// Returns an entry that submits an assignment's unchanged reference.
    pub fn reference(handed_out: &'static HandedOut) -> Self {
        Entry {
            name: "reference".to_owned(),
            handed_out,
            expect: toml::from_str("does = 'It is correct.'\nwall = 300").expect("valid TOML"),
            attack: String::new(),
            folder: None,
        }
    }

    pub fn wall(&self) -> Duration {
        Duration::from_secs(self.expect.wall)
    }

    /// Returns the points that each task gets without the attack.
    pub fn base_points(&self) -> impl Iterator<Item = (&'static str, u64)> {
        let full = |points| match self.expect.base {
            Base::Reference => u64::from(points),
            Base::Starter => 0,
        };
        let tasks = self.handed_out.assignment.tasks.iter();
        tasks.map(move |task| (task.id, full(task.points)))
    }

    /// Writes the submission into a new folder and fills in the `@NAME@` placeholders in its text.
    /// Returns the path to submit.
    pub fn write(&self, folder: &Path, canaries: &Canaries) -> PathBuf {
        self.write_folder(folder, &canaries.placeholders());
        match self.expect.pack {
            Some(packaging) => pack(folder, packaging, &canaries.key_file()),
            None => folder.to_owned(),
        }
    }

    fn write_folder(&self, target: &Path, placeholders: &[(&str, String)]) {
        let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let base = project.join(match self.expect.base {
            Base::Reference => self.handed_out.reference,
            Base::Starter => self.handed_out.starter,
        });
        fs::create_dir_all(target).expect("the folder can be created");
        for file in self.handed_out.file_names() {
            fs::copy(base.join(file), target.join(file)).expect("the file can be copied");
        }
        if let Some(folder) = &self.folder {
            copy_with_placeholders_filled(folder, target, placeholders);
        }
        for into in self.expect.into.iter().chain(&self.expect.also_into) {
            let mut text = fs::read_to_string(target.join(into)).expect("a task file");
            for method in &self.expect.within {
                text = insert_first_statement(&text, method, &self.expect.call);
            }
            if self.expect.uses_hole {
                text.push_str(HOLE);
            }
            text.push_str(&fill_placeholders(&self.attack, placeholders));
            fs::write(target.join(into), text).expect("the file can be written");
        }
    }
}

/// Copies the files in an entry's folder and its subfolders, except `attack.rs` and `expect.toml`,
/// and fills in their placeholders.
fn copy_with_placeholders_filled(folder: &Path, target: &Path, placeholders: &[(&str, String)]) {
    for file in fs::read_dir(folder)
        .expect("the folder can be read")
        .flatten()
    {
        let (name, path) = (file.file_name(), file.path());
        if path.is_dir() {
            fs::create_dir_all(target.join(&name)).expect("the folder can be created");
            copy_with_placeholders_filled(&path, &target.join(name), placeholders);
        } else if name != ATTACK_FILE && name != EXPECT_FILE {
            let text = fs::read_to_string(path).expect("the file is text");
            fs::write(target.join(name), fill_placeholders(&text, placeholders))
                .expect("the file can be written");
        }
    }
}

/// Returns the text of a file.
fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Inserts a call as the first statement of a method.
fn insert_first_statement(text: &str, method: &str, call: &str) -> String {
    let start = text
        .find(&format!("fn {method}("))
        .unwrap_or_else(|| panic!("there is no method {method}"));
    let body = start + text[start..].find("{\n").expect("the method has a body") + 2;
    format!("{}        {call}\n{}", &text[..body], &text[body..])
}

/// Replaces each `@NAME@` with the value given for that name and, for example, `@{1000x(}` with a
/// thousand parentheses.
fn fill_placeholders(text: &str, placeholders: &[(&str, String)]) -> String {
    let mut text = text.to_owned();
    for (name, value) in placeholders {
        text = text.replace(&format!("@{name}@"), value);
    }
    while let Some(start) = text.find("@{") {
        let end = start + text[start..].find('}').expect("the brace is closed");
        let (count, repeated) = text[start + 2..end].split_once('x').expect("COUNTxTEXT");
        let repeated = repeated.repeat(count.parse().expect("a count"));
        text.replace_range(start..=end, &repeated);
    }
    text
}
