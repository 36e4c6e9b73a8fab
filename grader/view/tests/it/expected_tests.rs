//! A list of the tests that a correct traversal makes for a pixel, computed independently of the
//! viewer.

use framework::scene::Scene;
use framework::submission::Submission as _;
use glam::{UVec2, Vec2};
use protocol::{Ray, Shape, Tree};
use reference::world::Student;

use crate::harness::workspace;

/// A scene with the reference's tree.
pub struct Expected {
    scene: Scene,
    /// The shapes, with their numbers as materials, so that the tree says which is where.
    numbered: Vec<Shape>,
    tree: Tree,
}

impl Expected {
    /// Loads a scene of triangles.
    pub fn of_scene(name: &str, film: UVec2) -> Self {
        let path = workspace().join(format!("scenes/{name}.json"));
        let scene = Scene::load(&path).unwrap().on_film(film);
        let mut numbered = scene.shapes.clone();
        for (number, shape) in (0..).zip(&mut numbered) {
            if let Shape::Triangle { material, .. } = shape {
                *material = number;
            }
        }
        let tree = Student.build(&numbered, scene.max_leaf_size).tree();
        Expected {
            scene,
            numbered,
            tree,
        }
    }

    /// Returns the tests for the ray through the centre of a pixel, as texts.
    pub fn tests(&self, pixel: UVec2) -> Vec<String> {
        let camera = Student.camera(&self.scene.camera.pinhole);
        let ray = camera.ray(pixel, Vec2::splat(0.5));
        let ray = self.scene.camera.placement.to_world(&ray);
        tests(&self.tree, &self.numbered, &ray)
    }
}

/// Returns the tests of a traversal that tests both children of a node before it enters the nearer
/// one, as texts: an independent one, in double precision.
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
