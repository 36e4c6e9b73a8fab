//! Validates YAML files with published JSON schemas.

use std::fs;
use std::path::Path;

use boon::{Compiler, SchemaIndex, Schemas};
use serde_json::Value;

/// A published schema. See `tests/schemas/README.md`.
pub struct Schema {
    schemas: Schemas,
    index: SchemaIndex,
}

impl Schema {
    /// Reads a schema in `tests/schemas`.
    pub fn read(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/schemas");
        let text = fs::read(folder.join(name)).unwrap();
        let schema: Value = serde_json::from_slice(&text).unwrap();
        let (mut schemas, mut compiler) = (Schemas::new(), Compiler::new());
        compiler.add_resource(name, schema).unwrap();
        let index = compiler.compile(name, &mut schemas);
        let index = index.unwrap_or_else(|error| panic!("{name}: {error:#}"));
        Schema { schemas, index }
    }

    /// Returns the problems with a document and the paths of the invalid values, or `None` if the
    /// document is valid.
    pub fn problems(&self, document: &Value) -> Option<String> {
        let checked = self.schemas.validate(document, self.index);
        checked.err().map(|error| format!("{error:#}"))
    }

    /// Panics if a document has problems.
    pub fn check(&self, title: &str, document: &Value) {
        if let Some(problems) = self.problems(document) {
            panic!("{title}: {problems}");
        }
    }

    /// Panics if the schema accepts `text` after its first `from` is replaced with `to`.
    pub fn check_that_it_rejects(&self, text: &str, from: &str, to: &str) {
        assert!(text.contains(from), "the text no longer contains {from:?}");
        let problems = self.problems(&parse_yaml(&text.replacen(from, to, 1)));
        assert!(problems.is_some(), "{to:?} instead of {from:?}");
    }
}

/// Parses YAML. Panics if it is invalid.
pub fn parse_yaml(text: &str) -> Value {
    serde_saphyr::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}
