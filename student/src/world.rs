//! Given: connects your files to the framework, which renders scenes and answers the grader's
//! questions.
//!
//! This file is compiled together with your files each time they are graded, so it is short and
//! written to compile fast: it uses loops with `push`, for example, because `map` and `collect`
//! would take twice as long to compile. Every line that uses one of your files names that file, so
//! that the grader can attribute a compile error there to your file.

use framework::submission::{Aggregate, CameraRays, Hierarchy, Submission};
use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, PinholeCamera, Ray, Shape, Trace, TreeNode};

use crate::bbox::BBox;
use crate::bvh::{Bvh, Node};
use crate::camera::Camera;
use crate::primitive::Primitive;

/// Your files, as an implementation of the framework's [`Submission`].
pub struct Student;

impl Submission for Student {
    fn camera(&self, pinhole: &PinholeCamera) -> Box<dyn CameraRays> {
        let camera = Camera::new(pinhole.vertical_fov, pinhole.aspect_ratio, pinhole.film);
        Box::new(Adapter(camera))
    }

    fn primitive_list(&self, shapes: &[Shape]) -> Box<dyn Aggregate> {
        Box::new(Adapter(primitives(shapes)))
    }

    fn intersect_box(&self, min: Vec3, max: Vec3, ray: &Ray, times: Interval) -> Option<Interval> {
        BBox::new(min, max).hit(ray, times)
    }

    fn build(&self, shapes: &[Shape], max_leaf_size: usize) -> Box<dyn Hierarchy> {
        Box::new(Adapter(Bvh::build(primitives(shapes), max_leaf_size)))
    }

    fn prebuilt_tree(
        &self,
        shapes: &[Shape],
        tree: &[TreeNode],
        root: usize,
    ) -> Box<dyn Hierarchy> {
        let mut nodes = Vec::new();
        for node in tree {
            nodes.push(to_node(node));
        }
        Box::new(Adapter(Bvh::from_nodes(primitives(shapes), nodes, root)))
    }
}

/// Wraps one of your types to implement the framework's traits for it.
struct Adapter<T>(T);

impl CameraRays for Adapter<Camera> {
    fn ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let Adapter(camera) = self;
        camera.sample_ray(pixel, offset)
    }
}

impl Aggregate for Adapter<Vec<Primitive>> {
    fn closest_hit(&self, ray: &Ray) -> Option<Trace> {
        let Adapter(primitives) = self;
        let mut nearest = None;
        for primitive in primitives {
            nearest = Trace::nearer(nearest, primitive.hit(ray));
        }
        nearest
    }
}

impl Aggregate for Adapter<Bvh> {
    fn closest_hit(&self, ray: &Ray) -> Option<Trace> {
        let Adapter(bvh) = self;
        bvh.hit(ray)
    }
}

impl Hierarchy for Adapter<Bvh> {
    fn root(&self) -> usize {
        let Adapter(bvh) = self;
        bvh.root
    }

    fn node_count(&self) -> usize {
        let Adapter(bvh) = self;
        bvh.nodes.len()
    }

    fn node(&self, index: usize) -> TreeNode {
        let Adapter(bvh) = self;
        let node = &bvh.nodes[index];
        TreeNode::new(
            node.bbox.min,
            node.bbox.max,
            node.start,
            node.size,
            node.l,
            node.r,
        )
    }

    fn primitive_count(&self) -> usize {
        let Adapter(bvh) = self;
        bvh.primitives.len()
    }

    fn shape(&self, index: usize) -> u32 {
        let Adapter(bvh) = self;
        bvh.primitives[index].number()
    }
}

fn primitives(shapes: &[Shape]) -> Vec<Primitive> {
    let mut primitives = Vec::new();
    for shape in shapes {
        primitives.push(Primitive::new(shape));
    }
    primitives
}

/// Converts a node of an exam's tree to your type.
fn to_node(node: &TreeNode) -> Node {
    let bbox = BBox::new(node.min, node.max);
    if node.is_leaf() {
        Node::leaf(bbox, node.start as usize, node.size as usize)
    } else {
        Node::interior(bbox, node.l as usize, node.r as usize)
    }
}
