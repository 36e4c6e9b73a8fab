//! The cost of trees built with bucketed SAH, by correct builders with various kinds of buckets and
//! by builders with a known mistake.

use crate::oracle::bbox::Bounds;

/// The box that is divided evenly into buckets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BucketExtent {
    /// The box around the centres of the primitives.
    Centers,
    /// The box of the node.
    Bounds,
}

/// The buckets that make up the two sides of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SideRule {
    /// All buckets to the left of the plane, and all buckets to its right.
    AllBuckets,
    /// Only the last bucket before the plane and the first one after it: a common mistake.
    AdjacentBuckets,
}

/// A builder that chooses splits by bucketed SAH.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BucketedBuilder {
    /// The number of buckets along each axis.
    pub count: usize,
    /// The box that is divided into buckets.
    pub extent: BucketExtent,
    /// The buckets on either side of a plane.
    pub sides: SideRule,
}

/// Returns the cost of this builder's tree, with C_trav = C_isect = 1 and areas relative to the
/// root's area. The builder follows Wald, "On fast Construction of SAH-based Bounding Volume
/// Hierarchies", 2007, section 3.
pub fn cost(boxes: &[Bounds], max_leaf_size: usize, builder: BucketedBuilder) -> f64 {
    cost_with_halves(boxes, max_leaf_size, builder, &|_| false)
}

/// Like [`cost`], but for a builder that halves some nodes by primitive count along the longest
/// axis. `is_halved` selects these nodes by their number of primitives.
pub fn cost_with_halves(
    boxes: &[Bounds],
    max_leaf_size: usize,
    builder: BucketedBuilder,
    is_halved: &dyn Fn(usize) -> bool,
) -> f64 {
    let mut boxes = boxes.to_vec();
    let root = Bounds::enclosing(boxes.iter().copied()).area();
    subtree_cost(&mut boxes, max_leaf_size, builder, is_halved) / root
}

/// Returns the cost of the subtree over these boxes.
fn subtree_cost(
    boxes: &mut [Bounds],
    max_leaf_size: usize,
    builder: BucketedBuilder,
    is_halved: &dyn Fn(usize) -> bool,
) -> f64 {
    let bounds = Bounds::enclosing(boxes.iter().copied());
    if boxes.len() <= max_leaf_size {
        return bounds.area() * boxes.len() as f64;
    }
    let over = match builder.extent {
        BucketExtent::Centers => Bounds::around(boxes.iter().map(Bounds::center)),
        BucketExtent::Bounds => bounds,
    };
    let split = if is_halved(boxes.len()) {
        None
    } else {
        cheapest_split(boxes, &over, builder)
    };
    let first = match split {
        Some((axis, plane)) => {
            let is_left = |bounds: &Bounds| builder.bucket_of(bounds, &over, axis) < plane;
            boxes.sort_by_key(|bounds| !is_left(bounds));
            boxes.partition_point(is_left)
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
    let below = |side| subtree_cost(side, max_leaf_size, builder, is_halved);
    let [left, right] = [left, right].map(below);
    bounds.area() + left + right
}

impl BucketedBuilder {
    /// Returns the index of the bucket that contains a primitive's centre along an axis of the box
    /// `over`.
    fn bucket_of(self, bounds: &Bounds, over: &Bounds, axis: usize) -> usize {
        let size = over.max[axis] - over.min[axis];
        let part = (bounds.center()[axis] - over.min[axis]) / size;
        ((part * self.count as f64) as usize).min(self.count - 1)
    }
}

/// The contents of one or more buckets.
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

    /// Returns the area times the count, or 0 if there are no primitives, because the area of an
    /// empty box is undefined.
    fn cost(self) -> f64 {
        match self.count {
            0 => 0.0,
            count => self.bounds.area() * count as f64,
        }
    }
}

/// Returns the axis of the cheapest split and the number of buckets on its left side, or `None` if
/// no plane separates the boxes.
fn cheapest_split(
    boxes: &[Bounds],
    over: &Bounds,
    builder: BucketedBuilder,
) -> Option<(usize, usize)> {
    let BucketedBuilder { count, sides, .. } = builder;
    let mut best: Option<(f64, (usize, usize))> = None;
    for axis in (0..3).filter(|&axis| over.max[axis] > over.min[axis]) {
        let mut buckets = vec![EMPTY; count];
        for &bounds in boxes {
            let bucket = &mut buckets[builder.bucket_of(&bounds, over, axis)];
            *bucket = bucket.union(BucketContents { bounds, count: 1 });
        }
        let sums = |buckets: &mut dyn Iterator<Item = &BucketContents>| -> Vec<BucketContents> {
            let sum = |all: &mut BucketContents, bucket: &BucketContents| {
                *all = all.union(*bucket);
                Some(*all)
            };
            buckets.scan(EMPTY, sum).collect()
        };
        let (lefts, rights) = (sums(&mut buckets.iter()), sums(&mut buckets.iter().rev()));
        for plane in 1..count {
            let (left, right) = (lefts[plane - 1], rights[count - plane - 1]);
            let cost = match sides {
                SideRule::AllBuckets => left.cost() + right.cost(),
                SideRule::AdjacentBuckets => buckets[plane - 1].cost() + buckets[plane].cost(),
            };
            let is_split = left.count > 0 && right.count > 0;
            if is_split && best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, (axis, plane)));
            }
        }
    }
    best.map(|(_, split)| split)
}
