//! Each module of a crate only uses modules that are further down in the table of layers in the
//! crate's `lib.rs`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The sources of the crates whose modules are in layers.
const SOURCES: [&str; 3] = [
    concat!(env!("CARGO_MANIFEST_DIR"), "/src"),
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../grader/class/src"),
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../grader/view/src"),
];

/// Returns each module's row in the table of layers.
fn layers(source: &Path) -> BTreeMap<String, usize> {
    let text = fs::read_to_string(source.join("lib.rs")).unwrap();
    let rows = text.lines().filter(|line| line.starts_with("//! | "));
    let modules = rows.enumerate().flat_map(|(row, line)| {
        let names = line.split("[`").skip(1);
        names.map(move |name| (name.split('`').next().unwrap().to_owned(), row))
    });
    modules.collect()
}

/// Returns the modules that a file or folder uses, except in its tests.
fn used_modules(path: &Path) -> BTreeSet<String> {
    if path.is_dir() {
        let entries = fs::read_dir(path).unwrap();
        return entries
            .flat_map(|entry| used_modules(&entry.unwrap().path()))
            .collect();
    }
    let is_tests = path.ends_with("tests.rs");
    if is_tests || path.extension().is_none_or(|extension| extension != "rs") {
        return BTreeSet::new();
    }
    let text = fs::read_to_string(path).unwrap();
    let code = text.split("#[cfg(test)]").next().unwrap();
    let code = code.lines().filter(|line| !line.trim().starts_with("//"));
    let names = code.flat_map(|line| line.split("crate::").skip(1));
    let is_end = |c: char| !c.is_alphanumeric() && c != '_';
    names
        .map(|name| name.split(is_end).next().unwrap().to_owned())
        .collect()
}

#[test]
fn every_module_is_in_the_table() {
    for source in SOURCES.map(Path::new) {
        let text = fs::read_to_string(source.join("lib.rs")).unwrap();
        let modules = text
            .lines()
            .filter_map(|line| line.strip_prefix("pub mod "));
        let modules: BTreeSet<&str> = modules.map(|name| name.trim_end_matches(';')).collect();
        let layers = layers(source);
        assert_eq!(
            layers.keys().map(String::as_str).collect::<BTreeSet<_>>(),
            modules
        );
    }
}

#[test]
fn modules_use_only_lower_layers() {
    let crates = SOURCES.map(|source| (Path::new(source), layers(Path::new(source))));
    let modules = crates.iter().flat_map(|(source, layers)| {
        let rows = layers.iter();
        rows.map(move |(module, layer)| (source, layers, module, layer))
    });
    for (source, layers, module, layer) in modules {
        let paths = [source.join(module), source.join(format!("{module}.rs"))];
        let paths = paths.iter().filter(|path| path.exists());
        let mut used: BTreeSet<String> = paths.flat_map(|path| used_modules(path)).collect();
        used.remove(module);
        for other in used {
            let is_below = layers.get(&other).is_some_and(|other| other > layer);
            assert!(is_below, "{module} uses {other}, which is not below it");
        }
    }
}
