//! One hostile submission: what it changes in an honest one, and what may come of it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use grader::sandbox::Isolation;
use serde::Deserialize;

use crate::canary::Canaries;
use crate::packaging::{Packaging, pack};

const TASK_FILES: [&str; 5] = ["camera.rs", "triangle.rs", "sphere.rs", "bbox.rs", "bvh.rs"];
/// What is put into one of the five. All other files lie beside them, or in their place.
const ATTACK_FILE: &str = "attack.rs";
const EXPECT_FILE: &str = "expect.toml";

/// A folder of `entries/`.
pub struct Entry {
    pub name: String,
    pub expect: Expectation,
    folder: Option<PathBuf>,
}

/// `expect.toml`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// In words: "It ...".
    pub does: String,
    /// Below this level it is known to do harm, and is passed over.
    #[serde(default = "Expectation::any_level")]
    pub least: Isolation,
    /// The honest files that it changes.
    #[serde(default)]
    base: Base,
    /// The file that `attack.rs` is put at the end of.
    into: Option<String>,
    /// The methods of that file in which `attack()` is called first of all.
    #[serde(default)]
    within: Vec<String>,
    /// What is called there.
    #[serde(default = "Expectation::default_call")]
    call: String,
    /// As what it is handed in, if not as a folder.
    pack: Option<Packaging>,
    /// Words of the reason why it is not graded at all.
    pub refused: Option<String>,
    /// The most points of each task that it touches. Every other task has what is honest.
    #[serde(default)]
    pub points: BTreeMap<String, u64>,
    /// What may become of the items of those tasks that are not passed.
    #[serde(default)]
    pub verdicts: Vec<String>,
    /// What the report must say.
    pub says: Option<String>,
    /// In seconds.
    #[serde(default = "default_wall_seconds")]
    wall: u64,
    /// Not among the quick ones.
    #[serde(default)]
    pub slow: bool,
    #[serde(default)]
    pub arguments: Vec<String>,
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

/// Some ten times what one takes on a machine of its own: nobody else's load shall break an entry.
fn default_wall_seconds() -> u64 {
    240
}

impl Entry {
    /// All entries, by name.
    pub fn all(folder: &Path) -> Vec<Self> {
        let mut folders: Vec<PathBuf> = fs::read_dir(folder)
            .expect("there is a corpus")
            .map(|entry| entry.expect("it can be read").path())
            .collect();
        folders.sort();
        folders.into_iter().map(Entry::read).collect()
    }

    fn read(folder: PathBuf) -> Self {
        let name = folder.file_name().expect("it has a name");
        let name = name.to_string_lossy().into_owned();
        let text = fs::read_to_string(folder.join(EXPECT_FILE))
            .unwrap_or_else(|error| panic!("{name}/{EXPECT_FILE}: {error}"));
        Entry {
            expect: toml::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}")),
            folder: Some(folder),
            name,
        }
    }

    /// The reference as it stands.
    pub fn reference() -> Self {
        Entry {
            name: "honest".to_owned(),
            expect: toml::from_str("does = 'It is right.'\nwall = 300").expect("it is good"),
            folder: None,
        }
    }

    pub fn wall(&self) -> Duration {
        Duration::from_secs(self.expect.wall)
    }

    /// The points of camera, triangle, sphere, bbox, build, traverse without the attack.
    pub fn base_points(&self) -> [(&'static str, u64); 6] {
        let tasks = [
            ("camera", 15),
            ("triangle", 20),
            ("sphere", 15),
            ("bbox", 10),
            ("build", 20),
            ("traverse", 20),
        ];
        match self.expect.base {
            Base::Reference => tasks,
            Base::Starter => tasks.map(|(task, _)| (task, 0)),
        }
    }

    /// Writes the submission into a new folder; returns what is handed in. `places` are what its text
    /// names as `@NAME@`.
    pub fn write(&self, place: &Path, canaries: &Canaries) -> PathBuf {
        self.write_folder(place, &canaries.placeholders());
        match self.expect.pack {
            Some(how) => pack(place, how, &canaries.key_file()),
            None => place.to_owned(),
        }
    }

    fn write_folder(&self, place: &Path, places: &[(&str, String)]) {
        let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let honest = match self.expect.base {
            Base::Reference => project.join("reference/src"),
            Base::Starter => project.join("grader/starter"),
        };
        fs::create_dir_all(place).expect("a folder");
        for file in TASK_FILES {
            fs::copy(honest.join(file), place.join(file)).expect("a file");
        }
        let Some(folder) = &self.folder else {
            return;
        };
        copy_with_placeholders_filled(folder, place, places);
        if let Some(into) = &self.expect.into {
            let mut text = fs::read_to_string(place.join(into)).expect("one of the five");
            for method in &self.expect.within {
                text = insert_first_statement(&text, method, &self.expect.call);
            }
            let attack = fs::read_to_string(folder.join(ATTACK_FILE)).expect("an attack");
            text.push_str(&fill_placeholders(&attack, places));
            fs::write(place.join(into), text).expect("a file");
        }
    }
}

/// All that lies in an entry's folder beside the attack, folders too.
fn copy_with_placeholders_filled(folder: &Path, place: &Path, places: &[(&str, String)]) {
    for file in fs::read_dir(folder).expect("it was read").flatten() {
        let (name, path) = (file.file_name(), file.path());
        if path.is_dir() {
            fs::create_dir_all(place.join(&name)).expect("a folder");
            copy_with_placeholders_filled(&path, &place.join(name), places);
        } else if name != ATTACK_FILE && name != EXPECT_FILE {
            let text = fs::read_to_string(path).expect("text");
            fs::write(place.join(name), fill_placeholders(&text, places)).expect("a file");
        }
    }
}

/// The text with a call as the first statement of a method.
fn insert_first_statement(text: &str, method: &str, call: &str) -> String {
    let start = text
        .find(&format!("fn {method}("))
        .unwrap_or_else(|| panic!("there is no method {method}"));
    let body = start + text[start..].find("{\n").expect("it has a body") + 2;
    format!("{}        {call}\n{}", &text[..body], &text[body..])
}

/// `@NAME@` becomes the place, `@{1000x(}` a thousand parentheses.
fn fill_placeholders(text: &str, places: &[(&str, String)]) -> String {
    let mut text = text.to_owned();
    for (name, place) in places {
        text = text.replace(&format!("@{name}@"), place);
    }
    while let Some(start) = text.find("@{") {
        let end = start + text[start..].find('}').expect("it is closed");
        let (count, what) = text[start + 2..end].split_once('x').expect("COUNTxTEXT");
        let repeated = what.repeat(count.parse().expect("a count"));
        text.replace_range(start..=end, &repeated);
    }
    text
}
