//! The item about a single split: primitives in a row, for which one partition is by far the best. Both
//! of its sides fit in a leaf, but all primitives together do not.

use glam::DVec3;
use judging::exam::ExamQuestion;
use protocol::Shape;

use super::cost::cost_question;
use super::draw::place_of_size;
use crate::domains::fields;
use crate::items::{Declaration, meshes};
use crate::oracle::bbox::Bounds;
use crate::oracle::{scan, sweep};
use crate::seed::Rng;

/// Clumps of primitives along a row of length one.
#[derive(Clone, Copy)]
struct Layout<'a> {
    /// The start and end of each clump, and its number of primitives.
    clumps: &'a [(f64, f64, usize)],
    /// The size of the primitives in the first clump.
    first_size: f64,
    /// The size of all others.
    size: f64,
}

const SMALL: f64 = 0.05;

/// Three clumps, two of them near each other. A builder that forgets the outermost bucket ignores
/// the clump at that end, so splitting between the two near clumps can seem best to it.
const CLUMPS: Layout<'static> = Layout {
    clumps: &[(0.0, 0.02, 4), (0.74, 0.8, 4), (0.98, 1.0, 4)],
    first_size: SMALL,
    size: SMALL,
};
/// Clumps with a gap from just above one quarter to just below one half. A builder with four
/// buckets has no plane in this gap.
const GAP: Layout<'static> = Layout {
    clumps: &[
        (0.0, 0.2, 4),
        (0.262, 0.27, 2),
        (0.485, 0.493, 2),
        (0.51, 1.0, 4),
    ],
    first_size: SMALL,
    size: SMALL,
};

/// Clumps of which the first is the largest. If a builder counts the primitives of other buckets than
/// those that it encloses, it does not count this one, and splits at the other gap.
const HEAVY_END: Layout<'static> = Layout {
    clumps: &[(0.0, 0.02, 6), (0.6, 0.62, 2), (0.98, 1.0, 4)],
    first_size: SMALL,
    size: SMALL,
};

/// Clumps of which the first is of large primitives, so that it is best left alone. The wider gap is
/// the other one: a builder that takes a primitive for a point splits there.
const LARGE_END: Layout<'static> = Layout {
    clumps: &[(0.0, 0.02, 4), (0.42, 0.44, 4), (0.98, 1.0, 4)],
    first_size: 1.2,
    size: SMALL,
};

pub(super) const ONE_SPLIT: Declaration = Declaration {
    id: "build.one_split",
    title: "the best split of a few primitives in a row is found",
    look: "Here one partition is much cheaper than all others. Work out its cost by hand from the \
           areas and the counts of its sides: does your code try it, does it compute that cost, \
           and does your root have these two sides?",
    section: "building.md#which-partitions-to-try",
    tests: &["Use 8 or more buckets…"],
    questions: one_split,
    ..Declaration::ALONE
};

fn one_split(rng: &mut Rng) -> Vec<ExamQuestion> {
    /// How many times as many primitives as shown each layout has.
    const TIMES: [usize; 8] = [1, 2, 1, 5, 1, 20, 1, 50];
    let mut rows = Vec::new();
    for layout in [CLUMPS, GAP, HEAVY_END, LARGE_END] {
        for axis in 0..3 {
            for is_mirrored in [false, true] {
                let times = TIMES[rows.len() % TIMES.len()];
                let clumps = layout.clumps.iter();
                let clumps: Vec<_> = clumps.map(|&(from, to, n)| (from, to, times * n)).collect();
                let layout = Layout {
                    clumps: &clumps,
                    ..layout
                };
                rows.push((row(rng, &layout, axis, is_mirrored), 8 * times));
            }
        }
    }
    for (index, count) in [3, 3, 4, 4, 5, 6, 7, 8, 9, 10].into_iter().enumerate() {
        let axis = rng.index(3);
        rows.push((few(rng, count, axis, index % 2 == 0), count - 1));
    }
    for count in [16_usize, 31, 64, 129, 256, 513, 1000] {
        let (axis, is_mirrored) = (rng.index(3), rng.coin());
        let largest = 6 * count / 10 + count.div_ceil(64);
        let leaf_size = largest + rng.index(count - largest);
        rows.push((many(rng, count, axis, is_mirrored), leaf_size));
    }
    for axis in 0..3 {
        rows.push((stack(rng, axis), 8));
    }
    let sizes = fields::SIZES.len();
    let first = rng.index(sizes);
    let question = |(index, (shapes, leaf_size)): (usize, (Vec<Shape>, usize))| {
        let place = place_of_size(rng, &shapes, (first + index) % sizes);
        cost_question(place.shapes(&shapes), leaf_size as u32)
    };
    rows.into_iter().enumerate().map(question).collect()
}

/// Returns a crowd and a primitive far from it.
fn few(rng: &mut Rng, count: usize, axis: usize, is_mirrored: bool) -> Vec<Shape> {
    let layout = Layout {
        clumps: &[(0.0, 0.0, 1), (0.8, 1.0, count - 1)],
        first_size: LARGE,
        size: LARGE,
    };
    row(rng, &layout, axis, is_mirrored)
}

/// Returns two crowds of which the smaller is the denser. Builders that try up to 64 chunks of equally
/// many primitives instead of buckets find the gap as well: the first crowd along the axis consists of
/// whole chunks.
fn many(rng: &mut Rng, count: usize, axis: usize, is_mirrored: bool) -> Vec<Shape> {
    let chunk = count.div_ceil(64);
    let whole = |tenths: usize| tenths * count / 10 / chunk * chunk;
    let smaller = if is_mirrored {
        count - whole(6)
    } else {
        whole(4)
    };
    let layout = Layout {
        clumps: &[(0.0, 0.02, smaller), (0.6, 1.0, count - smaller)],
        first_size: SMALL,
        size: SMALL,
    };
    row(rng, &layout, axis, is_mirrored)
}

/// The size of a primitive that is far larger than the spaces between some others.
const LARGE: f64 = 0.4;

/// Returns triangles in a row along an axis, evenly spaced in each clump, for which one partition is the
/// best.
fn row(rng: &mut Rng, layout: &Layout, axis: usize, is_mirrored: bool) -> Vec<Shape> {
    rng.retry(|rng| {
        let shapes = any_row(rng, layout, axis, is_mirrored);
        is_unambiguous(&shapes, axis).then_some(shapes)
    })
}

fn any_row(rng: &mut Rng, layout: &Layout, axis: usize, is_mirrored: bool) -> Vec<Shape> {
    /// The number of primitives from which on all are spheres, which take less space in an exam.
    const MANY: usize = 33;
    let start = rng.point(3.0);
    let length = rng.uniform(8.0, 12.0);
    let all: usize = layout.clumps.iter().map(|(_, _, count)| count).sum();
    let kind = if all >= MANY { 2 } else { rng.index(4) };
    let mut shapes = Vec::new();
    for (clump, &(from, to, count)) in layout.clumps.iter().enumerate() {
        let size = if clump == 0 {
            layout.first_size
        } else {
            layout.size
        };
        for i in 0..count {
            let at = from + (to - from) * i as f64 / (count.max(2) - 1) as f64;
            let at = if is_mirrored { 1.0 - at } else { at };
            let offset = rng.point(0.05);
            let center = start + offset + (length * at - offset[axis]) * DVec3::AXES[axis];
            shapes.push(with_box_around(rng, kind, center, size));
        }
    }
    meshes::number_shapes(rng.shuffled(shapes))
}

/// Returns a primitive of a kind, whose box has this centre.
fn with_box_around(rng: &mut Rng, kind: usize, center: DVec3, size: f64) -> Shape {
    match kind {
        0 | 1 => meshes::random_triangle_with_box_around(rng, center, size),
        2 => meshes::sphere(center, 0.7 * size),
        _ => {
            let kind = 1 + rng.index(2);
            with_box_around(rng, kind, center, size)
        }
    }
}

/// Returns two layers of strips that are much longer than the space between the layers. The space is
/// below a twentieth of the extent of the centres along the strips.
fn stack(rng: &mut Rng, axis: usize) -> Vec<Shape> {
    let [along, across] = [1, 2].map(|next| DVec3::AXES[(axis + next) % 3]);
    rng.retry(|rng| {
        let start = rng.point(3.0);
        let strips = (0..12).map(|index| {
            let level = if index < 6 { 0.0 } else { 0.08 };
            let height = level + rng.uniform(0.0, 0.01);
            let at = match index {
                0 => -1.3,
                11 => 1.3,
                _ => rng.uniform(-1.3, 1.3),
            };
            let center = start + at * along + height * DVec3::AXES[axis];
            let (half, width) = (rng.uniform(4.5, 5.5) * along, 0.02 * across);
            meshes::flat_triangle([center - half, center + half, center + half + width], 0)
        });
        let shapes = meshes::number_shapes(strips);
        let shapes = meshes::number_shapes(rng.shuffled(shapes));
        is_unambiguous(&shapes, axis).then_some(shapes)
    })
}

/// Returns whether every builder with 8 to 64 buckets finds the best partition. For this, the
/// partition must be the best by a clear margin, and must split at a gap along this axis that
/// contains a plane of every such builder.
fn is_unambiguous(shapes: &[Shape], axis: usize) -> bool {
    let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
    let Some(gap) = sweep::clear_gap(&boxes, axis) else {
        return false;
    };
    let node_box = Bounds::enclosing(boxes.iter().copied());
    let center_box = Bounds::around(boxes.iter().map(Bounds::center));
    (8..=64).all(|count| {
        [node_box, center_box].iter().all(|over| {
            let size = (over.max - over.min)[axis];
            let part = |position: f64| (position - over.min[axis]) / size * count as f64;
            // Some plane is between the two ends of the gap, and not close to either end.
            (part(gap.1) - 0.05).floor() > (part(gap.0) + 0.05).floor()
        })
    })
}
