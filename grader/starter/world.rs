//! Given: the way from scenes and questions to your five files, and back.

use framework::attempt::{attempt, each};
use framework::integrator;
use framework::scene::Scene;
use framework::submission::{Submission, World};
use glam::{UVec2, Vec2};
use protocol::{Answer, PinholeCamera, Question, Ray, Sample, Shape, Trace, Tree, TreeNode};

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
                Answer::Rays(each(&samples.on(lens.film), |sample: &Sample| {
                    camera.sample_ray(sample.pixel, sample.offset)
                }))
            }
            Question::Shapes { shapes, rays } => {
                let primitives = primitives(shapes);
                Answer::Hits(each(&rays.to_vec(), |ray| {
                    let traces = primitives.iter().map(|primitive| primitive.hit(ray));
                    traces.fold(None, Trace::nearer)
                }))
            }
            Question::BBox { min, max, shots } => {
                let bbox = BBox::new(*min, *max);
                Answer::Spans(each(shots, |(ray, times)| bbox.hit(ray, *times)))
            }
            Question::Build {
                shapes,
                max_leaf_size,
            } => Answer::Tree(attempt(|| {
                let bvh = Bvh::build(primitives(shapes), *max_leaf_size as usize);
                let most = Question::most_nodes(shapes.len());
                assert!(
                    bvh.nodes.len() <= most && bvh.primitives.len() <= most,
                    "{} primitives became {} nodes over {} primitives",
                    shapes.len(),
                    bvh.nodes.len(),
                    bvh.primitives.len(),
                );
                tree(&bvh)
            })),
            Question::Traverse {
                shapes,
                nodes,
                root,
                rays,
            } => {
                let nodes = nodes.iter().map(node).collect();
                let bvh = Bvh::from_nodes(primitives(shapes), nodes, *root as usize);
                Answer::Hits(each(&rays.to_vec(), |ray| bvh.hit(ray)))
            }
            Question::BuildAndTraverse {
                shapes,
                max_leaf_size,
                rays,
            } => {
                // Built at the first ray, so that a panic in `build` is told like any other.
                let mut built = None;
                Answer::Hits(each(&rays.to_vec(), |ray| {
                    let build = || Bvh::build(primitives(shapes), *max_leaf_size as usize);
                    built.get_or_insert_with(build).hit(ray)
                }))
            }
            Question::Radiance {
                scene,
                film,
                samples,
                bounces,
                seed,
            } => Answer::Picture(attempt(|| {
                let scene = Scene::from_text(scene).expect("the exam's scenes are checked");
                let sampling = integrator::Sampling {
                    film: *film,
                    samples: *samples,
                    bounces: *bounces,
                    seed: *seed,
                };
                integrator::radiance(self, &scene, &sampling)
            })),
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
    shapes.iter().map(Primitive::new).collect()
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
    let nodes = bvh.nodes.iter().map(|node| TreeNode {
        min: node.bbox.min,
        max: node.bbox.max,
        start: place(node.start),
        size: place(node.size),
        l: place(node.l),
        r: place(node.r),
    });
    Tree {
        nodes: nodes.collect(),
        root: place(bvh.root),
        order: bvh.primitives.iter().map(Primitive::material).collect(),
    }
}
