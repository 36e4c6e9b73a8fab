//! Validates YAML files with published JSON schemas.

use std::fs;
use std::path::Path;

use jsonschema::Validator;
use serde_json::Value;

/// A published schema: see `tests/schemas/README.md`.
pub struct Schema(Validator);

impl Schema {
    /// Reads a schema in `tests/schemas`.
    pub fn read(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/schemas");
        let text = fs::read(folder.join(name)).unwrap();
        let schema: Value = serde_json::from_slice(&text).unwrap();
        Schema(jsonschema::validator_for(&schema).unwrap())
    }

    /// Returns the problems of a document, each with the path of the value.
    pub fn problems(&self, document: &Value) -> Vec<String> {
        let errors = self.0.iter_errors(document);
        errors
            .map(|error| format!("{}: {error}", error.instance_path()))
            .collect()
    }

    /// Panics if a document has problems.
    pub fn check(&self, title: &str, document: &Value) {
        let problems = self.problems(document);
        assert!(problems.is_empty(), "{title}: {problems:#?}");
    }

    /// Panics if the schema accepts a text in which `from` was replaced by `to`.
    pub fn check_that_it_rejects(&self, text: &str, from: &str, to: &str) {
        assert!(text.contains(from), "the text no longer contains {from:?}");
        let problems = self.problems(&parse_yaml(&text.replacen(from, to, 1)));
        assert!(!problems.is_empty(), "{to:?} instead of {from:?}");
    }
}

/// Parses YAML, and panics if it is invalid.
pub fn parse_yaml(text: &str) -> Value {
    serde_saphyr::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}
