//! The tests of one ray, compared with a list that is computed here, and the marks of wrong
//! traversals.

use framework::scene::Scene;
use framework::submission::Submission as _;
use glam::{Vec2, uvec2};
use protocol::{Ray, Shape, Tree};
use reference::world::Student;
use serde_json::Value;

use crate::harness::{Submission, Viewer, workspace};

/// Returns the tests of a traversal that tests both children of a node before it enters the nearer
/// one, as texts: an independent one, in double precision.
fn expected_tests(tree: &Tree, shapes: &[Shape], ray: &Ray) -> Vec<String> {
    let mut tests = Vec::new();
    let mut closest = f64::INFINITY;
    if entry(tree, tree.root, ray, &mut tests).is_some() {
        visit(tree, tree.root, shapes, ray, &mut closest, &mut tests);
    }
    tests
}

fn visit(
    tree: &Tree,
    index: u32,
    shapes: &[Shape],
    ray: &Ray,
    closest: &mut f64,
    tests: &mut Vec<String>,
) {
    let node = &tree.nodes[index as usize];
    if node.is_leaf() {
        for slot in node.start..node.start + node.size {
            let shape = tree.order[slot as usize];
            tests.push(format!("shape {shape}"));
            let hit = Student
                .primitive_list(&[shapes[shape as usize]])
                .closest_hit(ray);
            *closest = hit.map_or(*closest, |hit| closest.min(f64::from(hit.distance)));
        }
        return;
    }
    let mut children: Vec<(f64, u32)> = Vec::new();
    for child in [node.l, node.r] {
        children.extend(entry(tree, child, ray, tests).map(|entry| (entry, child)));
    }
    children.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (entry, child) in children {
        if entry <= *closest {
            visit(tree, child, shapes, ray, closest, tests);
        }
    }
}

/// Returns the time at which the ray enters a node's box, from the planes of its faces.
fn entry(tree: &Tree, index: u32, ray: &Ray, tests: &mut Vec<String>) -> Option<f64> {
    tests.push(format!("node {index}"));
    let node = &tree.nodes[index as usize];
    let (origin, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
    let (a, b) = (
        (node.min.as_dvec3() - origin) / dir,
        (node.max.as_dvec3() - origin) / dir,
    );
    let (first, last) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
    (first <= last).then_some(first)
}

/// Returns the tests in an explanation as texts.
fn listed_tests(ray: &Value) -> Vec<String> {
    let rows = ray["rows"].as_array().unwrap().iter();
    let text = |row: &Value| match row["is_box"].as_bool().unwrap() {
        true => {
            assert_eq!(row["nodes"].as_array().unwrap().len(), 1, "{row}");
            format!("node {}", row["nodes"][0])
        }
        false => format!("shape {}", row["shape"]),
    };
    rows.map(text).collect()
}

#[test]
fn the_tests_of_a_pixel_are_those_of_the_references_traversal() {
    let scene = Scene::load(&workspace().join("scenes/checkered-teapot.json")).unwrap();
    let film = uvec2(48, 36);
    let scene = scene.on_film(film);
    // The viewer numbers the shapes, so that the tree says which is where.
    let mut numbered = scene.shapes.clone();
    for (number, shape) in (0..).zip(&mut numbered) {
        if let Shape::Triangle { material, .. } = shape {
            *material = number;
        }
    }
    let tree = Student.build(&numbered, scene.max_leaf_size).tree();
    let arguments = ["checkered-teapot", "--size", "48x36", "--samples", "1"];
    let viewer = Viewer::start(&Submission::reference(), &arguments);
    let camera = Student.camera(&scene.camera.pinhole);
    let mut hits = 0;
    for pixel in [
        uvec2(20, 18),
        uvec2(24, 20),
        uvec2(30, 16),
        uvec2(10, 5),
        uvec2(47, 35),
    ] {
        let explanation = viewer.explain(pixel.to_array(), None);
        let ray = scene
            .camera
            .placement
            .to_world(&camera.ray(pixel, Vec2::splat(0.5)));
        let explained = &explanation["rays"][0];
        let expected = expected_tests(&tree, &numbered, &ray);
        assert_eq!(listed_tests(explained), expected, "{pixel}");
        assert_eq!(explained["notes"].as_array().unwrap().len(), 0);
        hits += usize::from(explained["hit"] != Value::Null);
        let rows = explained["rows"].as_array().unwrap();
        assert!(
            rows.iter()
                .all(|row| row["marks"].as_array().unwrap().is_empty())
        );
    }
    assert!(hits >= 3, "{hits}");
}

#[test]
fn every_ray_of_a_path_is_listed() {
    let viewer = Viewer::start(
        &Submission::reference(),
        &["--size", "32x32", "--samples", "1"],
    );
    let explanation = viewer.explain([16, 8], Some(0));
    let rays = explanation["rays"].as_array().unwrap();
    let kinds: Vec<&str> = rays
        .iter()
        .map(|ray| ray["kind"].as_str().unwrap())
        .collect();
    assert_eq!(kinds[0], "camera ray");
    assert!(kinds.contains(&"shadow ray, to a light"), "{kinds:?}");
    assert!(kinds.contains(&"ray after bounce 1"), "{kinds:?}");
    assert!(rays.iter().all(|ray| ray["boxes"].as_u64() > Some(0)));
    assert_eq!(explanation["radiance"].as_array().unwrap().len(), 3);
}

/// Returns the rules that are broken in some of the pixels of a scene.
fn broken_rules(submission: &Submission) -> Vec<String> {
    let arguments = ["gyroid", "--size", "24x24", "--samples", "1"];
    let viewer = Viewer::start(submission, &arguments);
    let mut rules = Vec::new();
    let pixels = (0..36).map(|n| [2 + 4 * (n % 6), 2 + 4 * (n / 6)]);
    for pixel in pixels {
        let explanation = viewer.explain(pixel, None);
        for row in explanation["rays"][0]["rows"].as_array().unwrap() {
            let marks = row["marks"].as_array().unwrap().iter();
            rules.extend(marks.map(|mark| mark[0].as_str().unwrap().to_owned()));
        }
    }
    rules.sort();
    rules.dedup();
    rules
}

#[test]
fn a_correct_traversal_has_no_marks_and_the_slides_pseudo_code_has() {
    let submission = Submission::reference();
    assert_eq!(broken_rules(&submission), [""; 0]);
    let text = submission.read("bvh.rs");
    let start = text.find("    pub fn hit(&self, ray: &Ray)").unwrap();
    let end = start + text[start..].find("\n    }\n").unwrap() + "\n    }\n".len();
    let hit = include_str!("slides_hit.rs");
    submission.write(
        "bvh.rs",
        &format!("{}{hit}{}", &text[..start], &text[end..]),
    );
    assert_eq!(
        broken_rules(&submission),
        ["beyond_closest_hit", "missed_box"]
    );
}

#[test]
fn a_traversal_without_boxes_says_so() {
    let submission = Submission::reference();
    let text = submission.read("bvh.rs");
    let start = text.find("    pub fn hit(&self, ray: &Ray)").unwrap();
    let end = start + text[start..].find("\n    }\n").unwrap() + "\n    }\n".len();
    let scan = "    pub fn hit(&self, ray: &Ray) -> Option<Trace> {\n        \
        self.primitives.iter().map(|primitive| primitive.hit(ray)).fold(None, Trace::nearer)\n    }\n";
    submission.write(
        "bvh.rs",
        &format!("{}{scan}{}", &text[..start], &text[end..]),
    );
    let viewer = Viewer::start(&submission, &["flat", "--size", "16x16", "--samples", "1"]);
    let explanation = viewer.explain([8, 8], None);
    let note = explanation["rays"][0]["notes"][0].as_str().unwrap();
    assert!(note.contains("tested no box"), "{note}");
}
