//! The assignment `rays`.

mod clues;

use super::{Assignment, TaskFile, TaskInfo};

use clues::{BBOX, BUILD, CAMERA, SPHERE, TRAVERSE, TRIANGLE};

/// Tasks 1 to 3, based on tasks 1 to 3 of the slides "A3: PathTracing".
pub static RAYS: Assignment = Assignment {
    id: "rays",
    title: "Path tracing: rays and a BVH",
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
            methods: &["Camera::sample_ray"],
            points: 15,
            chapter: "camera.md",
            clues: CAMERA,
        },
        TaskInfo {
            id: "triangle",
            title: "Task 2: triangles",
            file: "triangle.rs",
            methods: &["Triangle::hit"],
            points: 20,
            chapter: "triangle.md",
            clues: TRIANGLE,
        },
        TaskInfo {
            id: "sphere",
            title: "Task 2: spheres",
            file: "sphere.rs",
            methods: &["Sphere::hit"],
            points: 15,
            chapter: "sphere.md",
            clues: SPHERE,
        },
        TaskInfo {
            id: "bbox",
            title: "Task 3: boxes",
            file: "bbox.rs",
            methods: &["BBox::hit"],
            points: 10,
            chapter: "boxes.md",
            clues: BBOX,
        },
        TaskInfo {
            id: "build",
            title: "Task 3: building a BVH",
            file: "bvh.rs",
            methods: &["Bvh::build"],
            points: 20,
            chapter: "building.md",
            clues: BUILD,
        },
        TaskInfo {
            id: "traverse",
            title: "Task 3: traversing a BVH",
            file: "bvh.rs",
            methods: &["Bvh::hit"],
            points: 20,
            chapter: "traversal.md",
            clues: TRAVERSE,
        },
    ],
    render: Some("cargo render cornell-box"),
    challenge: Some("traversal.md#a-challenge"),
};

/// The files of the assignment `rays` that students write, in lecture order.
pub static RAYS_FILES: &[TaskFile] = &[
    TaskFile {
        name: "camera.rs",
        starter: include_str!("../../../../starter/camera.rs"),
        required_declarations: &["struct Camera", "fn new", "fn sample_ray"],
    },
    TaskFile {
        name: "triangle.rs",
        starter: include_str!("../../../../starter/triangle.rs"),
        required_declarations: &["struct Triangle", "fn new", "fn bbox", "fn hit"],
    },
    TaskFile {
        name: "sphere.rs",
        starter: include_str!("../../../../starter/sphere.rs"),
        required_declarations: &["struct Sphere", "fn new", "fn bbox", "fn hit"],
    },
    TaskFile {
        name: "bbox.rs",
        starter: include_str!("../../../../starter/bbox.rs"),
        required_declarations: &["struct BBox", "EMPTY", "fn new", "fn hit"],
    },
    TaskFile {
        name: "bvh.rs",
        starter: include_str!("../../../../starter/bvh.rs"),
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
