//! Calls of `Bvh::hit` of trees.

use std::sync::Arc;

use protocol::{Geometry, Question, Ray, Shape};

use super::decoy::{Decoy, Outside};
use crate::domains::Placed;
use crate::oracle::bbox::Bounds;
use crate::oracle::{Intersection, Ray64, scan};
use crate::tree::Tree;

/// A call of `Bvh::hit`.
#[derive(Clone, Debug)]
pub struct TraverseCall {
    pub(super) subject: Arc<Subject>,
    pub(super) ray: Ray,
    /// The ray of the call of the same tree before this one.
    pub(super) previous: Option<Ray>,
    /// The decoy in front of the answer.
    pub(super) decoy: Option<Decoy>,
}

/// Returns the calls of a question about a tree.
pub(super) fn calls(question: &Question) -> Vec<TraverseCall> {
    let Question::Hit(table) = question else {
        return Vec::new();
    };
    let Some(subject) = Subject::of(&table.subject).map(Arc::new) else {
        return Vec::new();
    };
    let mut previous = None;
    let rays = table.rows.to_vec();
    let outside = Outside::all(&subject.tree);
    let calls = rays.iter().map(|&ray| {
        let previous = previous.replace(ray);
        TraverseCall {
            subject: Arc::clone(&subject),
            decoy: Decoy::of(&subject.tree, &outside, &ray, previous.as_ref()),
            previous,
            ray,
        }
    });
    calls.collect()
}

impl TraverseCall {
    /// Returns the correct hit.
    pub(super) fn hit(&self) -> Option<Intersection> {
        let ray64 = Ray64::from(&self.ray);
        let Subject { tree, is_built, .. } = &*self.subject;
        if *is_built {
            scan::closest_hit(&ray64, &tree.shapes)
        } else {
            tree.expected_hit(&ray64)
        }
    }
}

impl Placed for TraverseCall {
    fn bounds(&self) -> Option<Bounds> {
        let bounds = self.subject.bounds;
        (bounds.half_side() > 0.0).then_some(bounds)
    }
}

/// A tree that rays are asked of.
#[derive(Debug)]
pub(super) struct Subject {
    /// The exam's tree. A tree that the submission builds has no nodes yet.
    pub(super) tree: Tree,
    pub(super) is_built: bool,
    /// The box around all primitives in leaves.
    pub(super) bounds: Bounds,
    pub(super) leaves: Vec<usize>,
    pub(super) levels: usize,
}

impl Subject {
    fn of(geometry: &Geometry) -> Option<Subject> {
        let (tree, is_built) = match geometry {
            Geometry::List { .. } => return None,
            Geometry::Tree {
                shapes,
                nodes,
                root,
            } => (
                Tree {
                    shapes: shapes.clone(),
                    nodes: nodes.clone(),
                    root: *root as usize,
                },
                false,
            ),
            Geometry::BuiltTree { shapes, .. } => (
                Tree {
                    shapes: shapes.clone(),
                    ..Tree::default()
                },
                true,
            ),
        };
        let leaves = tree.leaves();
        let bounds = if tree.nodes.is_empty() {
            Bounds::enclosing(tree.shapes.iter().map(scan::bounds))
        } else {
            tree.bounds(tree.root)
        };
        let levels = leaves.iter().map(|&leaf| tree.path(leaf).len()).max();
        Some(Subject {
            levels: levels.unwrap_or(0),
            is_built,
            bounds,
            leaves,
            tree,
        })
    }

    /// Returns the number of nodes that can be reached.
    pub(super) fn nodes(&self) -> usize {
        (2 * self.leaves.len()).saturating_sub(1)
    }

    /// Returns the primitives in leaves, or all that a tree is built over.
    pub(super) fn shapes(&self) -> Vec<&Shape> {
        if self.is_built {
            return self.tree.shapes.iter().collect();
        }
        let in_leaves = self
            .leaves
            .iter()
            .flat_map(|&leaf| self.tree.primitives(leaf));
        in_leaves.map(|index| &self.tree.shapes[index]).collect()
    }
}
