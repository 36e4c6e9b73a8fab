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
            items: (0..)
                .zip(&primitives)
                .map(|(index, primitive)| Item::new(index, primitive.bbox()))
                .collect(),
            nodes: Vec::with_capacity(2 * primitives.len()),
            max_leaf_size: max_leaf_size.max(1),
            buckets: Buckets::default(),
        };
        if !primitives.is_empty() {
            let root = builder.reserve_node();
            builder.build_node(root, 0, primitives.len());
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

    /// Finds the closest hit below `node`, whose box the ray is known to hit.
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
            (Some(in_l), Some(in_r)) if in_l.min <= in_r.min => {
                self.traverse_both(l, r, in_r.min, ray, closest);
            }
            (Some(in_l), Some(_)) => self.traverse_both(r, l, in_l.min, ray, closest),
        }
    }

    /// Finds the closest hit below two nodes whose boxes the ray hits. Skips the second node if its
    /// box begins beyond the closest hit.
    ///
    /// Two call sites instead of a swap: the branch predictor can guess which child is nearer,
    /// while a swap would stall until both boxes are loaded.
    fn traverse_both(
        &self,
        first: &Node,
        second: &Node,
        second_begins: f32,
        ray: &mut Ray,
        closest: &mut Option<Trace>,
    ) {
        self.traverse(first, ray, closest);
        if second_begins <= ray.range.max {
            self.traverse(second, ray, closest);
        }
    }
    // end solution
}

// solution
// starter: // Add your own types here.
/// A box with each corner in one SIMD register. Building spends most of its time joining boxes.
#[derive(Clone, Copy)]
struct Bounds {
    min: glam::Vec3A,
    max: glam::Vec3A,
}

impl Bounds {
    const EMPTY: Bounds = Bounds {
        min: glam::Vec3A::INFINITY,
        max: glam::Vec3A::NEG_INFINITY,
    };

    fn of(bbox: BBox) -> Self {
        Bounds {
            min: bbox.min.to_vec3a(),
            max: bbox.max.to_vec3a(),
        }
    }

    fn enclose(&mut self, other: Bounds) {
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    fn enclose_point(&mut self, point: glam::Vec3A) {
        self.min = self.min.min(point);
        self.max = self.max.max(point);
    }

    fn bbox(self) -> BBox {
        BBox::new(self.min.to_vec3(), self.max.to_vec3())
    }
}

/// A primitive's index, box and centre, which are all that building needs.
struct Item {
    index: usize,
    bounds: Bounds,
    center: glam::Vec3A,
}

impl Item {
    fn new(index: usize, bbox: BBox) -> Self {
        let center = bbox.center().to_vec3a();
        Item {
            index,
            bounds: Bounds::of(bbox),
            center,
        }
    }
}

/// The items of a node whose centres are in the same slice along an axis.
#[derive(Clone, Copy)]
struct Bucket {
    bounds: Bounds,
    count: usize,
}

impl Bucket {
    const EMPTY: Bucket = Bucket {
        bounds: Bounds::EMPTY,
        count: 0,
    };

    fn join(&mut self, other: Bucket) {
        self.bounds.enclose(other.bounds);
        self.count += other.count;
    }

    /// Returns this side's contribution to the cost, without the constants: S · N.
    fn cost(&self) -> f32 {
        self.bounds.bbox().surface_area() * self.count as f32
    }
}

/// A partition: the items in buckets below `bucket` along `axis` go to the left side.
struct Split {
    axis: usize,
    bucket: usize,
    cost: f32,
}

/// Slices of equal width along one axis, over the range of the items' centres.
struct Slices {
    axis: usize,
    min: f32,
    scale: f32,
    count: usize,
}

impl Slices {
    const MIN_COUNT: usize = 8;
    const MAX_COUNT: usize = 64;
    /// The number of slices grows by one for every so many items.
    const ITEMS_PER_SLICE: usize = 32;

    /// Returns the slices along `axis`, or `None` if all centres coincide along it.
    ///
    /// Small nodes get few slices: most nodes are small, and comparing partitions takes longer
    /// there than filling the buckets. In large nodes the comparison costs almost nothing, and
    /// their splits matter most for traversal.
    fn new(centers: &Bounds, axis: usize, items: usize) -> Option<Self> {
        let (min, max) = (centers.min[axis], centers.max[axis]);
        let count = (Self::MIN_COUNT + items / Self::ITEMS_PER_SLICE).min(Self::MAX_COUNT);
        let scale = count as f32 / (max - min);
        // The scale overflows if the extent is tiny; then the centres count as coinciding.
        (max > min && scale.is_finite()).then_some(Slices {
            axis,
            min,
            scale,
            count,
        })
    }

    /// Returns the index of an item's bucket. Both filling the buckets and partitioning the items
    /// call this function, because they must agree.
    fn bucket(&self, item: &Item) -> usize {
        let slice = (item.center[self.axis] - self.min) * self.scale;
        // `as u8` saturates at 255, and takes a third of the time of `as usize`.
        usize::from(slice as u8).min(self.count - 1)
    }
}

struct Builder {
    items: Vec<Item>,
    nodes: Vec<Node>,
    max_leaf_size: usize,
    buckets: Buckets,
}

impl Builder {
    /// Appends a placeholder node and returns its index.
    fn reserve_node(&mut self) -> usize {
        self.nodes.push(Node::leaf(BBox::EMPTY, 0, 0));
        self.nodes.len() - 1
    }

    /// Builds the node at `index` over `items[start..end]`, which is not empty, and everything
    /// below.
    fn build_node(&mut self, index: usize, start: usize, end: usize) {
        let mut bounds = Bounds::EMPTY;
        let mut centers = Bounds::EMPTY;
        for item in &self.items[start..end] {
            bounds.enclose(item.bounds);
            centers.enclose_point(item.center);
        }
        let bbox = bounds.bbox();

        self.nodes[index] = Node::leaf(bbox, start, end - start);
        if end - start > self.max_leaf_size {
            let middle = start + self.partition(start, end, &centers);
            // Adjacent in memory, because traversal tests both boxes together.
            let (l, r) = (self.reserve_node(), self.reserve_node());
            self.build_node(l, start, middle);
            self.build_node(r, middle, end);
            self.nodes[index] = Node::interior(bbox, l, r);
        }
    }

    /// Partitions `items[start..end]` in place by the cheapest split; returns the size of the left
    /// side.
    fn partition(&mut self, start: usize, end: usize, centers: &Bounds) -> usize {
        let (items, buckets) = (&mut self.items[start..end], &mut self.buckets);
        let splits = (0..3).filter_map(|axis| buckets.cheapest_split(items, centers, axis));
        let Some(split) = splits.min_by(|a, b| a.cost.total_cmp(&b.cost)) else {
            return items.len() / 2; // All centres coincide.
        };
        let slices = Slices::new(centers, split.axis, items.len());
        let slices = slices.expect("the split is along an axis with an extent");

        // Like `std::partition`: swap each item of the left side to the end of that side.
        let mut first = 0;
        for i in 0..items.len() {
            if slices.bucket(&items[i]) < split.bucket {
                items.swap(first, i);
                first += 1;
            }
        }
        first
    }
}

/// The buckets of one node along one axis. The vectors are reused for the next axis or node, to
/// save allocations.
#[derive(Default)]
struct Buckets {
    all: Vec<Bucket>,
    /// For each bucket, the cost of a child that holds this bucket and all to its right.
    right_costs: Vec<f32>,
}

impl Buckets {
    /// Returns the cheapest partition along one axis, or `None` if all centres coincide along it.
    ///
    /// This is binned SAH: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies",
    /// 2007, section 3. The partitions of one node differ only in the term S_A · N_A + S_B · N_B of
    /// C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect.
    fn cheapest_split(&mut self, items: &[Item], centers: &Bounds, axis: usize) -> Option<Split> {
        let slices = Slices::new(centers, axis, items.len())?;
        let Buckets {
            all: buckets,
            right_costs,
        } = self;

        buckets.clear();
        buckets.resize(slices.count, Bucket::EMPTY);
        for item in items {
            buckets[slices.bucket(item)].join(Bucket {
                bounds: item.bounds,
                count: 1,
            });
        }

        // Sweep from the right: the costs of the right child.
        right_costs.resize(slices.count, 0.0);
        let mut right = Bucket::EMPTY;
        for i in (1..slices.count).rev() {
            right.join(buckets[i]);
            right_costs[i] = right.cost();
        }

        // Sweep from the left: the costs of the left child. The first and the last bucket are never
        // empty, so neither child is empty.
        let mut left = Bucket::EMPTY;
        let costs = (1..slices.count).map(|bucket| {
            left.join(buckets[bucket - 1]);
            let cost = left.cost() + right_costs[bucket];
            Split { axis, bucket, cost }
        });
        costs.min_by(|a, b| a.cost.total_cmp(&b.cost))
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
