//! Ways through a tree in single precision: right ones, and wrong ones.

mod parts;
pub mod whole;
pub mod wrong;

use protocol::{Interval, Ray, Shape, Trace, TreeNode};

use super::Solver;
use super::boxes::BOXES;

/// What is walked.
pub struct Scene<'a> {
    pub shapes: &'a [Shape],
    pub nodes: &'a [TreeNode],
    pub root: usize,
}

/// The answers to all rays of a question, one after the other.
pub type Walk = fn(&Scene, &[Ray]) -> Vec<Option<Trace>>;

impl Scene<'_> {
    fn node(&self, place: usize) -> &TreeNode {
        &self.nodes[place]
    }

    fn children(&self, place: usize) -> [usize; 2] {
        let node = self.node(place);
        [node.l as usize, node.r as usize]
    }

    fn in_leaf(&self, place: usize) -> &[Shape] {
        let node = self.node(place);
        &self.shapes[node.start as usize..(node.start + node.size) as usize]
    }

    fn span(&self, place: usize, ray: &Ray) -> Option<Interval> {
        let node = self.node(place);
        BOXES[0].1(ray, ray.range, node.min, node.max)
    }

    fn each(&self, rays: &[Ray], walk: impl Fn(&Ray) -> Option<Trace>) -> Vec<Option<Trace>> {
        let nothing = self.nodes.is_empty();
        rays.iter()
            .map(|ray| if nothing { None } else { walk(ray) })
            .collect()
    }
}

/// What one primitive answers.
pub fn ask(ray: &Ray, shape: &Shape) -> Option<Trace> {
    Solver::RIGHT.hit(ray, shape)
}

fn closest(ray: &Ray, shapes: &[Shape]) -> Option<Trace> {
    shapes
        .iter()
        .map(|shape| ask(ray, shape))
        .fold(None, Trace::nearer)
}
