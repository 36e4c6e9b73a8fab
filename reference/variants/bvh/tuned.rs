// The reference's algorithms, tuned for speed.
//
// - Building a tree computes boxes with SIMD, and reuses its vectors for all nodes.
// - Small nodes have 8 buckets along each axis and large ones up to 64. Most nodes are small, and
//   there the buckets cost more than the primitives; in large nodes more buckets cost almost
//   nothing, and their splits matter most for traversal.
// - The two children of a node are next to each other in memory.
// - Traversal computes the inverse of the ray's direction once, and tests boxes with it.

use glam::{Vec3, Vec3A};
use protocol::Interval;

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
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
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        let mut search = Search::new(self, ray);
        search.entry(root)?;
        search.traverse(root);
        search.closest
    }
}

/// The state of one ray's traversal.
struct Search<'a> {
    bvh: &'a Bvh,
    origin: Vec3A,
    inverse_dir: Vec3A,
    /// The ray, whose range ends at the closest hit so far.
    ray: Ray,
    closest: Option<Trace>,
}

impl<'a> Search<'a> {
    fn new(bvh: &'a Bvh, ray: &Ray) -> Self {
        Search {
            bvh,
            origin: in_register(ray.origin),
            inverse_dir: in_register(ray.dir).recip(),
            ray: *ray,
            closest: None,
        }
    }

    /// Returns the distance at which the ray enters the node's box, as [`BBox::hit`] does.
    fn entry(&self, node: &Node) -> Option<f32> {
        let at_min = (in_register(node.bbox.min) - self.origin) * self.inverse_dir;
        let at_max = (in_register(node.bbox.max) - self.origin) * self.inverse_dir;
        let enter = at_min.min(at_max).max_element();
        let leave = at_min.max(at_max).min_element();
        // `f32::max` and `f32::min` would take three instructions each, because they handle NaN.
        let Interval { min, max } = self.ray.range;
        let enter = if enter > min { enter } else { min };
        let leave = if leave < max { leave } else { max };
        (enter <= leave).then_some(enter)
    }

    /// Finds the closest hit below `node`, whose box the ray is known to hit.
    fn traverse(&mut self, node: &Node) {
        if node.is_leaf() {
            for primitive in &self.bvh.primitives[node.start..node.start + node.size] {
                if let Some(trace) = primitive.hit(&self.ray) {
                    self.ray.range.max = trace.distance;
                    self.closest = Some(trace);
                }
            }
            return;
        }

        let (l, r) = (&self.bvh.nodes[node.l], &self.bvh.nodes[node.r]);
        match (self.entry(l), self.entry(r)) {
            (None, None) => {}
            (Some(_), None) => self.traverse(l),
            (None, Some(_)) => self.traverse(r),
            (Some(in_l), Some(in_r)) if in_l <= in_r => self.traverse_both(l, r, in_r),
            (Some(in_l), Some(_)) => self.traverse_both(r, l, in_l),
        }
    }

    /// Finds the closest hit below two nodes whose boxes the ray hits. Skips the second node if its
    /// box begins beyond the closest hit.
    ///
    /// Two call sites instead of a swap: the branch predictor can guess which child is nearer,
    /// while a swap would stall until both boxes are loaded.
    fn traverse_both(&mut self, first: &Node, second: &Node, second_begins: f32) {
        self.traverse(first);
        if second_begins <= self.ray.range.max {
            self.traverse(second);
        }
    }
}

/// Returns a vector in a SIMD register. The fourth lane is ignored: setting it to 0 is cheaper than
/// repeating z, as `to_vec3a` does.
fn in_register(v: Vec3) -> Vec3A {
    Vec3A::from_vec4(v.extend(0.0))
}

/// A box with each corner in one SIMD register. Building spends most of its time joining boxes.
#[derive(Clone, Copy)]
struct Bounds {
    min: Vec3A,
    max: Vec3A,
}

impl Bounds {
    const EMPTY: Bounds = Bounds {
        min: Vec3A::INFINITY,
        max: Vec3A::NEG_INFINITY,
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

    fn enclose_point(&mut self, point: Vec3A) {
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
    center: Vec3A,
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
