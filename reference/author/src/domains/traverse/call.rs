//! Calls to `Bvh::hit` on trees.

use std::mem;
use std::sync::Arc;

use protocol::{Geometry, Question, Ray, Shape};

use super::decoy::{Decoy, Outside};
use crate::domains::fields;
use crate::domains::{Aimed, Placed};
use crate::oracle::bbox::Bounds;
use crate::oracle::{Intersection, Ray64, scan};
use crate::tree::Tree;

/// A call to `Bvh::hit`.
#[derive(Clone, Debug)]
pub struct TraverseCall {
    pub(super) subject: Arc<Subject>,
    pub(super) ray: Ray,
    /// The ray from the previous call on the same tree.
    pub(super) previous: Option<Ray>,
    /// The decoy in front of the answer.
    pub(super) decoy: Option<Decoy>,
    /// The correct hit.
    pub(super) hit: Option<Intersection>,
    /// The correct hit of the previous call.
    previous_hit: Option<Intersection>,
}

/// Returns the calls in a question about a tree.
pub(super) fn calls(question: &Question) -> Vec<TraverseCall> {
    let Question::Hit(table) = question else {
        return Vec::new();
    };
    let Some(subject) = Subject::of(&table.subject).map(Arc::new) else {
        return Vec::new();
    };
    let (mut previous, mut previous_hit) = (None, None);
    let rays = table.rows.to_vec();
    let outside = Outside::all(&subject.tree);
    let calls = rays.iter().map(|&ray| {
        let previous = previous.replace(ray);
        let hit = subject.hit(&ray);
        let previous_hit = mem::replace(&mut previous_hit, hit);
        TraverseCall {
            hit,
            previous_hit,
            subject: Arc::clone(&subject),
            decoy: Decoy::of(&subject.tree, &outside, &ray, previous.as_ref()),
            previous,
            ray,
        }
    });
    calls.collect()
}

/// The leaf of a second hit that is only slightly farther away than the closest hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SecondLeaf {
    /// The second hit is in the same leaf at almost the same distance, and its primitive comes
    /// before the primitive of the closest hit.
    Same,
    /// The second hit is in a leaf whose box contains the start of the ray. Relative to the size of
    /// the tree, both hits are close to the start.
    Other,
    /// The second hit is in a leaf whose box the ray enters earlier, at almost the same distance.
    Earlier,
}

impl TraverseCall {
    /// Returns the leaf of a second hit close behind the closest hit, if there is one.
    pub(super) fn layer(&self) -> Option<SecondLeaf> {
        /// The maximum relative difference between the distances, and also the maximum distance
        /// from the start, as a fraction of the tree's diagonal.
        const MOST: f64 = 1e-3;
        let ray64 = Ray64::from(&self.ray);
        let tree = &self.subject.tree;
        let (leaf, closest) = (self.leaf_of_hit()?, self.hit?);
        let distance = |index: usize| scan::hit_distance(&ray64, &tree.shapes[index]);
        let earlier = tree
            .primitives(leaf)
            .take_while(|&index| tree.shapes[index].number() != closest.shape);
        let is_same = |other: f64| closest.distance > (1.0 - MOST) * other;
        if earlier.filter_map(distance).any(is_same) {
            return Some(SecondLeaf::Same);
        }
        let enters = |leaf: usize| Some(tree.bounds(leaf).span(&ray64)?.0);
        let is_earlier = |other: usize| {
            enters(other) < enters(leaf) && tree.primitives(other).filter_map(distance).any(is_same)
        };
        let mut others = self.subject.leaves.iter().filter(|&&other| other != leaf);
        if others.any(|&other| is_earlier(other)) {
            return Some(SecondLeaf::Earlier);
        }
        let near = ray64.min + MOST * self.subject.bounds.diagonal();
        let start = Bounds::around([ray64.origin]);
        let mut others = self.subject.leaves.iter().filter(|&&other| other != leaf);
        let is_near = |&other: &usize| {
            tree.bounds(other).contains(&start)
                && tree
                    .primitives(other)
                    .filter_map(distance)
                    .any(|it| it < near)
        };
        (closest.distance < near && others.any(is_near)).then_some(SecondLeaf::Other)
    }

    /// Returns how many nodes are still to be visited when a traversal reaches the leaf with the
    /// hit. These nodes are siblings of this leaf, or of a node above it, that the ray enters
    /// later.
    pub fn nodes_waiting(&self) -> Option<usize> {
        let (tree, ray64) = (&self.subject.tree, Ray64::from(&self.ray));
        let leaf = self.leaf_of_hit()?;
        let enters = |node: usize| Some(tree.bounds(node).span(&ray64)?.0);
        let path = tree.path(leaf);
        let steps = path.windows(2).filter(|step| {
            let parent = &tree.nodes[step[0]];
            let other = if parent.l as usize == step[1] {
                parent.r
            } else {
                parent.l
            };
            enters(other as usize) > enters(step[1])
        });
        Some(steps.count())
    }

    /// Returns the index of the hit primitive in its leaf.
    pub(super) fn place_in_leaf(&self) -> Option<usize> {
        let mut primitives = self.subject.tree.primitives(self.leaf_of_hit()?);
        primitives.position(|index| self.is_hit(index))
    }

    /// Returns the leaf of the exam's tree that contains the hit.
    pub(super) fn leaf_of_hit(&self) -> Option<usize> {
        let Subject { tree, leaves, .. } = &*self.subject;
        let mut leaves = leaves.iter().copied();
        leaves.find(|&leaf| tree.primitives(leaf).any(|index| self.is_hit(index)))
    }

    /// Returns whether a primitive is the one that is hit.
    fn is_hit(&self, primitive: usize) -> bool {
        let number = self.subject.tree.shapes[primitive].number();
        self.hit.is_some_and(|hit| hit.shape == number)
    }

    /// Returns whether the ray is almost the same as the previous one but hits at a clearly
    /// different distance.
    pub(super) fn is_after_almost_the_same_ray(&self) -> bool {
        let is_almost_the_same = |previous| fields::is_almost_the_same_ray(&previous, &self.ray);
        self.has_another_answer() && self.previous.is_some_and(is_almost_the_same)
    }

    /// Returns whether the ray's direction is opposite to, or a mirror image of, the previous ray's
    /// direction, and the ray hits at a clearly different distance.
    pub(super) fn is_after_a_mirrored_ray(&self) -> bool {
        let is_mirrored = |previous| fields::is_mirrored(&previous, &self.ray);
        self.has_another_answer() && self.previous.is_some_and(is_mirrored)
    }

    /// Returns whether the answer clearly differs from the answer to the previous call.
    fn has_another_answer(&self) -> bool {
        /// The minimum difference between the distances.
        const LEAST: f64 = 5e-4;
        match (self.hit, self.previous_hit) {
            (Some(hit), Some(other)) => {
                let (a, b) = (hit.distance, other.distance);
                (a - b).abs() > LEAST * a.max(b)
            }
            (hit, other) => hit.is_some() != other.is_some(),
        }
    }

    /// Returns whether an unreferenced primitive in front of the answer is about as large as the
    /// tree, or `None` if there is no such primitive.
    pub(super) fn unreferenced_in_front(&self) -> Option<bool> {
        /// A primitive counts as about as large as the tree if, along two axes, its extent is at
        /// least this fraction of the tree's.
        const LARGE: f64 = 0.9;
        let ray64 = Ray64::from(&self.ray);
        let end = self.hit.map_or(ray64.max, |hit| hit.distance);
        let Subject {
            tree,
            bounds,
            unreferenced,
            ..
        } = &*self.subject;
        let shapes = unreferenced.iter().map(|&index| &tree.shapes[index]);
        let in_front =
            shapes.filter(|shape| scan::hit_distance(&ray64, shape).is_some_and(|it| it < end));
        let is_large = |shape: &Shape| {
            let around = scan::bounds(shape);
            let sides = around.max - around.min;
            let is_long = sides.cmpge(LARGE * (bounds.max - bounds.min));
            bounds.contains(&around) && is_long.bitmask().count_ones() > 1
        };
        in_front.map(is_large).max()
    }
}

impl Aimed for TraverseCall {
    fn ray(&self) -> &Ray {
        &self.ray
    }
}

impl Placed for TraverseCall {
    fn bounds(&self) -> Option<Bounds> {
        let bounds = self.subject.bounds;
        (bounds.half_side() > 0.0).then_some(bounds)
    }
}

/// A tree that rays are traced through.
#[derive(Debug)]
pub(super) struct Subject {
    /// The exam's tree. A tree that the submission builds doesn't have nodes yet.
    pub(super) tree: Tree,
    pub(super) is_built: bool,
    /// The box around all primitives in leaves.
    pub(super) bounds: Bounds,
    pub(super) leaves: Vec<usize>,
    pub(super) levels: usize,
    /// The primitives that are in no leaf.
    pub(super) unreferenced: Vec<usize>,
}

impl Subject {
    /// Returns the correct hit of a ray.
    fn hit(&self, ray: &Ray) -> Option<Intersection> {
        let ray64 = Ray64::from(ray);
        if self.is_built {
            scan::closest_hit(&ray64, &self.tree.shapes)
        } else {
            self.tree.expected_hit(&ray64)
        }
    }

    fn of(geometry: &Geometry) -> Option<Subject> {
        let (tree, is_built) = match geometry {
            Geometry::List { .. } => return None,
            Geometry::Tree { .. } => (Tree::of(geometry)?, false),
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
        let is_unreferenced = |index: &usize| {
            !leaves
                .iter()
                .any(|&leaf| tree.primitives(leaf).contains(index))
        };
        let indices = 0..tree.shapes.len();
        Some(Subject {
            unreferenced: indices.filter(is_unreferenced).collect(),
            levels: levels.unwrap_or(0),
            is_built,
            bounds,
            leaves,
            tree,
        })
    }

    /// Returns the number of reachable nodes.
    pub(super) fn nodes(&self) -> usize {
        (2 * self.leaves.len()).saturating_sub(1)
    }

    /// Returns the primitives in leaves, or all primitives if the submission builds the tree.
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
