//! The assignment `rays`.

use super::{Assignment, TaskClues, TaskFile, TaskInfo};

/// Tasks 1 to 3, after the slides "A3: PathTracing", tasks 1 to 3.
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
            method: "sample_ray",
            points: 15,
            chapter: "camera.md",
            clues: TaskClues::NONE,
        },
        TaskInfo {
            id: "triangle",
            title: "Task 2: triangles",
            file: "triangle.rs",
            method: "hit",
            points: 20,
            chapter: "triangle.md",
            clues: TRIANGLE_CLUES,
        },
        TaskInfo {
            id: "sphere",
            title: "Task 2: spheres",
            file: "sphere.rs",
            method: "hit",
            points: 15,
            chapter: "sphere.md",
            clues: SPHERE_CLUES,
        },
        TaskInfo {
            id: "bbox",
            title: "Task 3: boxes",
            file: "bbox.rs",
            method: "hit",
            points: 10,
            chapter: "boxes.md",
            clues: BBOX_CLUES,
        },
        TaskInfo {
            id: "build",
            title: "Task 3: building a BVH",
            file: "bvh.rs",
            method: "build",
            points: 20,
            chapter: "building.md",
            clues: BUILD_CLUES,
        },
        TaskInfo {
            id: "traverse",
            title: "Task 3: traversing a BVH",
            file: "bvh.rs",
            method: "hit",
            points: 20,
            chapter: "traversal.md",
            clues: TRAVERSE_CLUES,
        },
    ],
    render: Some("cargo render cornell-box"),
    challenge: Some("traversal.md#a-challenge"),
};

/// The files of the assignment `rays` that students write, in lecture order.
pub static RAYS_FILES: &[TaskFile] = &[
    TaskFile {
        name: "camera.rs",
        starter: include_str!("../../../starter/camera.rs"),
        required_declarations: &["struct Camera", "fn new", "fn sample_ray"],
    },
    TaskFile {
        name: "triangle.rs",
        starter: include_str!("../../../starter/triangle.rs"),
        required_declarations: &["struct Triangle", "fn new", "fn bbox", "fn hit"],
    },
    TaskFile {
        name: "sphere.rs",
        starter: include_str!("../../../starter/sphere.rs"),
        required_declarations: &["struct Sphere", "fn new", "fn bbox", "fn hit"],
    },
    TaskFile {
        name: "bbox.rs",
        starter: include_str!("../../../starter/bbox.rs"),
        required_declarations: &["struct BBox", "EMPTY", "fn new", "fn hit"],
    },
    TaskFile {
        name: "bvh.rs",
        starter: include_str!("../../../starter/bvh.rs"),
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

const TRIANGLE_CLUES: TaskClues = TaskClues {
    if_nothing_is_hit: Some(
        "Not one ray hits a triangle, so find what is wrong for every ray. Work out u, v, 1 − u − \
         v and t by hand for the ray shown, and compare them with those in your code. If several \
         have the wrong sign, look at s, at the operands of each cross product, and at the \
         formula's two minus signs.",
    ),
    ..TaskClues::NONE
};

const SPHERE_CLUES: TaskClues = TaskClues {
    if_nothing_is_hit: Some(
        "Not one ray hits a sphere, so find what is wrong for every ray. Work out b, c, the \
         discriminant and both roots by hand for the ray shown, and compare them with those in \
         your code. Then see which comparison rejects both roots.",
    ),
    ..TaskClues::NONE
};

const BBOX_CLUES: TaskClues = TaskClues {
    if_nothing_is_hit: Some(
        "Not one ray hits a box, so find what is wrong for every ray. Work out by hand, for the \
         ray shown and each axis, when it enters the slab and when it leaves it. Which of these \
         times are different in your code, and which comparison rejects them?",
    ),
    ..TaskClues::NONE
};

const BUILD_CLUES: TaskClues = TaskClues {
    if_stack_overflows: Some(
        "Find the call in bvh.rs that gets as many primitives as its caller. Either that node \
         should have become a leaf, or one side of its split is empty: do you count the two sides \
         by the same rule by which you move the primitives? `--replay` names the fewest \
         primitives that still overflow the stack.",
    ),
    ..TaskClues::NONE
};

const TRAVERSE_CLUES: TaskClues = TaskClues {
    if_nothing_is_hit: Some(
        "Not one ray hits anything, so find what is wrong for every ray. Follow the ray shown \
         from the root. Does your code enter the boxes that it hits, and test all primitives of \
         the leaves? Is a hit that it finds kept, compared the right way round, and returned?",
    ),
    ..TaskClues::NONE
};
