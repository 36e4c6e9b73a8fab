//! What a bucketed builder's tree costs: of many ways to place the buckets, all of them honest, and
//! of one way to misread what is in them.

use crate::oracle::bbox::Bounds;

/// What the buckets divide evenly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BucketExtent {
    /// The box around the primitives' centers.
    Centers,
    /// The node's own box.
    Bounds,
}

/// What is taken for the two sides of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SideRule {
    /// All buckets to the left of it, and all to the right.
    AllBuckets,
    /// The last bucket before it, and the first behind: wrong, and often seen.
    AdjacentBuckets,
}

/// How a builder goes about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BucketedBuilder {
    /// How many along each axis.
    count: usize,
    extent: BucketExtent,
    sides: SideRule,
}

impl BucketedBuilder {
    /// Both sides of a plane are weighed.
    pub fn correct(count: usize, extent: BucketExtent) -> Self {
        let sides = SideRule::AllBuckets;
        BucketedBuilder {
            count,
            extent,
            sides,
        }
    }

    /// The two buckets beside a plane are taken for its sides.
    pub fn with_adjacent_buckets_only(count: usize, extent: BucketExtent) -> Self {
        let sides = SideRule::AdjacentBuckets;
        BucketedBuilder {
            count,
            extent,
            sides,
        }
    }
}

/// The cost of the tree that these buckets lead to: C_trav = C_isect = 1, areas by the root's. Wald,
/// "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007, section 3.
pub fn cost(boxes: &[Bounds], max_leaf_size: usize, buckets: BucketedBuilder) -> f64 {
    let mut boxes = boxes.to_vec();
    let root = bounds_of(&boxes).area();
    subtree_cost(&mut boxes, max_leaf_size, buckets) / root
}

fn bounds_of(boxes: &[Bounds]) -> Bounds {
    boxes.iter().fold(EMPTY.bounds, |all, next| all.union(next))
}

/// What a node costs, with all that is below it.
fn subtree_cost(boxes: &mut [Bounds], max_leaf_size: usize, buckets: BucketedBuilder) -> f64 {
    let bounds = bounds_of(boxes);
    if boxes.len() <= max_leaf_size {
        return bounds.area() * boxes.len() as f64;
    }
    let over = match buckets.extent {
        BucketExtent::Centers => Bounds::around(boxes.iter().map(Bounds::center)),
        BucketExtent::Bounds => bounds,
    };
    let first = match cheapest_split(boxes, &over, buckets) {
        Some((axis, plane)) => {
            let count = buckets.count;
            let bucket = AxisSlices { over, axis, count };
            boxes.sort_by_key(|bounds| bucket.index_of(bounds) >= plane);
            boxes.partition_point(|bounds| bucket.index_of(bounds) < plane)
        }
        None => {
            let size = over.max - over.min;
            let longest = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b]));
            let axis = longest.expect("there are three axes");
            boxes.sort_by(|a, b| a.center()[axis].total_cmp(&b.center()[axis]));
            boxes.len() / 2
        }
    };
    let (left, right) = boxes.split_at_mut(first);
    let [left, right] = [left, right].map(|side| subtree_cost(side, max_leaf_size, buckets));
    bounds.area() + left + right
}

/// Even slices of a box along one axis.
struct AxisSlices {
    over: Bounds,
    axis: usize,
    count: usize,
}

impl AxisSlices {
    fn index_of(&self, bounds: &Bounds) -> usize {
        let size = self.over.max[self.axis] - self.over.min[self.axis];
        let part = (bounds.center()[self.axis] - self.over.min[self.axis]) / size;
        ((part * self.count as f64) as usize).min(self.count - 1)
    }
}

/// What lies in one or more buckets.
#[derive(Clone, Copy)]
struct BucketContents {
    bounds: Bounds,
    count: usize,
}

const EMPTY: BucketContents = BucketContents {
    bounds: Bounds {
        min: glam::DVec3::INFINITY,
        max: glam::DVec3::NEG_INFINITY,
    },
    count: 0,
};

impl BucketContents {
    fn union(self, other: BucketContents) -> BucketContents {
        BucketContents {
            bounds: self.bounds.union(&other.bounds),
            count: self.count + other.count,
        }
    }

    /// None at all if it is empty, whatever the area of no box may be.
    fn cost(self) -> f64 {
        match self.count {
            0 => 0.0,
            count => self.bounds.area() * count as f64,
        }
    }
}

/// The axis, and how many buckets go to the first side; none if no plane separates anything.
fn cheapest_split(
    boxes: &[Bounds],
    over: &Bounds,
    buckets: BucketedBuilder,
) -> Option<(usize, usize)> {
    let BucketedBuilder { count, sides, .. } = buckets;
    let mut best: Option<(f64, (usize, usize))> = None;
    for axis in (0..3).filter(|&axis| over.max[axis] > over.min[axis]) {
        let bucket = AxisSlices {
            over: *over,
            axis,
            count,
        };
        let mut heaps = vec![EMPTY; count];
        for &bounds in boxes {
            let heap = &mut heaps[bucket.index_of(&bounds)];
            *heap = heap.union(BucketContents { bounds, count: 1 });
        }
        let sums = |heaps: &mut dyn Iterator<Item = &BucketContents>| -> Vec<BucketContents> {
            let sum = |all: &mut BucketContents, heap: &BucketContents| {
                *all = all.union(*heap);
                Some(*all)
            };
            heaps.scan(EMPTY, sum).collect()
        };
        let (lefts, rights) = (sums(&mut heaps.iter()), sums(&mut heaps.iter().rev()));
        for plane in 1..count {
            let (left, right) = (lefts[plane - 1], rights[count - plane - 1]);
            let cost = match sides {
                SideRule::AllBuckets => left.cost() + right.cost(),
                SideRule::AdjacentBuckets => heaps[plane - 1].cost() + heaps[plane].cost(),
            };
            let is_split = left.count > 0 && right.count > 0;
            if is_split && best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, (axis, plane)));
            }
        }
    }
    best.map(|(_, place)| place)
}
