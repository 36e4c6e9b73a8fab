//! The starter's files, embedded in this program: the five task files and the given files. Given
//! files in a submission are compared with these, but never used.

use judging::exam::Task;

/// One of the five files that students write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TaskFile {
    /// File name, such as `sphere.rs`.
    pub name: &'static str,
    /// Text of the starter's file.
    pub starter: &'static str,
    /// Declarations that other files use. If one is missing, the compiler reports errors in those
    /// files instead.
    pub required_declarations: &'static [&'static str],
}

/// The five task files, in lecture order.
pub const TASK_FILES: [TaskFile; 5] = [
    TaskFile {
        name: "camera.rs",
        starter: include_str!("../starter/camera.rs"),
        required_declarations: &["struct Camera", "fn new", "fn sample_ray"],
    },
    TaskFile {
        name: "triangle.rs",
        starter: include_str!("../starter/triangle.rs"),
        required_declarations: &["struct Triangle", "fn new", "fn bbox", "fn hit"],
    },
    TaskFile {
        name: "sphere.rs",
        starter: include_str!("../starter/sphere.rs"),
        required_declarations: &["struct Sphere", "fn new", "fn bbox", "fn hit"],
    },
    TaskFile {
        name: "bbox.rs",
        starter: include_str!("../starter/bbox.rs"),
        required_declarations: &["struct BBox", "EMPTY", "fn new", "fn hit"],
    },
    TaskFile {
        name: "bvh.rs",
        starter: include_str!("../starter/bvh.rs"),
        required_declarations: &[
            "struct Bvh",
            "struct Node",
            "fn leaf",
            "fn interior",
            "fn from_nodes",
            "fn build",
            "fn hit",
        ],
    },
];

/// Given files that are compiled with every submission.
pub const GIVEN_FILES: [(&str, &str); 3] = [
    ("lib.rs", include_str!("../starter/lib.rs")),
    ("primitive.rs", include_str!("../starter/primitive.rs")),
    ("world.rs", include_str!("../starter/world.rs")),
];

/// The given file `main.rs`, as its name and its text. It renders pictures, and the grader does
/// not use it.
pub const MAIN_FILE: (&str, &str) = ("main.rs", include_str!("../starter/main.rs"));

impl TaskFile {
    /// Returns the names of the given methods that `text` lacks or has changed. A note in the
    /// report lists them.
    pub fn changed_methods(&self, text: &str) -> Vec<&'static str> {
        let text = without_whitespace(text);
        let mut changed = Vec::new();
        for (name, method) in given_methods(self.starter) {
            if !text.contains(&without_whitespace(method)) {
                changed.push(name);
            }
        }
        changed
    }

    /// Returns the tasks whose points depend on this file.
    pub fn tasks(&self) -> impl Iterator<Item = Task> {
        let name = self.name;
        Task::ALL
            .into_iter()
            .filter(move |task| task.file() == name)
    }
}

/// Returns the methods that are complete in a starter file, as pairs of name and text. The text
/// extends from the signature to the closing brace.
fn given_methods(starter: &'static str) -> Vec<(&'static str, &'static str)> {
    const END: &str = "\n    }\n";
    let code = starter.split("#[cfg(test)]").next().unwrap_or(starter);
    let starts = code
        .match_indices("\n    pub fn ")
        .map(|(start, _)| start + 1);
    starts
        .filter_map(|start| {
            let method = &code[start..start + code[start..].find(END)? + END.len()];
            let name = method.trim_start().strip_prefix("pub fn ")?;
            let name = &name[..name.find('(')?];
            let to_write = ["sample_ray", "hit", "build"].contains(&name);
            (!to_write).then_some((name, method))
        })
        .collect()
}

/// Removes white space, so that formatting does not count as a change.
fn without_whitespace(text: &str) -> String {
    text.split_whitespace().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_given_methods_but_not_stubs() {
        let names = |file: &TaskFile| -> Vec<&str> {
            given_methods(file.starter)
                .iter()
                .map(|(name, _)| *name)
                .collect()
        };
        let [camera, _, sphere, ..] = TASK_FILES;
        assert_eq!(names(&camera), ["new"]);
        assert_eq!(names(&sphere), ["new", "bbox", "uv"]);
    }

    #[test]
    fn reports_a_changed_given_method() {
        let [_, _, sphere, ..] = TASK_FILES;
        assert!(sphere.changed_methods(sphere.starter).is_empty());
        assert!(
            sphere
                .changed_methods(&sphere.starter.replace("    ", "  "))
                .is_empty()
        );
        let changed = sphere.starter.replace("/ PI", "/ 3.0");
        assert_eq!(sphere.changed_methods(&changed), ["uv"]);
    }

    #[test]
    fn starter_has_every_required_declaration() {
        for file in TASK_FILES {
            let missing = file
                .required_declarations
                .iter()
                .find(|part| !file.starter.contains(**part));
            assert_eq!(missing, None, "{}", file.name);
        }
    }
}
