//! The assignment `light`.

mod clues;

use super::{Assignment, TaskClues, TaskFile, TaskInfo};

use clues::{DIRECT, ENVIRONMENT, LIGHTS, PATH, SPECULAR};

/// Part two: tasks 4 to 7 of the course that the slides "A3: PathTracing" are from.
pub static LIGHT: Assignment = Assignment {
    id: "light",
    title: "Path tracing: materials, lights and paths",
    folders: &["", "src", "light/src", "student/light/src"],
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
            id: "lambertian",
            title: "Matte surfaces",
            file: "material.rs",
            methods: &[
                "Lambertian::evaluate",
                "Lambertian::pdf",
                "Lambertian::scatter",
            ],
            points: 12,
            chapter: "light/materials.md",
            clues: TaskClues::NONE,
        },
        TaskInfo {
            id: "specular",
            title: "Mirrors and glass",
            file: "material.rs",
            methods: &[
                "reflect",
                "refract",
                "fresnel",
                "Mirror::scatter",
                "Glass::scatter",
            ],
            points: 23,
            chapter: "light/glass.md",
            clues: SPECULAR,
        },
        TaskInfo {
            id: "lights",
            title: "Sampling lights",
            file: "lights.rs",
            methods: &["AreaLight::pdf", "Lights::sample", "Lights::pdf"],
            points: 15,
            chapter: "light/lights.md",
            clues: LIGHTS,
        },
        TaskInfo {
            id: "direct",
            title: "Direct light",
            file: "direct.rs",
            methods: &["direct"],
            points: 13,
            chapter: "light/direct.md",
            clues: DIRECT,
        },
        TaskInfo {
            id: "path",
            title: "Paths",
            file: "path.rs",
            methods: &["radiance"],
            points: 17,
            chapter: "light/paths.md",
            clues: PATH,
        },
        TaskInfo {
            id: "environment",
            title: "Environment maps",
            file: "environment.rs",
            methods: &[
                "uniform_sphere",
                "Environment::new",
                "Environment::sample",
                "Environment::pdf",
            ],
            points: 20,
            chapter: "light/environment.md",
            clues: ENVIRONMENT,
        },
    ],
    render: Some("cargo render lights"),
    challenge: None,
};

/// The files of the assignment `light` that students write, in lecture order.
pub static LIGHT_FILES: &[TaskFile] = &[
    TaskFile {
        name: "material.rs",
        starter: include_str!("../../../../starter/light/material.rs"),
        required_declarations: &[
            "struct Scattered",
            "struct Lambertian",
            "struct Mirror",
            "struct Glass",
            "fn evaluate",
            "fn pdf",
            "fn scatter",
            "fn reflect",
            "fn refract",
            "fn fresnel",
        ],
    },
    TaskFile {
        name: "lights.rs",
        starter: include_str!("../../../../starter/light/lights.rs"),
        required_declarations: &[
            "struct AreaLight",
            "enum Light",
            "struct Lights",
            "fn parallelogram",
            "fn triangle",
            "fn intersect",
            "fn nearest",
            "fn sample",
            "fn pdf",
        ],
    },
    TaskFile {
        name: "direct.rs",
        starter: include_str!("../../../../starter/light/direct.rs"),
        required_declarations: &["fn direct"],
    },
    TaskFile {
        name: "path.rs",
        starter: include_str!("../../../../starter/light/path.rs"),
        required_declarations: &["fn radiance"],
    },
    TaskFile {
        name: "environment.rs",
        starter: include_str!("../../../../starter/light/environment.rs"),
        required_declarations: &[
            "fn uniform_sphere",
            "struct Environment",
            "fn new",
            "fn radiance",
            "fn sample",
            "fn pdf",
        ],
    },
];
