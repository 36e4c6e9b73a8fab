//! Construction of trees over shapes.

use glam::{DVec3, Vec3};
use protocol::{Shape, TreeNode};

use super::Tree;
use crate::oracle::bbox::Bounds;
use crate::oracle::scan;

/// Builds a tree by median splits along the longest axis of the centres.
pub fn median_split(shapes: Vec<Shape>, max_leaf_size: usize) -> Tree {
    let mut tree = Tree::default();
    tree.root = tree.add_median_split(shapes, max_leaf_size);
    tree
}

/// Builds a degenerate tree: the left child of each interior node is a leaf with one shape. The
/// leaves are in the order of the shapes.
pub fn chain(shapes: Vec<Shape>) -> Tree {
    let mut tree = Tree::default();
    // Build from the deepest node upward.
    let mut below: Option<usize> = None;
    for shape in shapes.into_iter().rev() {
        let leaf = tree.add_leaf(vec![shape]);
        below = Some(match below {
            None => leaf,
            Some(rest) => tree.add_interior(leaf, rest),
        });
    }
    tree.root = below.expect("there is at least one shape");
    tree
}

impl Tree {
    /// Adds a leaf with these shapes and a tight box. Returns its index.
    pub fn add_leaf(&mut self, shapes: Vec<Shape>) -> usize {
        let (min, max) = corners_around(&shapes);
        let (start, size) = (self.shapes.len(), shapes.len());
        let node = TreeNode::new(min, max, start, size, 0, 0);
        self.shapes.extend(shapes);
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Adds an interior node with two existing nodes as its children. Returns its index.
    pub fn add_interior(&mut self, l: usize, r: usize) -> usize {
        let (left, right) = (&self.nodes[l], &self.nodes[r]);
        let (min, max) = (left.min.min(right.min), left.max.max(right.max));
        let node = TreeNode::new(min, max, 0, 0, l, r);
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Refits the boxes of all nodes below `tops` after their primitives have been moved.
    pub fn refit_below(&mut self, tops: &[usize]) {
        for &top in tops {
            // In this order, children come before their parents.
            for &index in self.subtree(top)[1..].iter().rev() {
                let node = self.nodes[index];
                let (min, max) = if node.is_leaf() {
                    corners_around(&self.shapes[self.primitives(index)])
                } else {
                    let [l, r] = [node.l, node.r].map(|child| &self.nodes[child as usize]);
                    (l.min.min(r.min), l.max.max(r.max))
                };
                self.nodes[index] = TreeNode { min, max, ..node };
            }
        }
    }

    fn add_median_split(&mut self, mut shapes: Vec<Shape>, max_leaf_size: usize) -> usize {
        if shapes.len() <= max_leaf_size {
            return self.add_leaf(shapes);
        }
        let center = |shape: &Shape| scan::bounds(shape).center();
        let size = {
            let centers = Bounds::around(shapes.iter().map(center));
            centers.max - centers.min
        };
        let axis = (0..3)
            .max_by(|&a, &b| size[a].total_cmp(&size[b]))
            .unwrap_or(0);
        shapes.sort_by(|a, b| center(a)[axis].total_cmp(&center(b)[axis]));
        let right = shapes.split_off(shapes.len() / 2);
        let l = self.add_median_split(shapes, max_leaf_size);
        let r = self.add_median_split(right, max_leaf_size);
        self.add_interior(l, r)
    }
}

/// Returns the corners of the tight box around some shapes.
fn corners_around(shapes: &[Shape]) -> (Vec3, Vec3) {
    let bounds = Bounds::enclosing(shapes.iter().map(scan::bounds));
    let min = round_outward(bounds.min, f32::next_down);
    let max = round_outward(bounds.max, f32::next_up);
    (min, max)
}

/// Rounds a corner of a box to single precision. Coordinates that aren't exact are rounded outward.
/// The corners of flat triangles are exact, so flat boxes stay flat. The extents of a sphere may be
/// inexact.
fn round_outward(exact: DVec3, outward: fn(f32) -> f32) -> Vec3 {
    let component = |axis: usize| {
        let nearest = exact[axis] as f32;
        if f64::from(nearest) == exact[axis] {
            nearest
        } else {
            outward(nearest)
        }
    };
    Vec3::new(component(0), component(1), component(2))
}
