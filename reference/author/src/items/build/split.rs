//! The item about a single split: a few primitives in a row, for which one partition is by far the
//! best.

use glam::DVec3;
use judging::exam::ExamQuestion;
use protocol::Shape;

use super::cost::cost_question;
use crate::items::place::dust;
use crate::items::{Declaration, meshes};
use crate::oracle::bbox::Bounds;
use crate::oracle::{scan, sweep};
use crate::seed::Rng;

/// The maximum leaf size. Both sides of the best partition fit in a leaf, but all primitives
/// together do not.
const MAX_LEAF_SIZE: u32 = 8;

/// Clumps of primitives along a row of length one.
struct Layout {
    /// The start and end of each clump, and its number of primitives.
    clumps: &'static [(f64, f64, usize)],
    /// The size of the primitives in the first clump. All others are of size [`SMALL`].
    first_size: f64,
}

const SMALL: f64 = 0.05;

/// Three clumps, two of them near each other. A builder that forgets the outermost bucket ignores
/// the clump at that end, so splitting between the two near clumps can seem best to it.
const CLUMPS: Layout = Layout {
    clumps: &[(0.0, 0.02, 4), (0.74, 0.8, 4), (0.98, 1.0, 4)],
    first_size: SMALL,
};
/// Clumps with a gap from just above one quarter to just below one half. A builder with four
/// buckets has no plane in this gap.
const GAP: Layout = Layout {
    clumps: &[
        (0.0, 0.2, 4),
        (0.262, 0.27, 2),
        (0.485, 0.493, 2),
        (0.51, 1.0, 4),
    ],
    first_size: SMALL,
};

/// Clumps of which the first is the largest. If a builder counts the primitives of other buckets than
/// those that it encloses, it does not count this one, and splits at the other gap.
const HEAVY_END: Layout = Layout {
    clumps: &[(0.0, 0.02, 6), (0.6, 0.62, 2), (0.98, 1.0, 4)],
    first_size: SMALL,
};

/// Clumps of which the first is of large primitives, so that it is best left alone. The wider gap is
/// the other one: a builder that takes a primitive for a point splits there.
const LARGE_END: Layout = Layout {
    clumps: &[(0.0, 0.02, 4), (0.42, 0.44, 4), (0.98, 1.0, 4)],
    first_size: 1.2,
};

pub(super) const ONE_SPLIT: Declaration = Declaration {
    id: "build.one_split",
    title: "the best split of a few primitives in a row is found",
    look: "Here one partition is much cheaper than all others. Work out its cost by hand from the \
           areas and the counts of its sides: does your code try it, does it compute that cost, \
           and does your root have these two sides?",
    section: "building.md#which-partitions-to-try",
    questions: |rng| {
        let mut questions = Vec::new();
        for layout in [CLUMPS, GAP, HEAVY_END, LARGE_END] {
            for axis in 0..3 {
                for is_mirrored in [false, true] {
                    questions.push(question(rng, &layout, axis, is_mirrored));
                }
            }
        }
        for axis in 0..3 {
            questions.push(dust(question(rng, &CLUMPS, axis, false)));
        }
        questions
    },
    ..Declaration::ALONE
};

fn question(rng: &mut Rng, layout: &Layout, axis: usize, is_mirrored: bool) -> ExamQuestion {
    let shapes = rng.retry(|rng| {
        let shapes = row(rng, layout, axis, is_mirrored);
        is_unambiguous(&shapes, axis).then_some(shapes)
    });
    cost_question(shapes, MAX_LEAF_SIZE)
}

/// Returns triangles in a row along an axis, evenly spaced in each clump.
fn row(rng: &mut Rng, layout: &Layout, axis: usize, is_mirrored: bool) -> Vec<Shape> {
    let start = rng.point(3.0);
    let length = rng.uniform(8.0, 12.0);
    let mut triangles = Vec::new();
    for (clump, &(from, to, count)) in layout.clumps.iter().enumerate() {
        let size = if clump == 0 { layout.first_size } else { SMALL };
        for i in 0..count {
            let at = from + (to - from) * i as f64 / (count - 1) as f64;
            let at = if is_mirrored { 1.0 - at } else { at };
            let offset = rng.point(0.05);
            let center = start + offset + (length * at - offset[axis]) * DVec3::AXES[axis];
            triangles.push(meshes::random_triangle_with_box_around(rng, center, size));
        }
    }
    meshes::number_shapes(rng.shuffled(triangles))
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
