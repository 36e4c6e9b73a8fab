//! The tests that a correct traversal makes for a pixel, computed independently of the viewer.

use std::collections::BTreeSet;

use framework::scene::Scene;
use framework::submission::Submission as _;
use glam::{DVec3, UVec2, Vec2};
use grader::exam_source::ExamSource;
use grader::handed_out::RAYS;
use protocol::{Geometry, Question, Ray, Shape, Table, Tree, TreeNode};
use reference::world::Student;
use serde_json::Value;

use crate::harness::workspace;

/// A scene with the reference's tree, or a question from the practice exam with its tree.
pub struct Expected {
    /// The shapes. A scene's shapes are numbered, so that the tree shows their order.
    shapes: Vec<Shape>,
    pub tree: Tree,
    scene: Option<Scene>,
    /// The ray of the question.
    ray: Option<Ray>,
}

impl Expected {
    /// Loads a scene of triangles.
    pub fn of_scene(name: &str, film: UVec2) -> Self {
        let path = workspace().join(format!("scenes/{name}.json"));
        let scene = Scene::load(&path).unwrap().on_film(film);
        let mut shapes = scene.shapes.clone();
        for (number, shape) in (0..).zip(&mut shapes) {
            if let Shape::Triangle { shape, .. } = shape {
                *shape = number;
            }
        }
        let tree = Student.build(&shapes, scene.max_leaf_size).tree();
        Expected {
            shapes,
            tree,
            scene: Some(scene),
            ray: None,
        }
    }

    /// Reads a question about traversal from the practice exam.
    pub fn of_question(item: &str, number: usize) -> Self {
        let exam = ExamSource::Practice.load(&RAYS).unwrap().exam;
        let item = exam.items.iter().find(|known| known.id == item).unwrap();
        let (question, element) = item.element(number).unwrap();
        let Question::Hit(Table {
            subject:
                Geometry::Tree {
                    shapes,
                    nodes,
                    root,
                },
            rows,
        }) = &item.questions[question].question
        else {
            panic!("{} is not about traversal", item.id);
        };
        Expected {
            shapes: shapes.clone(),
            tree: Tree {
                nodes: nodes.clone(),
                root: *root,
                order: (0..).take(shapes.len()).collect(),
            },
            scene: None,
            ray: rows.get(element),
        }
    }

    /// Returns the tests for the ray through the centre of a pixel, as strings.
    pub fn tests(&self, pixel: UVec2) -> Vec<String> {
        let scene = self.scene.as_ref().unwrap();
        let camera = Student.camera(&scene.camera.pinhole);
        let ray = camera.ray(pixel, Vec2::splat(0.5));
        let ray = scene.camera.placement.to_world(&ray);
        tests(&self.tree, &self.shapes, &ray)
    }

    /// Returns the tests for the question's ray, as strings.
    pub fn tests_of_question(&self) -> Vec<String> {
        tests(&self.tree, &self.shapes, &self.ray.unwrap())
    }

    /// Returns whether the ray of the question misses a node's box, but by less than 1% of the
    /// box's diagonal.
    pub fn barely_misses(&self, node: u32) -> bool {
        let node = &self.tree.nodes[node as usize];
        let (min, max) = (node.min.as_dvec3(), node.max.as_dvec3());
        let (ray, margin) = (self.ray.unwrap(), 0.01 * min.distance(max));
        entry_of_box(min, max, &ray).is_none()
            && entry_of_box(min - margin, max + margin, &ray).is_some()
    }

    /// Returns the nodes entered by a traversal that makes these tests.
    pub fn entered(&self, tests: &[String]) -> BTreeSet<u32> {
        let entered = tests.iter().map(|test| {
            let (kind, number) = test.split_once(' ').unwrap();
            let number: u32 = number.parse().unwrap();
            match kind {
                "node" => self.parent(number),
                _ => self.leaf_of(number),
            }
        });
        entered.flatten().collect()
    }

    /// Returns the parent of a node.
    pub fn parent(&self, node: u32) -> Option<u32> {
        let is_parent = |parent: &&(u32, &TreeNode)| {
            !parent.1.is_leaf() && (parent.1.l == node || parent.1.r == node)
        };
        let nodes: Vec<(u32, &TreeNode)> = (0..).zip(&self.tree.nodes).collect();
        nodes.iter().find(is_parent).map(|(index, _)| *index)
    }

    fn leaf_of(&self, shape: u32) -> Option<u32> {
        let slot = self.tree.order.iter().position(|known| *known == shape)?;
        let slot = u32::try_from(slot).unwrap();
        let holds = |node: &TreeNode| {
            node.is_leaf() && (node.start..node.start + node.size).contains(&slot)
        };
        let leaf = self.tree.nodes.iter().position(holds)?;
        u32::try_from(leaf).ok()
    }
}

/// Traverses the tree independently, in double precision, and returns the tests as strings. Both
/// children of a node are tested before the nearer one is entered.
fn tests(tree: &Tree, shapes: &[Shape], ray: &Ray) -> Vec<String> {
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

/// Returns the distance at which the ray enters a node's box.
fn entry(tree: &Tree, index: u32, ray: &Ray, tests: &mut Vec<String>) -> Option<f64> {
    tests.push(format!("node {index}"));
    let node = &tree.nodes[index as usize];
    entry_of_box(node.min.as_dvec3(), node.max.as_dvec3(), ray)
}

/// Returns the distance at which the ray enters a box, computed from the planes of its faces.
fn entry_of_box(min: DVec3, max: DVec3, ray: &Ray) -> Option<f64> {
    let (origin, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
    let (a, b) = ((min - origin) / dir, (max - origin) / dir);
    let (start, end) = (f64::from(ray.range.min), f64::from(ray.range.max));
    let (first, last) = (
        a.min(b).max_element().max(start),
        a.max(b).min_element().min(end),
    );
    (first <= last).then_some(first)
}

/// Returns the violations marked in a ray's explanation: each broken rule with the node that
/// shouldn't have been entered.
pub fn marks(ray: &Value) -> Vec<(String, u32)> {
    let rows = ray["rows"].as_array().unwrap().iter();
    let marks = rows.flat_map(|row| row["marks"].as_array().unwrap());
    marks
        .map(|mark| serde_json::from_value(mark.clone()).unwrap())
        .collect()
}

/// Returns the tests in an explanation as strings.
pub fn listed_tests(ray: &Value) -> Vec<String> {
    let rows = ray["rows"].as_array().unwrap().iter();
    let text = |row: &Value| {
        if row["is_box"].as_bool().unwrap() {
            assert_eq!(row["nodes"].as_array().unwrap().len(), 1, "{row}");
            format!("node {}", row["nodes"][0])
        } else {
            format!("shape {}", row["shape"])
        }
    };
    rows.map(text).collect()
}
