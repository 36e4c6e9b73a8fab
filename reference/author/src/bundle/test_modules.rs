//! Removes test modules from a bundle. The framework's tests need a submission that students don't
//! have.

use crate::bundle::Bundle;

/// The attribute on the line above the declaration of a test module.
const CFG_TEST: &str = "#[cfg(test)]";

/// Removes every test module that has its own file, along with the module's declaration.
pub(super) fn remove(bundle: &mut Bundle) {
    let sources: Vec<String> = bundle.files.keys().cloned().collect();
    for path in sources.iter().filter(|path| path.ends_with(".rs")) {
        let (text, modules) = without_test_modules(bundle.text(path).unwrap_or_default());
        if modules.is_empty() {
            continue;
        }
        for module in modules {
            let stem = format!("{}{module}", module_folder(path));
            let (file, below) = (format!("{stem}.rs"), format!("{stem}/"));
            bundle
                .files
                .retain(|path, _| *path != file && !path.starts_with(&below));
        }
        // The file may itself have been part of a removed module.
        if bundle.files.contains_key(path) {
            bundle.insert(path, text);
        }
    }
}

/// Returns the folder of the modules that a file declares.
fn module_folder(path: &str) -> String {
    let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
    match name {
        "mod.rs" | "lib.rs" | "main.rs" => format!("{folder}/"),
        name => format!("{folder}/{}/", name.trim_end_matches(".rs")),
    }
}

/// Returns the text without its `#[cfg(test)] mod NAME;` declarations, and the names they declare.
fn without_test_modules(text: &str) -> (String, Vec<String>) {
    let named = |line: &str| {
        let module = line.strip_prefix("pub(crate) ").unwrap_or(line);
        let name = module.strip_prefix("mod ")?.strip_suffix(';')?;
        Some(name.to_owned())
    };
    let (mut kept, mut names) = (String::with_capacity(text.len()), Vec::new());
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        match lines.peek().and_then(|next| named(next)) {
            Some(name) if line == CFG_TEST => {
                names.push(name);
                lines.next();
            }
            _ => kept.extend([line, "\n"]),
        }
    }
    (kept, names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn removes_a_test_module_with_its_file_and_declaration() {
        let mut bundle = Bundle::default();
        bundle.insert(
            "f/src/lib.rs",
            "mod a;\n#[cfg(test)]\npub(crate) mod helpers;\nmod b;\n",
        );
        bundle.insert("f/src/helpers.rs", "");
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
            "inline test modules are kept"
        );
    }
}
