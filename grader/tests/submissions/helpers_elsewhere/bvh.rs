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
        let mut builder = Builder {
            items: (0..)
                .zip(&primitives)
                .map(|(index, primitive)| Item::new(index, primitive.bbox()))
                .collect(),
            nodes: Vec::with_capacity(2 * primitives.len()),
            max_leaf_size: max_leaf_size.max(1),
        };
        if !primitives.is_empty() {
            builder.build_node(0, primitives.len());
        }
        let ordered = builder.items.iter().map(|item| primitives[item.index]);
        Bvh::from_nodes(ordered.collect(), builder.nodes, 0)
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
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;

        // In this copy, the range ends at the closest hit so far.
        let mut ray = *ray;
        let mut closest = None;
        self.traverse(root, &mut ray, &mut closest);
        closest
    }

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
            (Some(in_l), Some(in_r)) => {
                let (first, second, second_begins) = if in_l.min <= in_r.min {
                    (l, r, in_r.min)
                } else {
                    (r, l, in_l.min)
                };
                self.traverse(first, ray, closest);
                if second_begins <= ray.range.max {
                    self.traverse(second, ray, closest);
                }
            }
        }
    }
}

/// A primitive's index, box and centre, which are all that building needs.
struct Item {
    index: usize,
    bbox: BBox,
    center: glam::Vec3,
}

impl Item {
    fn new(index: usize, bbox: BBox) -> Self {
        let center = bbox.center();
        Item {
            index,
            bbox,
            center,
        }
    }
}

/// The items of a node whose centres are in the same slice along an axis.
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

    fn join(&mut self, other: Bucket) {
        self.bbox.enclose(other.bbox);
        self.count += other.count;
    }

    /// Returns this side's contribution to the cost, without the constants: S · N.
    fn cost(&self) -> f32 {
        self.bbox.surface_area() * self.count as f32
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
}

impl Slices {
    const COUNT: usize = 16;

    /// Returns the slices along `axis`, or `None` if all centres coincide along it.
    fn new(centers: &BBox, axis: usize) -> Option<Self> {
        let (min, max) = (centers.min[axis], centers.max[axis]);
        let scale = Self::COUNT as f32 / (max - min);
        // The scale overflows if the extent is tiny; then the centres count as coinciding.
        (max > min && scale.is_finite()).then_some(Slices { axis, min, scale })
    }

    /// Returns the index of an item's bucket. Both filling the buckets and partitioning the items
    /// call this function, because they must agree.
    fn bucket(&self, item: &Item) -> usize {
        let slice = (item.center[self.axis] - self.min) * self.scale;
        (slice as usize).min(Self::COUNT - 1)
    }
}

struct Builder {
    items: Vec<Item>,
    nodes: Vec<Node>,
    max_leaf_size: usize,
}

impl Builder {
    /// Builds the node over `items[start..end]`, which must not be empty. Returns its index.
    fn build_node(&mut self, start: usize, end: usize) -> usize {
        let mut bbox = BBox::EMPTY;
        let mut centers = BBox::EMPTY;
        for item in &self.items[start..end] {
            bbox = BBox::union(bbox, item.bbox);
            centers.enclose_point(item.center);
        }

        let index = self.nodes.len();
        self.nodes.push(Node::leaf(bbox, start, end - start));
        if end - start > self.max_leaf_size {
            let middle = start + self.partition(start, end, &centers);
            let l = self.build_node(start, middle);
            let r = self.build_node(middle, end);
            self.nodes[index] = Node::interior(bbox, l, r);
        }
        index
    }

    /// Partitions `items[start..end]` by the cheapest split. Returns the size of the left side.
    fn partition(&mut self, start: usize, end: usize, centers: &BBox) -> usize {
        let items = &mut self.items[start..end];
        let splits = (0..3).filter_map(|axis| cheapest_split(items, centers, axis));
        let Some(split) = splits.min_by(|a, b| a.cost.total_cmp(&b.cost)) else {
            return items.len() / 2; // All centres coincide.
        };
        let slices = Slices::new(centers, split.axis).expect("the split is along this axis");

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

/// Returns the cheapest partition between two buckets along one axis, or `None` if there is none:
/// binned SAH, after Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007,
/// section 3.
///
/// In C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect, only S_A · N_A + S_B · N_B
/// differs between the partitions of a node.
fn cheapest_split(items: &[Item], centers: &BBox, axis: usize) -> Option<Split> {
    let slices = Slices::new(centers, axis)?;
    let mut buckets = [Bucket::EMPTY; Slices::COUNT];
    for item in items {
        buckets[slices.bucket(item)].join(Bucket {
            bbox: item.bbox,
            count: 1,
        });
    }

    // Sweep from the right: the costs of the right child.
    let mut right_costs = [0.0; Slices::COUNT];
    let mut right = Bucket::EMPTY;
    for i in (1..Slices::COUNT).rev() {
        right.join(buckets[i]);
        right_costs[i] = right.cost();
    }

    // Sweep from the left: the costs of the left child. The first and the last bucket are never
    // empty, so neither child is empty.
    let mut left = Bucket::EMPTY;
    let costs = (1..Slices::COUNT).map(|bucket| {
        left.join(buckets[bucket - 1]);
        let cost = left.cost() + right_costs[bucket];
        Split { axis, bucket, cost }
    });
    costs.min_by(|a, b| a.cost.total_cmp(&b.cost))
}
