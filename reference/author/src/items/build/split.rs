//! One choice alone: a few primitives in a row, of which one partition is by far the best.

use glam::DVec3;
use grader::exam::{ExamQuestion, Item};
use protocol::Shape;

use super::cost::cost_question;
use super::item;
use crate::items::meshes;
use crate::oracle::bbox::Bounds;
use crate::oracle::{scan, sweep};
use crate::seed::{Rng, Seed};

/// As many as both sides of the best partition may hold; all together are more.
const MAX_LEAF_SIZE: u32 = 8;

/// Clumps of primitives along a row of length one: from where to where, and how many.
type Layout = &'static [(f64, f64, usize)];

/// Three clumps, two of them near each other. To whoever forgets the outermost bucket, one clump
/// costs nothing wherever it goes: it seems best to leave it with those that are far from it.
const CLUMPS: Layout = &[(0.0, 0.02, 4), (0.74, 0.8, 4), (0.98, 1.0, 4)];
/// A gap from a little after one quarter to a little before one half: four buckets miss it.
const GAP: Layout = &[
    (0.0, 0.2, 4),
    (0.262, 0.27, 2),
    (0.485, 0.493, 2),
    (0.51, 1.0, 4),
];

pub(super) fn one_split(seed: Seed) -> Item {
    let mut draw = seed.rng("build.one_split");
    let mut questions = Vec::new();
    for layout in [CLUMPS, GAP] {
        for axis in 0..3 {
            for is_mirrored in [false, true] {
                questions.push(question(&mut draw, layout, axis, is_mirrored));
            }
        }
    }
    item(
        "one_split",
        1,
        [
            "of a few primitives in a row the best partition is found",
            "Each plane between two buckets is a partition: on one side are all buckets before it, \
             on the other all the rest, from the very first to the very last. Take 8 or more.",
        ],
        questions,
    )
}

fn question(draw: &mut Rng, layout: Layout, axis: usize, is_mirrored: bool) -> ExamQuestion {
    let shapes = draw.retry(|draw| {
        let shapes = row(draw, layout, axis, is_mirrored);
        is_unambiguous(&shapes, axis).then_some(shapes)
    });
    cost_question(shapes, MAX_LEAF_SIZE)
}

/// Chips in a row along an axis, those of a clump evenly.
fn row(draw: &mut Rng, layout: Layout, axis: usize, is_mirrored: bool) -> Vec<Shape> {
    let start = draw.point(3.0);
    let length = draw.uniform(8.0, 12.0);
    let mut chips = Vec::new();
    for &(from, to, count) in layout {
        for i in 0..count {
            let place = from + (to - from) * i as f64 / (count - 1) as f64;
            let place = if is_mirrored { 1.0 - place } else { place };
            let aside = draw.point(0.05);
            let center = start + aside + (length * place - aside[axis]) * DVec3::AXES[axis];
            chips.push(meshes::random_flat_triangle(draw, center, 0.05));
        }
    }
    meshes::number_shapes(draw.shuffled(chips))
}

/// Whether every builder with 8 buckets or more finds the best of all partitions: it is the best by
/// far, and lies across a gap along this axis that some plane of any of them goes through.
fn is_unambiguous(shapes: &[Shape], axis: usize) -> bool {
    let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
    let Some(gap) = sweep::clear_gap(&boxes, axis) else {
        return false;
    };
    let around_all = |all: Bounds, next: &Bounds| all.union(next);
    let of_boxes = boxes.iter().fold(Bounds::around([]), around_all);
    let of_centers = Bounds::around(boxes.iter().map(Bounds::center));
    (8..=64).all(|count| {
        [of_boxes, of_centers].iter().all(|over| {
            let size = (over.max - over.min)[axis];
            let part = |place: f64| (place - over.min[axis]) / size * count as f64;
            // A plane between the two, and not next to either.
            (part(gap.1) - 0.05).floor() > (part(gap.0) + 0.05).floor()
        })
    })
}
