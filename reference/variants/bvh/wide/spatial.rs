// Builds the tree for traversal, in which triangles may be split.

/// A builder of the tree for traversal. A node whose two sides would have overlapping boxes is
/// split by a plane instead, if that is cheaper. A triangle that crosses the plane then has a piece
/// on each side. See Stich, Friedrich and Dietrich, "Spatial Splits in Bounding Volume
/// Hierarchies", 2009.
struct SpatialBuilder<'a> {
    primitives: &'a [Primitive],
    nodes: Vec<Node>,
    /// The indices of the primitives that the leaves refer to. A primitive that is split occurs
    /// several times.
    order: Vec<usize>,
    /// The number of additional pieces that spatial splits may still create.
    pieces_left: usize,
    /// The minimum overlap for a spatial split: half the surface area of the overlap must be larger
    /// than this.
    tolerated_overlap: f32,
}

/// The plane and the cost of a spatial split.
struct SpatialSplit {
    axis: usize,
    plane: f32,
    cost: f32,
}

impl<'a> SpatialBuilder<'a> {
    /// The minimum number of items for a spatial split. In smaller nodes, spatial splits would take
    /// most of the build time and save nothing.
    const MIN_ITEMS: usize = 256;
    /// The number of slices along each axis.
    const SLICES: usize = 32;

    fn new(primitives: &'a [Primitive]) -> Self {
        SpatialBuilder {
            primitives,
            nodes: Vec::with_capacity(primitives.len()),
            order: Vec::with_capacity(primitives.len()),
            pieces_left: primitives.len(),
            tolerated_overlap: 1e-4 * Bounds::of(&items(primitives)).area(),
        }
    }

    /// Builds the subtree over these items, which must not be empty, and returns its index.
    fn node(&mut self, mut items: Vec<Item>) -> usize {
        let bounds = Bounds::of(&items);
        let index = self.nodes.len();
        let leaf = Node::leaf(bounds.bbox(), self.order.len(), items.len());
        self.nodes.push(leaf);
        if fits_in_pack(self.primitives, items.iter().map(|item| item.index)) {
            self.order.extend(items.iter().map(|item| item.index));
            return index;
        }

        let centers = Bounds::of_centers(&items);
        let middle = partition(&mut items, centers);
        let halves = self.cheaper_halves(&items, middle, bounds);
        let (l, r) = halves.unwrap_or_else(|| {
            let r = items.split_off(middle);
            (items, r)
        });
        let l = self.node(l);
        let r = self.node(r);
        self.nodes[index] = Node::interior(bounds.bbox(), l, r);
        index
    }

    /// Returns the two sides of the cheapest spatial split, if it is cheaper than splitting `items`
    /// at `middle`.
    fn cheaper_halves(
        &mut self,
        items: &[Item],
        middle: usize,
        bounds: Bounds,
    ) -> Option<(Vec<Item>, Vec<Item>)> {
        if items.len() < SpatialBuilder::MIN_ITEMS {
            return None;
        }
        let (l, r) = items.split_at(middle);
        let (l_bounds, r_bounds) = (Bounds::of(l), Bounds::of(r));
        if l_bounds.overlap(r_bounds).area() <= self.tolerated_overlap {
            return None;
        }
        let cost = l_bounds.area() * l.len() as f32 + r_bounds.area() * r.len() as f32;
        let split = self.cheapest_spatial_split(items, bounds)?;
        if split.cost >= cost {
            return None;
        }

        let (mut l, mut r) = (Vec::new(), Vec::new());
        for item in items {
            if item.bounds.upper.to_array()[split.axis] <= split.plane {
                l.push(*item);
            } else if item.bounds.lower.to_array()[split.axis] >= split.plane {
                r.push(*item);
            } else {
                let index = item.index;
                let [below, above] = self.pieces(item, split.axis, split.plane);
                l.extend(below.map(|bounds| Item { bounds, index }));
                r.extend(above.map(|bounds| Item { bounds, index }));
            }
        }
        let added = (l.len() + r.len()).saturating_sub(items.len());
        if l.len().max(r.len()) >= items.len() || added > self.pieces_left {
            return None;
        }
        self.pieces_left -= added;
        Some((l, r))
    }

    /// Returns the cheapest spatial split over all axes. The candidates are the planes between
    /// slices of equal width.
    fn cheapest_spatial_split(&self, items: &[Item], bounds: Bounds) -> Option<SpatialSplit> {
        let lower = bounds.lower.to_array();
        let width = ((bounds.upper - bounds.lower)
            * f32x4::splat(1.0 / SpatialBuilder::SLICES as f32))
        .to_array();
        let scale = f32x4::from(width.map(|width| if width > 0.0 { 1.0 / width } else { 0.0 }));
        let plane = |axis: usize, slice: usize| lower[axis] + width[axis] * slice as f32;
        let slices = |corner: f32x4| {
            let slices = ((corner - bounds.lower) * scale)
                .fast_trunc_int()
                .to_array();
            slices.map(|slice| (slice as usize).min(SpatialBuilder::SLICES - 1))
        };

        let mut buckets = [[Bucket::empty(); SpatialBuilder::SLICES]; 3];
        for item in items {
            let (first, last) = (slices(item.bounds.lower), slices(item.bounds.upper));
            for (axis, buckets) in buckets.iter_mut().enumerate() {
                let (first, last) = (first[axis], last[axis].max(first[axis]));
                buckets[first].begin += 1;
                buckets[last].end += 1;
                let mut rest = Some(*item);
                for (slice, bucket) in buckets[..last].iter_mut().enumerate().skip(first) {
                    let Some(item) = rest else { break };
                    let [below, above] = self.pieces(&item, axis, plane(axis, slice + 1));
                    below.iter().for_each(|below| bucket.bounds.join(*below));
                    rest = above.map(|bounds| Item { bounds, ..item });
                }
                rest.iter()
                    .for_each(|rest| buckets[last].bounds.join(rest.bounds));
            }
        }

        let axes = (0..3).filter(|&axis| plane(axis, 1) > lower[axis]);
        let splits = axes.map(|axis| {
            let (slice, cost) = cheapest_split(&buckets[axis]);
            let plane = plane(axis, slice);
            SpatialSplit { axis, plane, cost }
        });
        splits.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// Returns the boxes around an item's parts below and above a plane, or `None` for an empty
    /// part.
    fn pieces(&self, item: &Item, axis: usize, plane: f32) -> [Option<Bounds>; 2] {
        let (mut upper, mut lower) = (item.bounds.upper.to_array(), item.bounds.lower.to_array());
        upper[axis] = upper[axis].min(plane);
        lower[axis] = lower[axis].max(plane);
        let below = Bounds {
            upper: f32x4::from(upper),
            ..item.bounds
        };
        let above = Bounds {
            lower: f32x4::from(lower),
            ..item.bounds
        };
        let Primitive::Triangle(Triangle { p0, p1, p2, .. }) = &self.primitives[item.index] else {
            return [Some(below), Some(above)];
        };

        let [p0, p1, p2] = [p0.position, p1.position, p2.position];
        let (mut low, mut high) = (Bounds::empty(), Bounds::empty());
        for (a, b) in [(p0, p1), (p1, p2), (p2, p0)] {
            if a[axis] <= plane {
                low.join(Bounds::point(a));
            }
            if a[axis] >= plane {
                high.join(Bounds::point(a));
            }
            if (a[axis] < plane && plane < b[axis]) || (b[axis] < plane && plane < a[axis]) {
                let at = a + (b - a) * ((plane - a[axis]) / (b[axis] - a[axis]));
                // Enlarges the box so that it contains the exact point despite rounding.
                let slack = 4e-7 * a.abs().max(b.abs());
                for at in [at - slack, at + slack] {
                    low.join(Bounds::point(at));
                    high.join(Bounds::point(at));
                }
            }
        }
        [below.overlap(low), above.overlap(high)].map(|piece| (!piece.is_empty()).then_some(piece))
    }
}
