//! Task 3: a tree of boxes, built (step 1) and walked (step 2). Handout: "Building a BVH" and
//! "Walking a BVH".
//!
//! ```text
//!     ┌───────────────┐                     root
//!     │ ┌────┐ ┌────┐ │                    ╱    ╲
//!     │ │ △△ │ │  △ │ │                   A      B       a leaf holds
//!     │ │ △  │ │ △  │ │                 △△△      △△      primitives[start..start + size]
//!     │ └─A──┘ └──B─┘ │
//!     └───────────────┘       SAH:  C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect
//! ```

use protocol::{Ray, Trace};

use crate::bbox::BBox;
use crate::primitive::Primitive;

/// One box of the tree. A leaf if and only if `l == r`.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Holds everything below this node.
    pub bbox: BBox,
    /// In a leaf, the place of its first primitive; elsewhere not read.
    pub start: usize,
    /// In a leaf, the number of its primitives; elsewhere not read.
    pub size: usize,
    /// In an interior node, the place of one child in `Bvh::nodes`.
    pub l: usize,
    /// In an interior node, the place of the other.
    pub r: usize,
}

impl Node {
    /// A node that holds primitives.
    pub fn leaf(bbox: BBox, start: usize, size: usize) -> Self {
        Node {
            bbox,
            start,
            size,
            l: 0,
            r: 0,
        }
    }

    /// A node that holds two others.
    pub fn interior(bbox: BBox, l: usize, r: usize) -> Self {
        Node {
            bbox,
            start: 0,
            size: 0,
            l,
            r,
        }
    }

    /// Whether the node holds primitives.
    pub fn is_leaf(&self) -> bool {
        self.l == self.r
    }
}

/// A bounding volume hierarchy: a binary tree of boxes around primitives.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// All primitives; those of one leaf stand side by side.
    pub primitives: Vec<Primitive>,
    /// All nodes, in any order. None at all if there is nothing to hold.
    pub nodes: Vec<Node>,
    /// The place of the node where everything starts: need be neither first nor last.
    pub root: usize,
}

impl Bvh {
    /// A tree from its parts.
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        Bvh {
            primitives,
            nodes,
            root,
        }
    }

    /// Builds the tree by the surface area heuristic.
    ///
    /// - Every primitive is in exactly one leaf. They may be reordered, and so may the nodes.
    /// - A node's box holds all that is below it, and nothing beyond what that needs.
    /// - A node becomes a leaf when, and only when, it has at most `max_leaf_size` (one or more)
    ///   primitives. If no plane separates them, because their centers coincide, split by count.
    /// - Of the partitions between 8 or more buckets along each of the three axes, the cheapest
    ///   by the formula above is taken.
    /// - No primitives: no nodes, or one leaf of size 0.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        // Not written yet: a list, and no tree. Pictures appear, slowly.
        let _ = max_leaf_size;
        Bvh::from_nodes(primitives, Vec::new(), 0)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    ///
    /// - A node whose box the ray misses is not entered.
    /// - Of two children, the one whose box the ray enters first goes first.
    /// - A node whose box begins beyond the closest hit so far is not entered. The slides'
    ///   pseudo-code compares `hit2.t`, which is child 2's even where child 1 comes second, and
    ///   enters `first` even if both boxes are missed: mind both.
    /// - The closest hit need not be in the first leaf: boxes overlap.
    /// - A tree may be 60 levels deep, or have no nodes.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // Not written yet: asks every primitive, however far from the ray.
        let traces = self.primitives.iter().map(|primitive| primitive.hit(ray));
        traces.fold(None, Trace::nearer)
    }
    // Room for methods of your own.
}

// Room for types of your own.

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};
    use protocol::Shape;

    use super::*;

    /// A row of balls along x, at 0, 2, 4, ...
    fn row(count: u32) -> Vec<Primitive> {
        let ball = |i| {
            Primitive::new(&Shape::Sphere {
                center: vec3(2.0 * i as f32, 0.0, 0.0),
                radius: 0.5,
                material: i,
            })
        };
        (0..count).map(ball).collect()
    }

    #[ignore = "task 3: not written yet"]
    #[test]
    fn every_primitive_is_in_one_leaf_and_no_leaf_is_too_large() {
        let bvh = Bvh::build(row(10), 2);
        let leaves: Vec<&Node> = bvh.nodes.iter().filter(|node| node.is_leaf()).collect();
        assert!(
            leaves.iter().all(|leaf| leaf.size <= 2),
            "a leaf is too large: {leaves:?}"
        );
        let count = leaves.iter().map(|leaf| leaf.size).sum::<usize>();
        assert_eq!(count, 10, "primitives in all leaves");
    }

    #[ignore = "task 3: not written yet"]
    #[test]
    fn the_nearest_sphere_of_a_row_is_hit() {
        let bvh = Bvh::build(row(10), 1);
        let trace = bvh.hit(&Ray::new(vec3(25.0, 0.0, 0.0), Vec3::NEG_X));
        let trace = trace.expect("the row lies ahead");
        let distance = trace.distance;
        assert!(
            (distance - 6.5).abs() < 1e-5,
            "distance is {distance}, wanted 6.5"
        );
        assert_eq!(trace.material, 9, "the ball that is hit");
    }

    #[ignore = "task 3: not written yet"]
    #[test]
    fn a_missed_box_is_not_entered() {
        // One leaf lies: its ball is far outside its box. The other holds what its box promises.
        let balls = row(2);
        let elsewhere = BBox::new(vec3(0.0, 7.0, 7.0), vec3(1.0, 8.0, 8.0));
        let mut all = balls[0].bbox();
        all.enclose(elsewhere);
        let nodes = vec![
            Node::interior(all, 1, 2),
            Node::leaf(balls[0].bbox(), 0, 1),
            Node::leaf(elsewhere, 1, 1),
        ];
        let bvh = Bvh::from_nodes(balls, nodes, 0);
        let trace = bvh.hit(&Ray::new(vec3(25.0, 0.0, 0.0), Vec3::NEG_X));
        assert_eq!(
            trace.map(|trace| trace.material),
            Some(0),
            "the ball that is hit"
        );
    }
}
