//! Modules that only tests need stay here: those of the framework draw with a submission of ours.

use crate::bundle::Bundle;

/// What stands above such a module, in a line of its own.
const CFG_TEST: &str = "#[cfg(test)]";

/// Takes away every test module with a file of its own, and the lines that name it.
pub(super) fn remove(bundle: &mut Bundle) {
    let sources: Vec<String> = bundle.files.keys().cloned().collect();
    for path in sources.iter().filter(|path| path.ends_with(".rs")) {
        let (text, modules) = without_test_modules(bundle.text(path).unwrap_or_default());
        if modules.is_empty() {
            continue;
        }
        for module in modules {
            let place = format!("{}{module}", module_folder(path));
            let (file, below) = (format!("{place}.rs"), format!("{place}/"));
            bundle
                .files
                .retain(|path, _| *path != file && !path.starts_with(&below));
        }
        // Unless it was itself below one of those.
        if bundle.files.contains_key(path) {
            bundle.insert(path, text);
        }
    }
}

/// Where the files of a file's modules lie.
fn module_folder(path: &str) -> String {
    let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
    match name {
        "mod.rs" | "lib.rs" | "main.rs" => format!("{folder}/"),
        name => format!("{folder}/{}/", name.trim_end_matches(".rs")),
    }
}

/// The text without `#[cfg(test)] mod NAME;`, and those names.
fn without_test_modules(text: &str) -> (String, Vec<String>) {
    let lines: Vec<&str> = text.lines().collect();
    let named = |line: &&str| {
        let name = line.strip_prefix("mod ")?.strip_suffix(';')?;
        Some(name.to_owned())
    };
    let mut kept = String::with_capacity(text.len());
    let mut names = Vec::new();
    let mut rest = lines.as_slice();
    while let [line, after @ ..] = rest {
        let name = after.first().and_then(named);
        if let (CFG_TEST, Some(name)) = (*line, name) {
            names.push(name);
            rest = &after[1..];
            continue;
        }
        kept.extend([line, "\n"]);
        rest = after;
    }
    (kept, names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn removes_a_test_module_with_its_file_and_declaration() {
        let mut bundle = Bundle::default();
        bundle.insert("f/src/lib.rs", "mod a;\n#[cfg(test)]\nmod balls;\nmod b;\n");
        bundle.insert("f/src/balls.rs", "");
        bundle.insert("f/src/a.rs", "fn f() {}\n\n#[cfg(test)]\nmod tests;\n");
        bundle.insert("f/src/a/tests.rs", "");
        bundle.insert("f/src/b.rs", "#[cfg(test)]\nmod tests {}\n");
        remove(&mut bundle);
        let paths: Vec<&String> = bundle.files.keys().collect();
        assert_eq!(paths, ["f/src/a.rs", "f/src/b.rs", "f/src/lib.rs"]);
        assert_eq!(bundle.text("f/src/lib.rs"), Some("mod a;\nmod b;\n"));
        assert_eq!(
            bundle.text("f/src/b.rs"),
            Some("#[cfg(test)]\nmod tests {}\n"),
            "one inside the file stays"
        );
    }
}
