// Builds the binary tree with the surface area heuristic.

/// A box in two registers.
#[derive(Clone, Copy)]
struct Bounds {
    lower: f32x4,
    upper: f32x4,
}

impl Bounds {
    fn empty() -> Self {
        Bounds {
            lower: f32x4::splat(f32::INFINITY),
            upper: f32x4::splat(f32::NEG_INFINITY),
        }
    }

    fn join(&mut self, other: Bounds) {
        self.lower = self.lower.fast_min(other.lower);
        self.upper = self.upper.fast_max(other.upper);
    }

    /// Returns the intersection of the two boxes.
    fn overlap(self, other: Bounds) -> Bounds {
        Bounds {
            lower: self.lower.fast_max(other.lower),
            upper: self.upper.fast_min(other.upper),
        }
    }

    fn point(point: Vec3) -> Bounds {
        let point = f32x4::from(point.extend(0.0).to_array());
        Bounds {
            lower: point,
            upper: point,
        }
    }

    fn of(items: &[Item]) -> Bounds {
        let mut bounds = Bounds::empty();
        items.iter().for_each(|item| bounds.join(item.bounds));
        bounds
    }

    /// Returns the box around the items' centres, with all coordinates doubled.
    fn of_centers(items: &[Item]) -> Bounds {
        let mut centers = Bounds::empty();
        for item in items {
            let center = item.center();
            centers.join(Bounds {
                lower: center,
                upper: center,
            });
        }
        centers
    }

    fn is_empty(self) -> bool {
        let [x, y, z, _] = (self.upper - self.lower).to_array();
        x < 0.0 || y < 0.0 || z < 0.0
    }

    /// Returns half of the surface area.
    fn area(self) -> f32 {
        if self.is_empty() {
            return 0.0;
        }
        let [x, y, z, _] = (self.upper - self.lower).to_array();
        x * y + y * z + z * x
    }

    fn bbox(self) -> BBox {
        let corner = |lanes: f32x4| Vec3::from_slice(&lanes.to_array()[..3]);
        BBox::new(corner(self.lower), corner(self.upper))
    }
}

/// The bounds of a primitive, or of a piece of a primitive, used during the build.
#[derive(Clone, Copy)]
struct Item {
    bounds: Bounds,
    index: usize,
}

fn items(primitives: &[Primitive]) -> Vec<Item> {
    (0..).zip(primitives).map(Item::new).collect()
}

impl Item {
    fn new((index, primitive): (usize, &Primitive)) -> Self {
        let BBox { min, max } = primitive.bbox();
        let bounds = Bounds {
            lower: f32x4::from(min.extend(0.0).to_array()),
            upper: f32x4::from(max.extend(0.0).to_array()),
        };
        Item { bounds, index }
    }

    /// Returns the centre, with all coordinates doubled.
    fn center(&self) -> f32x4 {
        self.bounds.lower + self.bounds.upper
    }
}

/// The contents of one slice. In object splits, an item begins and ends in the slice that contains
/// its centre.
#[derive(Clone, Copy)]
struct Bucket {
    bounds: Bounds,
    /// The number of items that begin in the slice.
    begin: usize,
    /// The number of items that end in the slice.
    end: usize,
}

impl Bucket {
    fn empty() -> Self {
        Bucket {
            bounds: Bounds::empty(),
            begin: 0,
            end: 0,
        }
    }

    fn join(&mut self, other: Bucket) {
        self.bounds.join(other.bounds);
        self.begin += other.begin;
        self.end += other.end;
    }
}

/// A builder of binary trees that uses binned SAH over all three axes at once.
struct Builder {
    items: Vec<Item>,
    nodes: Vec<Node>,
    max_leaf_size: usize,
}

impl Builder {
    /// Builds the subtree over `items[start..end]`, which must not be empty, and returns its index.
    fn node(&mut self, start: usize, end: usize) -> usize {
        let items = &mut self.items[start..end];
        let bounds = Bounds::of(items);
        let index = self.nodes.len();
        self.nodes
            .push(Node::leaf(bounds.bbox(), start, end - start));
        if end - start > self.max_leaf_size {
            let centers = Bounds::of_centers(items);
            let middle = start + partition(items, centers);
            let l = self.node(start, middle);
            let r = self.node(middle, end);
            self.nodes[index] = Node::interior(bounds.bbox(), l, r);
        }
        index
    }
}

/// Partitions the items in place by the cheapest split and returns the size of the left side.
/// Larger nodes are divided into more slices. In these nodes, evaluating the splits takes little
/// time compared with counting the items, and the choice of split matters most.
fn partition(items: &mut [Item], centers: Bounds) -> usize {
    match items.len() {
        0..512 => partition_in::<16>(items, centers),
        512..2048 => partition_in::<32>(items, centers),
        2048.. => partition_in::<64>(items, centers),
    }
}

/// Partitions the items, dividing the box of the centres into `SLICES` slices along each axis.
fn partition_in<const SLICES: usize>(items: &mut [Item], centers: Bounds) -> usize {
    let extent = (centers.upper - centers.lower).to_array();
    // Along an axis with little or no extent, all items are in the first slice.
    let scale = extent.map(|extent| SLICES as f32 / extent);
    let scale = f32x4::from(scale.map(|scale| if scale.is_finite() { scale } else { 0.0 }));
    let slices = |item: &Item| {
        let slices = (item.center() - centers.lower) * scale;
        let slices = slices.fast_trunc_int().to_array();
        slices.map(|slice| (slice as usize).min(SLICES - 1))
    };

    let mut buckets = [[Bucket::empty(); SLICES]; 3];
    for item in &*items {
        let slices = slices(item);
        for axis in 0..3 {
            let bucket = &mut buckets[axis][slices[axis]];
            bucket.bounds.join(item.bounds);
            bucket.begin += 1;
            bucket.end += 1;
        }
    }
    let splits = (0..3).filter(|&axis| scale.to_array()[axis] > 0.0);
    let splits = splits.map(|axis| (axis, cheapest_split(&buckets[axis])));
    let Some((axis, (slice, _))) = splits.min_by(|(_, a), (_, b)| a.1.total_cmp(&b.1)) else {
        return items.len() / 2; // All centres coincide.
    };

    let mut first = 0;
    for i in 0..items.len() {
        if slices(&items[i])[axis] < slice {
            items.swap(first, i);
            first += 1;
        }
    }
    first
}

/// Returns the slice before which to split, and the cost of that split.
fn cheapest_split<const SLICES: usize>(buckets: &[Bucket; SLICES]) -> (usize, f32) {
    let mut right_costs = [0.0; SLICES];
    let mut right = Bucket::empty();
    for i in (1..SLICES).rev() {
        right.join(buckets[i]);
        right_costs[i] = right.bounds.area() * right.end as f32;
    }
    let mut left = Bucket::empty();
    let mut best = (1, f32::INFINITY);
    for slice in 1..SLICES {
        left.join(buckets[slice - 1]);
        let cost = left.bounds.area() * left.begin as f32 + right_costs[slice];
        if cost < best.1 {
            best = (slice, cost);
        }
    }
    best
}
