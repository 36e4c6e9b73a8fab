//! The modules use each other only in the order of the table in `src/lib.rs`.

use std::fs;
use std::path::Path;

use crate::harness::workspace;

/// Returns the names that stand in backticks in the table.
fn modules_in_order(text: &str) -> Vec<&str> {
    let rows = text.lines().filter(|line| line.starts_with("//! | "));
    let names = rows.flat_map(|row| row.split('`').skip(1).step_by(2));
    names.map(|name| name.trim_start_matches("mod@")).collect()
}

/// Returns the code of a module, without tests and comments.
fn code(path: &Path) -> String {
    let name = path.file_stem().unwrap_or_default();
    if name == "tests" {
        return String::new();
    }
    if path.is_dir() {
        let entries = fs::read_dir(path).unwrap();
        return entries.map(|entry| code(&entry.unwrap().path())).collect();
    }
    if path.extension().is_none_or(|extension| extension != "rs") {
        return String::new();
    }
    let text = fs::read_to_string(path).unwrap();
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
    let lines = code.lines().filter(|line| !line.trim().starts_with("//"));
    lines.map(|line| format!("{line}\n")).collect()
}

#[test]
fn modules_use_only_those_below_them() {
    let source = workspace().join("grader/src");
    let text = fs::read_to_string(source.join("lib.rs")).unwrap();
    let modules = modules_in_order(&text);
    for line in text.lines().filter(|line| line.contains("mod ")) {
        let name = line.trim_end_matches(';').rsplit(' ').next().unwrap();
        let is_listed = modules.contains(&name);
        assert!(is_listed || line.starts_with("//"), "{name} is in no layer");
    }
    for (index, module) in modules.iter().enumerate() {
        let paths = [source.join(module), source.join(format!("{module}.rs"))];
        let paths = paths.iter().filter(|path| path.exists());
        let code: String = paths.map(|path| code(path)).collect();
        for above in &modules[..index] {
            let is_used = [":", ";", ","]
                .iter()
                .any(|end| code.contains(&format!("crate::{above}{end}")));
            assert!(!is_used, "{module} uses {above}, which is above it");
        }
    }
}
