//! Files of submissions, reports and classes are used through the seam `grader::disk`, so that tests
//! can make every operation fail. This finds calls of `std::fs` beside it.

use std::fs;
use std::path::Path;

use crate::harness::workspace;

/// The folders whose sources use the seam, and the paths in them that do not, with the reasons.
const FOLDERS: [(&str, &[&str]); 6] = [
    (
        "grader/class/src",
        &[
            // lists with `disk::before`, and asks for the kind of each entry
            "listing.rs",
            // ask only whether the input is a file or a folder, and how large
            "input.rs",
            "unpack.rs",
            // asks only whether a new folder is empty
            "similarity.rs",
        ],
    ),
    ("grader/src/format", &[]),
    ("grader/src/policy", &[]),
    // Asks before each of the operations of which a write consists.
    ("grader/src/report", &["atomic_write.rs"]),
    // Opens archives after asking, and the same file again to read it.
    (
        "grader/src/submission",
        &[
            "archive/mod.rs",
            "archive/tarball.rs",
            "archive/zip_reader.rs",
        ],
    ),
    ("grader/src/grade", &[]),
];

/// Returns the numbers of the lines that call `std::fs`, before the tests of a file.
fn calls(source: &str) -> Vec<usize> {
    let source = source.split("#[cfg(test)]").next().unwrap_or_default();
    let is_call = |line: &str| {
        ["fs::", "File::open", "File::create", "OpenOptions"]
            .iter()
            .any(|call| line.contains(call))
            && !line.trim_start().starts_with("use ")
            && !line.trim_start().starts_with("//")
    };
    let lines = (1..).zip(source.lines());
    lines
        .filter(|(_, line)| is_call(line))
        .map(|(number, _)| number)
        .collect()
}

fn collect(root: &Path, path: &Path, except: &[&str], found: &mut Vec<String>) {
    if path.is_dir() {
        for entry in fs::read_dir(path).unwrap() {
            collect(root, &entry.unwrap().path(), except, found);
        }
        return;
    }
    let name = path
        .strip_prefix(root)
        .unwrap()
        .to_string_lossy()
        .replace('\\', "/");
    let is_test = name.ends_with("tests.rs") || name.contains("/tests/");
    let is_source = name.ends_with(".rs") && !is_test;
    if is_source && !except.contains(&name.as_str()) {
        let source = fs::read_to_string(path).unwrap();
        let lines = calls(&source).into_iter();
        found.extend(lines.map(|line| format!("{}:{line}", path.display())));
    }
}

#[test]
fn files_are_used_through_the_seam() {
    let mut found = Vec::new();
    for (folder, except) in FOLDERS {
        let folder = workspace().join(folder);
        for name in except {
            assert!(
                folder.join(name).is_file(),
                "{name} is no longer an exception"
            );
        }
        collect(&folder, &folder, except, &mut found);
    }
    assert_eq!(found, [""; 0], "use grader::files instead");
}

#[test]
fn finds_a_call_beside_the_seam() {
    assert_eq!(
        calls("use std::fs;\nlet text = fs::read(path);\n// fs::\nFile::open(x)"),
        [2, 4]
    );
}

/// A jump of the clock cannot change a grade, because nothing reads the clock.
#[test]
fn nothing_that_decides_points_reads_the_clock() {
    let mut found = Vec::new();
    for (folder, _) in FOLDERS.into_iter().chain([("grader/judging/src", &[][..])]) {
        let mut folders = vec![workspace().join(folder)];
        while let Some(path) = folders.pop() {
            if path.is_dir() {
                folders.extend(
                    fs::read_dir(&path)
                        .unwrap()
                        .map(|entry| entry.unwrap().path()),
                );
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let source = fs::read_to_string(&path).unwrap();
                let clocks = ["SystemTime", "Timestamp::now", "Zoned::now", ".modified()"];
                if clocks.iter().any(|clock| source.contains(clock)) {
                    found.push(path);
                }
            }
        }
    }
    assert_eq!(found, [""; 0].map(std::path::PathBuf::from));
}
