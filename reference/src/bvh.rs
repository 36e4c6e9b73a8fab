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
        // solution
        // starter: // Not written yet: a list, and no tree. Pictures appear, slowly.
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
            let root = builder.place();
            builder.node(root, 0, primitives.len());
        }
        let ordered = builder.items.iter().map(|item| primitives[item.index]);
        Bvh::from_nodes(ordered.collect(), builder.nodes, 0)
        // end solution
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
        // solution
        // starter: // Not written yet: asks every primitive, however far from the ray.
        // starter: let traces = self.primitives.iter().map(|primitive| primitive.hit(ray));
        // starter: traces.fold(None, Trace::nearer)
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;

        // What is left of the ray shrinks to the closest hit, in a copy.
        let mut ray = *ray;
        let mut closest = None;
        self.visit(root, &mut ray, &mut closest);
        closest
        // end solution
    }
    // solution
    // starter: // Room for methods of your own.

    /// Looks for a hit below `node`, whose box the ray is known to meet.
    fn visit(&self, node: &Node, ray: &mut Ray, closest: &mut Option<Trace>) {
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
            (Some(_), None) => self.visit(l, ray, closest),
            (None, Some(_)) => self.visit(r, ray, closest),
            (Some(in_l), Some(in_r)) if in_l.min <= in_r.min => {
                self.visit_both(l, r, in_r.min, ray, closest);
            }
            (Some(in_l), Some(_)) => self.visit_both(r, l, in_l.min, ray, closest),
        }
    }

    /// Looks below two nodes whose boxes the ray meets; below the second unless what was found is
    /// closer than its box. Called in two places: which of them comes next can be guessed, where to
    /// exchange two nodes would wait for their boxes.
    fn visit_both(
        &self,
        first: &Node,
        second: &Node,
        second_begins: f32,
        ray: &mut Ray,
        closest: &mut Option<Trace>,
    ) {
        self.visit(first, ray, closest);
        if second_begins <= ray.range.max {
            self.visit(second, ray, closest);
        }
    }
    // end solution
}

// solution
// starter: // Room for types of your own.
/// A box with each corner in one register: to join boxes is most of what building does.
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

/// What building needs to know of a primitive.
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

/// The part of a node's items whose centers lie in one slice along an axis.
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

    /// Its share of the cost, but for the constants: S · N.
    fn cost(&self) -> f32 {
        self.bounds.bbox().surface_area() * self.count as f32
    }
}

/// A partition: the items whose bucket along `axis` is below `bucket` go to one side.
struct Split {
    axis: usize,
    bucket: usize,
    cost: f32,
}

/// Equal slices of the range of the items' centers along one axis.
struct Slices {
    axis: usize,
    min: f32,
    scale: f32,
    count: usize,
}

impl Slices {
    const FEWEST: usize = 8;
    const MOST: usize = 64;
    /// One more slice for so many items.
    const ITEMS: usize = 32;

    /// The slices along `axis`, unless all centers coincide there. For a few items a few will do:
    /// most nodes are small, and to compare partitions takes more time there than to count items.
    /// In large nodes it takes next to none, and what is chosen there matters most.
    fn new(centers: &Bounds, axis: usize, items: usize) -> Option<Self> {
        let (min, max) = (centers.min[axis], centers.max[axis]);
        let count = (Self::FEWEST + items / Self::ITEMS).min(Self::MOST);
        let scale = count as f32 / (max - min);
        // An extent so small that its inverse overflows is as good as none.
        (max > min && scale.is_finite()).then_some(Slices {
            axis,
            min,
            scale,
            count,
        })
    }

    /// The one place that says which bucket an item is in: counting and partitioning must agree.
    fn bucket(&self, item: &Item) -> usize {
        let slice = (item.center[self.axis] - self.min) * self.scale;
        // `as u8` ends at 255, and takes a third of the time that `as usize` does.
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
    /// Keeps a place for a node.
    fn place(&mut self) -> usize {
        self.nodes.push(Node::leaf(BBox::EMPTY, 0, 0));
        self.nodes.len() - 1
    }

    /// Builds the node over `items[start..end]`, which are not none, in its place, and all below it.
    fn node(&mut self, place: usize, start: usize, end: usize) {
        let mut bounds = Bounds::EMPTY;
        let mut centers = Bounds::EMPTY;
        for item in &self.items[start..end] {
            bounds.enclose(item.bounds);
            centers.enclose_point(item.center);
        }
        let bbox = bounds.bbox();

        self.nodes[place] = Node::leaf(bbox, start, end - start);
        if end - start > self.max_leaf_size {
            let middle = start + self.partition(start, end, &centers);
            // Side by side: a walk looks at the boxes of both together.
            let (l, r) = (self.place(), self.place());
            self.node(l, start, middle);
            self.node(r, middle, end);
            self.nodes[place] = Node::interior(bbox, l, r);
        }
    }

    /// Reorders `items[start..end]` by the cheapest split; returns how many come first.
    fn partition(&mut self, start: usize, end: usize, centers: &Bounds) -> usize {
        let (items, buckets) = (&mut self.items[start..end], &mut self.buckets);
        let splits = (0..3).filter_map(|axis| buckets.cheapest_split(items, centers, axis));
        let Some(split) = splits.min_by(|a, b| a.cost.total_cmp(&b.cost)) else {
            return items.len() / 2; // All centers coincide.
        };
        let slices = Slices::new(centers, split.axis, items.len());
        let slices = slices.expect("it was split along this axis");

        // As `std::partition` does: the first side grows by swapping.
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

/// The buckets of one node along one axis; kept from one to the next, because to ask for memory
/// takes time.
#[derive(Default)]
struct Buckets {
    all: Vec<Bucket>,
    /// What all the buckets from one on would cost as one child.
    right_costs: Vec<f32>,
}

impl Buckets {
    /// The cheapest partition between two buckets along one axis, if there is any: binned SAH, after
    /// Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007, section 3.
    ///
    /// Of C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect only S_A · N_A + S_B · N_B
    /// differs between the partitions of one node.
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

        // From the right: one child.
        right_costs.resize(slices.count, 0.0);
        let mut right = Bucket::EMPTY;
        for i in (1..slices.count).rev() {
            right.join(buckets[i]);
            right_costs[i] = right.cost();
        }

        // From the left: the other. The outermost buckets are never empty, so neither is a side.
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

    // starter: #[ignore = "task 3: not written yet"]
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

    // starter: #[ignore = "task 3: not written yet"]
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

    // starter: #[ignore = "task 3: not written yet"]
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
