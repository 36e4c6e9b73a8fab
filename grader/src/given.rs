//! What is handed out, as this program was built with it: the starter's five files and the given
//! ones. Files of these names beside a submission are compared, never used.

use crate::exam::Task;

/// One of the five files that students write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TaskFile {
    /// Such as `sphere.rs`.
    pub name: &'static str,
    /// As handed out.
    pub starter: &'static str,
    /// What the other files call by name. Without these, errors would be told of the callers.
    pub needed: &'static [&'static str],
}

/// The five files, in lecture order.
pub const TASK_FILES: [TaskFile; 5] = [
    TaskFile {
        name: "camera.rs",
        starter: include_str!("../starter/camera.rs"),
        needed: &["struct Camera", "fn new", "fn sample_ray"],
    },
    TaskFile {
        name: "triangle.rs",
        starter: include_str!("../starter/triangle.rs"),
        needed: &["struct Triangle", "fn new", "fn bbox", "fn hit"],
    },
    TaskFile {
        name: "sphere.rs",
        starter: include_str!("../starter/sphere.rs"),
        needed: &["struct Sphere", "fn new", "fn bbox", "fn hit"],
    },
    TaskFile {
        name: "bbox.rs",
        starter: include_str!("../starter/bbox.rs"),
        needed: &["struct BBox", "EMPTY", "fn new", "fn hit"],
    },
    TaskFile {
        name: "bvh.rs",
        starter: include_str!("../starter/bvh.rs"),
        needed: &[
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

/// The given files that every submission is compiled with.
pub const GIVEN_FILES: [(&str, &str); 3] = [
    ("lib.rs", include_str!("../starter/lib.rs")),
    ("primitive.rs", include_str!("../starter/primitive.rs")),
    ("world.rs", include_str!("../starter/world.rs")),
];

/// The given file that only draws pictures.
pub const MAIN: (&str, &str) = ("main.rs", include_str!("../starter/main.rs"));

impl TaskFile {
    /// The tasks whose points depend on this file.
    pub fn tasks(&self) -> impl Iterator<Item = Task> {
        let name = self.name;
        Task::ALL
            .into_iter()
            .filter(move |task| task.file() == name)
    }
}
