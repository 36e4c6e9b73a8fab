//! What people write, right and wrong, as far as it can be told without compiling it: the tests
//! answer whole items in their stead.
#![allow(dead_code, reason = "each test file uses its own part of this")]

pub mod boxes;
pub mod builders;
pub mod cameras;
pub mod spheres;
pub mod trees;
pub mod triangles;
pub mod walks;

use grader::exam::Item;
use grader::judge::{Share, judge};
use protocol::{Answer, Outcome, Question, Ray, Shape, Trace};

use boxes::BoxHit;
use cameras::SampleRay;
use spheres::SphereHit;
use trees::BuildTree;
use triangles::TriangleHit;
use walks::{Scene, Walk};

/// One way to do each task.
#[derive(Clone, Copy)]
pub struct Solver {
    pub camera: SampleRay,
    pub triangle: TriangleHit,
    pub sphere: SphereHit,
    pub bbox: BoxHit,
    pub build: BuildTree,
    pub walk: Walk,
}

impl Solver {
    /// All of it right.
    pub const RIGHT: Solver = Solver {
        camera: cameras::CAMERAS[0].1,
        triangle: triangles::TRIANGLES[0].1,
        sphere: spheres::SPHERES[0].1,
        bbox: boxes::BOXES[0].1,
        build: trees::halves,
        walk: walks::whole::WALKS[0].1,
    };

    /// What one primitive answers.
    pub fn hit(&self, ray: &Ray, shape: &Shape) -> Option<Trace> {
        match *shape {
            Shape::Triangle {
                ref vertices,
                material,
            } => (self.triangle)(ray, vertices, material),
            Shape::Facet { corners, material } => {
                (self.triangle)(ray, &Shape::facet_vertices(corners), material)
            }
            Shape::Sphere {
                center,
                radius,
                material,
            } => (self.sphere)(ray, center, radius, material),
        }
    }

    /// The answer to a question; none to a question about radiance.
    pub fn answer(&self, question: &Question) -> Answer {
        match question {
            Question::Camera { camera, samples } => {
                let rays = samples.on(camera.film).into_iter();
                Answer::Rays(values(rays.map(|sample| (self.camera)(camera, sample))))
            }
            Question::Shapes { shapes, rays } => {
                let rays = rays.to_vec().into_iter();
                Answer::Hits(values(rays.map(|ray| {
                    let hits = shapes.iter().map(|shape| self.hit(&ray, shape));
                    hits.fold(None, Trace::nearer)
                })))
            }
            Question::BBox { min, max, shots } => {
                let shots = shots.iter();
                Answer::Spans(values(
                    shots.map(|(ray, times)| (self.bbox)(ray, *times, *min, *max)),
                ))
            }
            Question::Build {
                shapes,
                max_leaf_size,
            } => Answer::Tree(Outcome::Value((self.build)(
                shapes,
                *max_leaf_size as usize,
            ))),
            Question::Traverse {
                shapes,
                nodes,
                root,
                rays,
            } => {
                let root = *root as usize;
                let scene = Scene {
                    shapes,
                    nodes,
                    root,
                };
                Answer::Hits(values((self.walk)(&scene, &rays.to_vec()).into_iter()))
            }
            Question::BuildAndTraverse {
                shapes,
                max_leaf_size,
                rays,
            } => {
                let tree = (self.build)(shapes, *max_leaf_size as usize);
                let named = |material: &u32| {
                    let mut all = shapes.iter();
                    *all.find(|shape| shape.material() == *material)
                        .expect("it was given")
                };
                let ordered: Vec<Shape> = tree.order.iter().map(named).collect();
                let scene = Scene {
                    shapes: &ordered,
                    nodes: &tree.nodes,
                    root: tree.root as usize,
                };
                Answer::Hits(values((self.walk)(&scene, &rays.to_vec()).into_iter()))
            }
            Question::Radiance { .. } | Question::Done => Answer::Done,
        }
    }

    /// What the judge gives for an item, of its points.
    pub fn points(&self, item: &Item) -> u32 {
        let shares = item
            .questions
            .iter()
            .map(|asked| judge(asked, &self.answer(&asked.question)).share);
        shares.min().unwrap_or(Share::ALL).of(item.points)
    }

    /// The items that lose points, by name, and how many all of them lose.
    pub fn losses<'a>(&self, items: &'a [Item]) -> (Vec<&'a str>, u32) {
        let lost = items
            .iter()
            .map(|item| (item, item.points - self.points(item)))
            .filter(|(_, points)| *points > 0);
        let (lost, points): (Vec<&Item>, Vec<u32>) = lost.unzip();
        let name = |item: &'a Item| item.id.split_once('.').map_or("", |(_, name)| name);
        (lost.into_iter().map(name).collect(), points.iter().sum())
    }
}

fn values<T>(all: impl Iterator<Item = T>) -> Vec<Outcome<T>> {
    all.map(Outcome::Value).collect()
}
