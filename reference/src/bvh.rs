//! Task 3: building a tree of boxes (step 1) and traversing it (step 2). Handout: "Building a BVH"
//! and "Traversing a BVH".
//!
//! ```text
//!     ┌───────────────┐                     root
//!     │ ┌────┐ ┌────┐ │                    ╱    ╲
//!     │ │ △△ │ │  △ │ │                   A      B       a leaf holds
//!     │ │ △  │ │ △  │ │                 △△△      △△      primitives[start..start + size]
//!     │ └─A──┘ └──B─┘ │
//!     └───────────────┘       SAH:  C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect
//! ```
//!
//! | on the slides | here |
//! |---|---|
//! | `Node`, `BVHNode` | [`Node`] |
//! | `child1`, `child2` | `l` and `r`, indices into [`Bvh::nodes`] |
//! | `leaf`, `primList` | [`Node::is_leaf`], `primitives[start..start + size]` |
//! | `Bbox.enclose`, `Bbox.center` | [`BBox::enclose`], [`BBox::center`] |
//! | `intersect(ray, child->bbox)`, `hit1.t` | [`BBox::hit`], the `min` of its result |
//! | `HitInfo`, `best.t` | [`Trace`], its `distance` |
//! | `std::partition` | a loop with `swap`, or `Iterator::partition` |

use protocol::{Ray, Trace};

use crate::bbox::BBox;
use crate::primitive::Primitive;

/// A node of the tree. It is a leaf if and only if `l == r`.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// The box around everything below this node.
    pub bbox: BBox,
    /// In a leaf, the index of its first primitive in [`Bvh::primitives`]. Ignored in other nodes.
    pub start: usize,
    /// In a leaf, the number of its primitives. Ignored in other nodes.
    pub size: usize,
    /// In an interior node, the index of one child in [`Bvh::nodes`].
    pub l: usize,
    /// In an interior node, the index of the other child in [`Bvh::nodes`].
    pub r: usize,
}

impl Node {
    /// Creates a leaf, which holds primitives.
    pub fn leaf(bbox: BBox, start: usize, size: usize) -> Self {
        Node {
            bbox,
            start,
            size,
            l: 0,
            r: 0,
        }
    }

    /// Creates an interior node, which has two children.
    pub fn interior(bbox: BBox, l: usize, r: usize) -> Self {
        Node {
            bbox,
            start: 0,
            size: 0,
            l,
            r,
        }
    }

    /// Returns whether the node is a leaf.
    pub fn is_leaf(&self) -> bool {
        self.l == self.r
    }
}

/// A bounding volume hierarchy: a binary tree of boxes around primitives.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// All primitives. Those of one leaf are next to each other.
    pub primitives: Vec<Primitive>,
    /// All nodes, in any order. A tree without primitives may have no nodes.
    pub nodes: Vec<Node>,
    /// The index of the root in `nodes`. The root can be any node, not only the first or the last.
    pub root: usize,
}

impl Bvh {
    /// Creates a tree from its primitives, its nodes and the index of its root.
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        Bvh {
            primitives,
            nodes,
            root,
        }
    }

    /// Builds the tree with the surface area heuristic (SAH).
    ///
    /// - Every primitive is in exactly one leaf. You may reorder the primitives and the nodes.
    /// - The box of a node contains everything below the node, and is no larger than necessary.
    /// - A node is a leaf if and only if it has at most `max_leaf_size` primitives (1 or more). If
    ///   all centres coincide, no plane separates the primitives: then split them by count.
    /// - Use 8 or more buckets along each of the three axes, and take the partition with the lowest
    ///   cost by the formula at the top of this file.
    /// - Without primitives, the tree has no nodes, or one leaf of size 0.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        // solution
        // starter: // Not written yet: this is a list without a tree. Pictures work, but slowly.
        // starter: let _ = max_leaf_size;
        // starter: Bvh::from_nodes(primitives, Vec::new(), 0)
        let mut builder = Builder {
            items: (0..).zip(&primitives).map(Item::new).collect(),
            nodes: Vec::new(),
            max_leaf_size: max_leaf_size.max(1),
        };
        if !primitives.is_empty() {
            builder.build_node(0, primitives.len());
        }
        let ordered = builder.items.iter().map(|item| primitives[item.index]);
        Bvh::from_nodes(ordered.collect(), builder.nodes, 0)
        // end solution
    }

    /// Returns the ray's closest hit on any primitive, or `None` if there is none within
    /// `ray.range`.
    ///
    /// - Do not enter a node whose box the ray misses.
    /// - If the ray hits the boxes of both children, visit the child whose box it enters first.
    /// - Do not enter a node whose box begins beyond the closest hit so far.
    /// - Boxes overlap, so the closest hit can be in a leaf that you visit later.
    /// - The tree can be 60 levels deep, and it can have no nodes.
    ///
    /// Do not take the slides' pseudo-code literally. It compares `hit2.t`, the entry of `child2`,
    /// even if `second` is `child1`. It also enters `first` even if the ray misses both boxes.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // solution
        // starter: // Not written yet: this tests every primitive, without using the tree.
        // starter: let traces = self.primitives.iter().map(|primitive| primitive.hit(ray));
        // starter: traces.fold(None, Trace::nearer)
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;

        // In this copy, the range ends at the closest hit so far.
        let mut ray = *ray;
        let mut closest = None;
        self.traverse(root, &mut ray, &mut closest);
        closest
        // end solution
    }
    // solution
    // starter:
    // starter: // Add your own methods here.

    /// Finds the closest hit below `node`, whose box the ray hits.
    fn traverse(&self, node: &Node, ray: &mut Ray, closest: &mut Option<Trace>) {
        if node.is_leaf() {
            for primitive in &self.primitives[node.start..node.start + node.size] {
                if let Some(trace) = primitive.hit(ray) {
                    ray.range.max = trace.distance;
                    *closest = Some(trace);
                }
            }
            return;
        }

        let (l, r) = (&self.nodes[node.l], &self.nodes[node.r]);
        match (l.bbox.hit(ray, ray.range), r.bbox.hit(ray, ray.range)) {
            (None, None) => {}
            (Some(_), None) => self.traverse(l, ray, closest),
            (None, Some(_)) => self.traverse(r, ray, closest),
            (Some(in_l), Some(in_r)) => {
                let (first, second, second_begins) = if in_l.min <= in_r.min {
                    (l, r, in_r.min)
                } else {
                    (r, l, in_l.min)
                };
                self.traverse(first, ray, closest);
                // The first child may have a hit in front of the second child's box.
                if second_begins <= ray.range.max {
                    self.traverse(second, ray, closest);
                }
            }
        }
    }
    // end solution
}

// solution
// starter: // Add your own types here.
/// A primitive's index, its box and the centre of the box, which are all that building needs.
struct Item {
    index: usize,
    bbox: BBox,
    center: glam::Vec3,
}

impl Item {
    fn new((index, primitive): (usize, &Primitive)) -> Self {
        let bbox = primitive.bbox();
        Item {
            index,
            bbox,
            center: bbox.center(),
        }
    }
}

/// The tree while it is built.
struct Builder {
    items: Vec<Item>,
    nodes: Vec<Node>,
    max_leaf_size: usize,
}

impl Builder {
    /// Builds the node over `items[start..end]`, which is not empty, and everything below. Returns
    /// the node's index.
    fn build_node(&mut self, start: usize, end: usize) -> usize {
        let items = &mut self.items[start..end];
        let mut bbox = BBox::EMPTY;
        for item in items.iter() {
            bbox.enclose(item.bbox);
        }

        let index = self.nodes.len();
        self.nodes.push(Node::leaf(bbox, start, end - start));
        if end - start > self.max_leaf_size {
            let middle = start + partition(items);
            let l = self.build_node(start, middle);
            let r = self.build_node(middle, end);
            self.nodes[index] = Node::interior(bbox, l, r);
        }
        index
    }
}

/// Partitions the items in place by the cheapest split; returns the size of the left side.
fn partition(items: &mut [Item]) -> usize {
    let mut centers = BBox::EMPTY;
    for item in items.iter() {
        centers.enclose_point(item.center);
    }
    let Some(split) = cheapest_split(items, &centers) else {
        return items.len() / 2; // All centres coincide.
    };

    // Like `std::partition`: swap each item of the left side to the end of that side.
    let mut left_size = 0;
    for i in 0..items.len() {
        if compute_bucket(&items[i], split.axis, &centers) < split.plane {
            items.swap(left_size, i);
            left_size += 1;
        }
    }
    left_size
}

/// A partition: the items in buckets below `plane` along `axis` go to the left side.
struct Split {
    axis: usize,
    plane: usize,
    cost: f32,
}

/// Returns the cheapest of all partitions, or `None` if all centres coincide.
///
/// This is binned SAH: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007,
/// section 3. The partitions of one node differ only in the term S_A · N_A + S_B · N_B of
/// C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect.
fn cheapest_split(items: &[Item], centers: &BBox) -> Option<Split> {
    let mut best: Option<Split> = None;
    for axis in 0..3 {
        if centers.min[axis] == centers.max[axis] {
            continue; // No plane separates the centres.
        }

        let mut buckets = [Bucket::EMPTY; BUCKETS];
        for item in items {
            buckets[compute_bucket(item, axis, centers)].add(item.bbox, 1);
        }

        // From the right: the cost of the right side of each plane.
        let mut right = Bucket::EMPTY;
        let mut right_costs = [0.0; BUCKETS];
        for plane in (1..BUCKETS).rev() {
            right.add(buckets[plane].bbox, buckets[plane].count);
            right_costs[plane] = right.cost();
        }

        // From the left: the cost of both sides. Neither is empty, since the first and the last bucket
        // never are.
        let mut left = Bucket::EMPTY;
        for plane in 1..BUCKETS {
            left.add(buckets[plane - 1].bbox, buckets[plane - 1].count);
            let cost = left.cost() + right_costs[plane];
            if best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(Split { axis, plane, cost });
            }
        }
    }
    best
}

/// The number of buckets along each axis.
const BUCKETS: usize = 16;

/// Returns the index of an item's bucket. The buckets divide the box of all centres along `axis`
/// into slices of equal width.
fn compute_bucket(item: &Item, axis: usize, centers: &BBox) -> usize {
    let (min, max) = (centers.min[axis], centers.max[axis]);
    let fraction = (item.center[axis] - min) / (max - min);
    // The largest centre, at fraction 1, belongs to the last bucket.
    ((fraction * BUCKETS as f32) as usize).min(BUCKETS - 1)
}

/// The items of a bucket, or of all buckets on one side of a plane.
#[derive(Clone, Copy)]
struct Bucket {
    bbox: BBox,
    count: usize,
}

impl Bucket {
    const EMPTY: Bucket = Bucket {
        bbox: BBox::EMPTY,
        count: 0,
    };

    fn add(&mut self, bbox: BBox, count: usize) {
        self.bbox.enclose(bbox);
        self.count += count;
    }

    /// Returns this side's contribution to the cost, without the constants: S · N.
    fn cost(&self) -> f32 {
        self.bbox.surface_area() * self.count as f32
    }
}
// end solution

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};
    use protocol::Shape;

    use super::*;

    /// A row of spheres with radius 0.5 along the x-axis, with their centres at x = 0, 2, 4, ...
    fn row(count: u32) -> Vec<Primitive> {
        let sphere = |i| {
            Primitive::new(&Shape::Sphere {
                center: vec3(2.0 * i as f32, 0.0, 0.0),
                radius: 0.5,
                material: i,
            })
        };
        (0..count).map(sphere).collect()
    }

    // starter: #[ignore = "task 3: not written yet"]
    #[test]
    fn every_primitive_is_in_one_leaf_and_no_leaf_is_too_large() {
        let bvh = Bvh::build(row(10), 2);
        let leaves: Vec<&Node> = bvh.nodes.iter().filter(|node| node.is_leaf()).collect();
        assert!(
            leaves.iter().all(|leaf| leaf.size <= 2),
            "expected at most 2 primitives in each leaf, got {leaves:?}"
        );
        let count = leaves.iter().map(|leaf| leaf.size).sum::<usize>();
        assert_eq!(
            count, 10,
            "wrong number of primitives in all leaves: left is yours, right is correct"
        );
    }

    // starter: #[ignore = "task 3: not written yet"]
    #[test]
    fn the_nearest_sphere_of_a_row_is_hit() {
        let bvh = Bvh::build(row(10), 1);
        let trace = bvh.hit(&Ray::new(vec3(25.0, 0.0, 0.0), Vec3::NEG_X));
        let trace = trace.expect("expected a hit, got None");
        let distance = trace.distance;
        assert!(
            (distance - 6.5).abs() < 1e-5,
            "expected distance 6.5, got {distance}"
        );
        assert_eq!(
            trace.material, 9,
            "wrong material: left is yours, right is correct"
        );
    }

    // starter: #[ignore = "task 3: not written yet"]
    #[test]
    fn a_missed_box_is_not_entered() {
        // The second leaf is a decoy: its sphere is far outside its box, which the ray misses.
        // So a correct traversal never tests that sphere, although the ray would hit it first.
        let spheres = row(2);
        let elsewhere = BBox::new(vec3(0.0, 7.0, 7.0), vec3(1.0, 8.0, 8.0));
        let mut all = spheres[0].bbox();
        all.enclose(elsewhere);
        let nodes = vec![
            Node::interior(all, 1, 2),
            Node::leaf(spheres[0].bbox(), 0, 1),
            Node::leaf(elsewhere, 1, 1),
        ];
        let bvh = Bvh::from_nodes(spheres, nodes, 0);
        let trace = bvh.hit(&Ray::new(vec3(25.0, 0.0, 0.0), Vec3::NEG_X));
        assert_eq!(
            trace.map(|trace| trace.material),
            Some(0),
            "wrong material: left is yours, right is correct"
        );
    }
}
