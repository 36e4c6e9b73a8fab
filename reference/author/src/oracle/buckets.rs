//! What a bucketed builder's tree costs: of many ways to place the buckets, all of them honest, and
//! of one way to misread what is in them.

use crate::oracle::bbox::Bounds;

/// What the buckets divide evenly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The box around the primitives' centers.
    Centers,
    /// The node's own box.
    Bounds,
}

/// What is taken for the two sides of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sides {
    /// All buckets to the left of it, and all to the right.
    Whole,
    /// The last bucket before it, and the first behind: wrong, and often seen.
    BesideThePlane,
}

/// How a builder goes about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Buckets {
    /// How many along each axis.
    count: usize,
    extent: Extent,
    sides: Sides,
}

impl Buckets {
    /// Both sides of a plane are weighed.
    pub fn honest(count: usize, extent: Extent) -> Self {
        let sides = Sides::Whole;
        Buckets {
            count,
            extent,
            sides,
        }
    }

    /// The two buckets beside a plane are taken for its sides.
    pub fn confused(count: usize, extent: Extent) -> Self {
        let sides = Sides::BesideThePlane;
        Buckets {
            count,
            extent,
            sides,
        }
    }
}

/// The cost of the tree that these buckets lead to: C_trav = C_isect = 1, areas by the root's. Wald,
/// "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007, section 3.
pub fn cost(boxes: &[Bounds], max_leaf_size: usize, buckets: Buckets) -> f64 {
    let mut boxes = boxes.to_vec();
    let root = around(&boxes).area();
    below(&mut boxes, max_leaf_size, buckets) / root
}

fn around(boxes: &[Bounds]) -> Bounds {
    boxes
        .iter()
        .fold(NOTHING.bounds, |all, next| all.union(next))
}

/// What a node costs, with all that is below it.
fn below(boxes: &mut [Bounds], max_leaf_size: usize, buckets: Buckets) -> f64 {
    let bounds = around(boxes);
    if boxes.len() <= max_leaf_size {
        return bounds.area() * boxes.len() as f64;
    }
    let over = match buckets.extent {
        Extent::Centers => Bounds::around(boxes.iter().map(Bounds::center)),
        Extent::Bounds => bounds,
    };
    let first = match cheapest(boxes, &over, buckets) {
        Some((axis, plane)) => {
            let count = buckets.count;
            let bucket = Bucketing { over, axis, count };
            boxes.sort_by_key(|bounds| bucket.of(bounds) >= plane);
            boxes.partition_point(|bounds| bucket.of(bounds) < plane)
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
    let [left, right] = [left, right].map(|side| below(side, max_leaf_size, buckets));
    bounds.area() + left + right
}

/// Even slices of a box along one axis.
struct Bucketing {
    over: Bounds,
    axis: usize,
    count: usize,
}

impl Bucketing {
    fn of(&self, bounds: &Bounds) -> usize {
        let size = self.over.max[self.axis] - self.over.min[self.axis];
        let part = (bounds.center()[self.axis] - self.over.min[self.axis]) / size;
        ((part * self.count as f64) as usize).min(self.count - 1)
    }
}

/// What lies in one or more buckets.
#[derive(Clone, Copy)]
struct Heap {
    bounds: Bounds,
    count: usize,
}

const NOTHING: Heap = Heap {
    bounds: Bounds {
        min: glam::DVec3::INFINITY,
        max: glam::DVec3::NEG_INFINITY,
    },
    count: 0,
};

impl Heap {
    fn with(self, other: Heap) -> Heap {
        Heap {
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
fn cheapest(boxes: &[Bounds], over: &Bounds, buckets: Buckets) -> Option<(usize, usize)> {
    let Buckets { count, sides, .. } = buckets;
    let mut best: Option<(f64, (usize, usize))> = None;
    for axis in (0..3).filter(|&axis| over.max[axis] > over.min[axis]) {
        let bucket = Bucketing {
            over: *over,
            axis,
            count,
        };
        let mut heaps = vec![NOTHING; count];
        for &bounds in boxes {
            let heap = &mut heaps[bucket.of(&bounds)];
            *heap = heap.with(Heap { bounds, count: 1 });
        }
        let sums = |heaps: &mut dyn Iterator<Item = &Heap>| -> Vec<Heap> {
            let sum = |all: &mut Heap, heap: &Heap| {
                *all = all.with(*heap);
                Some(*all)
            };
            heaps.scan(NOTHING, sum).collect()
        };
        let (lefts, rights) = (sums(&mut heaps.iter()), sums(&mut heaps.iter().rev()));
        for plane in 1..count {
            let (left, right) = (lefts[plane - 1], rights[count - plane - 1]);
            let cost = match sides {
                Sides::Whole => left.cost() + right.cost(),
                Sides::BesideThePlane => heaps[plane - 1].cost() + heaps[plane].cost(),
            };
            let is_split = left.count > 0 && right.count > 0;
            if is_split && best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, (axis, plane)));
            }
        }
    }
    best.map(|(_, place)| place)
}
