//! The assignment `rays`.

use super::{Assignment, TaskInfo};

/// Tasks 1 to 3, after the slides "A3: PathTracing", tasks 1 to 3.
pub static RAYS: Assignment = Assignment {
    id: "rays",
    title: "Rays and a BVH",
    folders: &["", "src", "student/src"],
    other_folders: &[
        "grader",
        "framework",
        "protocol",
        "reference",
        "author",
        "substitution",
        "variants",
    ],
    tasks: &[
        TaskInfo {
            id: "camera",
            title: "Task 1: camera rays",
            file: "camera.rs",
            method: "sample_ray",
            points: 15,
        },
        TaskInfo {
            id: "triangle",
            title: "Task 2: triangles",
            file: "triangle.rs",
            method: "hit",
            points: 20,
        },
        TaskInfo {
            id: "sphere",
            title: "Task 2: spheres",
            file: "sphere.rs",
            method: "hit",
            points: 15,
        },
        TaskInfo {
            id: "bbox",
            title: "Task 3: boxes",
            file: "bbox.rs",
            method: "hit",
            points: 10,
        },
        TaskInfo {
            id: "build",
            title: "Task 3: building a BVH",
            file: "bvh.rs",
            method: "build",
            points: 20,
        },
        TaskInfo {
            id: "traverse",
            title: "Task 3: traversing a BVH",
            file: "bvh.rs",
            method: "hit",
            points: 20,
        },
    ],
    render: Some("cargo render cornell-box"),
    challenge: Some("traversal.md#a-challenge"),
};
