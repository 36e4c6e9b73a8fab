//! The items that each known mistake fails regardless of the seed, as listed in `fails.toml` in the
//! folder of the mistakes. The file is generated because it isn't obvious which items a mistake
//! fails only with some seeds.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Result, anyhow};
use grader::handed_out::HandedOut;
use serde::{Deserialize, Serialize};

use crate::generated_file::GeneratedFile;
use crate::solutions::read_toml;

/// The path of the file, relative to the folder of an assignment's solutions.
pub const FILE: &str = "mistakes/fails.toml";

/// The items that each known mistake fails regardless of the seed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FailedItems {
    /// The number of seeds that the lists were made with, starting at seed 0. The practice exam was
    /// used as well.
    pub seeds: u64,
    /// The ids of the failed items in exam order, keyed by the mistake's id.
    pub fails: BTreeMap<String, Vec<String>>,
}

impl FailedItems {
    /// Reads an assignment's file from the workspace at `root`. If the file is missing, returns
    /// empty lists, so that it can be generated again.
    pub fn load(root: &Path, handed_out: &HandedOut) -> Result<Self> {
        let path = root.join(path(handed_out));
        if !path.exists() {
            return Ok(FailedItems::default());
        }
        read_toml(&path).map_err(|error| anyhow!("{error}; run `cargo author mistakes`"))
    }

    /// Returns the items that a mistake fails, or none if the mistake isn't in the file.
    pub fn of_mistake(&self, id: &str) -> &[String] {
        self.fails.get(id).map_or(&[], Vec::as_slice)
    }

    /// Returns the file. It lists one item per line, so that a diff shows which items changed.
    pub fn generated_file(&self, handed_out: &HandedOut) -> Result<GeneratedFile> {
        let lists = toml::to_string_pretty(self)?;
        let text = format!(
            "# Written by `cargo author mistakes`: the items that each mistake fails in the \
             practice exam\n# and in the exams of this many seeds, from 0. Do not edit.\n{lists}"
        );
        Ok(GeneratedFile::new(path(handed_out), text))
    }
}

/// Returns the path of an assignment's file, relative to the workspace's root.
fn path(handed_out: &HandedOut) -> String {
    format!("{}/{FILE}", handed_out.solutions())
}

#[cfg(test)]
mod tests {
    use grader::handed_out::RAYS;

    use super::*;

    #[test]
    fn the_generated_file_is_read_back() {
        let fails = [
            ("bbox.none".to_owned(), vec!["bbox.through".to_owned()]),
            ("sphere.hidden".to_owned(), Vec::new()),
        ];
        let failed = FailedItems {
            seeds: 100,
            fails: fails.into(),
        };
        let file = failed.generated_file(&RAYS).unwrap();
        let root = tempfile::tempdir().unwrap();
        assert_eq!(
            FailedItems::load(root.path(), &RAYS).unwrap(),
            FailedItems::default()
        );
        let path = root.path().join(&file.path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, file.contents).unwrap();
        assert_eq!(FailedItems::load(root.path(), &RAYS).unwrap(), failed);
        assert_eq!(failed.of_mistake("bbox.none"), ["bbox.through"]);
        assert_eq!(failed.of_mistake("bbox.new"), [""; 0]);
    }
}
