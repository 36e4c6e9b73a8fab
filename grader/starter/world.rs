//! Given: the way from scenes and questions to your five files, and back.
//!
//! Compiled with your files each time that they are graded, so it is written for the compiler to be
//! quick: loops that `push`, where `map` and `collect` would take it twice as long.

use framework::answer;
use framework::integrator::Sampling;
use framework::scene::Scene;
use framework::submission::{Submission, World};
use glam::{UVec2, Vec2};
use protocol::{Answer, Interval, PinholeCamera, Question, Ray, Shape, Trace, Tree, TreeNode};

use crate::bbox::BBox;
use crate::bvh::{Bvh, Node};
use crate::camera::Camera;
use crate::primitive::Primitive;

/// Your five files, as the framework sees them.
pub struct Student;

impl Submission for Student {
    fn world(&self, scene: &Scene) -> Box<dyn World> {
        Box::new(StudentWorld {
            camera: camera(&scene.camera.lens),
            bvh: Bvh::build(primitives(&scene.shapes), scene.max_leaf_size),
        })
    }

    fn answer(&self, question: &Question) -> Answer {
        match question {
            Question::Camera {
                camera: lens,
                samples,
            } => {
                let camera = camera(lens);
                answer::rays(lens, samples, &mut |(pixel, offset): (UVec2, Vec2)| {
                    camera.sample_ray(pixel, offset)
                })
            }
            Question::Shapes { shapes, rays } => {
                let primitives = primitives(shapes);
                answer::hits(rays, &mut |ray: &Ray| nearest(&primitives, ray))
            }
            Question::BBox { min, max, shots } => {
                let bbox = BBox::new(*min, *max);
                answer::spans(shots, &mut |(ray, times): (&Ray, Interval)| {
                    bbox.hit(ray, times)
                })
            }
            Question::Build {
                shapes,
                max_leaf_size,
            } => answer::tree(shapes.len(), &mut |()| tree(&build(shapes, *max_leaf_size))),
            Question::Traverse {
                shapes,
                nodes,
                root,
                rays,
            } => {
                let bvh = planted(shapes, nodes, *root);
                answer::hits(rays, &mut |ray: &Ray| bvh.hit(ray))
            }
            Question::BuildAndTraverse {
                shapes,
                max_leaf_size,
                rays,
            } => {
                // Built at the first ray, so that a panic in `build` is told like any other.
                let mut bvh = None;
                answer::hits(rays, &mut |ray: &Ray| {
                    bvh.get_or_insert_with(|| build(shapes, *max_leaf_size))
                        .hit(ray)
                })
            }
            Question::Radiance {
                scene,
                film,
                samples,
                bounces,
                seed,
            } => {
                let sampling = Sampling {
                    film: *film,
                    samples: *samples,
                    bounces: *bounces,
                    seed: *seed,
                };
                answer::picture(self, scene, &sampling)
            }
            Question::Done => Answer::Done,
        }
    }
}

/// A scene, made of your types.
struct StudentWorld {
    camera: Camera,
    bvh: Bvh,
}

impl World for StudentWorld {
    fn camera_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        self.camera.sample_ray(pixel, offset)
    }

    fn hit(&self, ray: &Ray) -> Option<Trace> {
        self.bvh.hit(ray)
    }

    fn tree(&self) -> Tree {
        tree(&self.bvh)
    }
}

fn camera(lens: &PinholeCamera) -> Camera {
    Camera::new(lens.vertical_fov, lens.aspect_ratio, lens.film)
}

fn primitives(shapes: &[Shape]) -> Vec<Primitive> {
    let mut primitives = Vec::new();
    for shape in shapes {
        primitives.push(Primitive::new(shape));
    }
    primitives
}

fn build(shapes: &[Shape], max_leaf_size: u32) -> Bvh {
    Bvh::build(primitives(shapes), max_leaf_size as usize)
}

/// The closest of the hits of each primitive by itself.
fn nearest(primitives: &[Primitive], ray: &Ray) -> Option<Trace> {
    let mut nearest = None;
    for primitive in primitives {
        nearest = Trace::nearer(nearest, primitive.hit(ray));
    }
    nearest
}

/// The exam's own tree.
fn planted(shapes: &[Shape], tree_nodes: &[TreeNode], root: u32) -> Bvh {
    let mut nodes = Vec::new();
    for tree_node in tree_nodes {
        nodes.push(node(tree_node));
    }
    Bvh::from_nodes(primitives(shapes), nodes, root as usize)
}

fn node(node: &TreeNode) -> Node {
    let bbox = BBox::new(node.min, node.max);
    if node.is_leaf() {
        Node::leaf(bbox, node.start as usize, node.size as usize)
    } else {
        Node::interior(bbox, node.l as usize, node.r as usize)
    }
}

fn tree(bvh: &Bvh) -> Tree {
    // What does not fit is out of range anyway, and must not wrap into range.
    let place = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let mut tree = Tree {
        nodes: Vec::new(),
        root: place(bvh.root),
        order: Vec::new(),
    };
    for node in &bvh.nodes {
        tree.nodes.push(TreeNode {
            min: node.bbox.min,
            max: node.bbox.max,
            start: place(node.start),
            size: place(node.size),
            l: place(node.l),
            r: place(node.r),
        });
    }
    for primitive in &bvh.primitives {
        tree.order.push(primitive.material());
    }
    tree
}
