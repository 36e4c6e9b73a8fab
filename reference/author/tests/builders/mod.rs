//! Builders with mistakes that people make.

use author::oracle::bbox::Bounds;
use author::oracle::scan;
use protocol::Shape;

/// The rule by which a builder splits a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Splitter {
    /// SAH with buckets, along one axis only.
    OneAxis(usize),
    /// A split in the middle of the longest axis of the centres.
    Middle,
    /// A split with half of the primitives on each side, along the longest axis.
    Median,
    /// SAH with the areas of single buckets, instead of all buckets of a side.
    AreaPerBucket,
    /// The partition with the highest cost.
    Worst,
}

/// Returns the cost of the tree over these shapes, with C_trav = C_isect = 1 and areas relative to
/// the root's.
pub fn cost(shapes: &[Shape], max_leaf_size: usize, splitter: Splitter) -> f64 {
    let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
    let root = enclosing(&boxes).area();
    subtree_cost(boxes, max_leaf_size, splitter) / root
}

fn enclosing(boxes: &[Bounds]) -> Bounds {
    let nothing = Bounds::around([]);
    boxes.iter().fold(nothing, |all, next| all.union(next))
}

fn subtree_cost(mut boxes: Vec<Bounds>, max_leaf_size: usize, splitter: Splitter) -> f64 {
    let area = enclosing(&boxes).area();
    if boxes.len() <= max_leaf_size {
        return area * boxes.len() as f64;
    }
    let right = split(&mut boxes, splitter);
    area + subtree_cost(boxes, max_leaf_size, splitter)
        + subtree_cost(right, max_leaf_size, splitter)
}

fn split(boxes: &mut Vec<Bounds>, splitter: Splitter) -> Vec<Bounds> {
    let centers = Bounds::around(boxes.iter().map(Bounds::center));
    let size = centers.max - centers.min;
    let longest = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap();
    let is_left: Box<dyn Fn(&Bounds) -> bool> = match splitter {
        Splitter::OneAxis(axis) => bucketed_split(boxes, axis..axis + 1, splitter),
        Splitter::AreaPerBucket | Splitter::Worst => bucketed_split(boxes, 0..3, splitter),
        Splitter::Middle => {
            let middle = centers.center()[longest];
            Box::new(move |bounds| bounds.center()[longest] < middle)
        }
        Splitter::Median => Box::new(|_| true),
    };
    let (left, right): (Vec<Bounds>, Vec<Bounds>) = boxes.iter().partition(|b| is_left(b));
    if left.is_empty() || right.is_empty() {
        boxes.sort_by(|a, b| a.center()[longest].total_cmp(&b.center()[longest]));
        return boxes.split_off(boxes.len() / 2);
    }
    *boxes = left;
    right
}

fn bucketed_split(
    boxes: &[Bounds],
    axes: std::ops::Range<usize>,
    splitter: Splitter,
) -> Box<dyn Fn(&Bounds) -> bool> {
    let count = 16;
    let over = Bounds::around(boxes.iter().map(Bounds::center));
    let bucket = move |bounds: &Bounds, axis: usize| {
        let size = over.max[axis] - over.min[axis];
        let part = (bounds.center()[axis] - over.min[axis]) / size;
        ((part * count as f64) as usize).min(count - 1)
    };
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in axes.filter(|&axis| over.max[axis] > over.min[axis]) {
        let mut buckets = vec![Vec::new(); count];
        for bounds in boxes {
            buckets[bucket(bounds, axis)].push(*bounds);
        }
        for plane in 1..count {
            let (left, right) = (buckets[..plane].concat(), buckets[plane..].concat());
            if left.is_empty() || right.is_empty() {
                continue;
            }
            let side = |side: &[Bounds], own: &[Bounds]| {
                let measured = match splitter {
                    Splitter::AreaPerBucket => own,
                    Splitter::OneAxis(_)
                    | Splitter::Middle
                    | Splitter::Median
                    | Splitter::Worst => side,
                };
                let area = if measured.is_empty() {
                    0.0
                } else {
                    enclosing(measured).area()
                };
                area * side.len() as f64
            };
            let cost = side(&left, &buckets[plane - 1]) + side(&right, &buckets[plane]);
            let cost = if splitter == Splitter::Worst {
                -cost
            } else {
                cost
            };
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, plane));
            }
        }
    }
    match best {
        Some((_, axis, plane)) => Box::new(move |bounds| bucket(bounds, axis) < plane),
        None => Box::new(|_| true),
    }
}
