//! What a tree costs.

use grader::exam::{ExamQuestion, Item, Key};
use protocol::{Question, Shape};

use super::item;
use crate::items::meshes;
use crate::oracle::bbox::Bounds;
use crate::oracle::buckets::{self, BucketExtent, BucketedBuilder};
use crate::oracle::{scan, sweep};
use crate::seed::{Rng, Seed};

/// A question about the cost alone.
pub(super) fn cost_question(shapes: Vec<Shape>, max_leaf_size: u32) -> ExamQuestion {
    let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
    let sweep_cost = Some(sweep::cost(&boxes, max_leaf_size as usize));
    let question = Question::Build {
        shapes,
        max_leaf_size,
    };
    let key = Key::Tree {
        checks: Vec::new(),
        sweep_cost,
    };
    ExamQuestion::new(question, key)
}

/// Every honest builder's tree costs at most this, by the cost of the exact sweep's: the judge gives
/// full marks up to 1.12.
pub const MAX_CORRECT_COST: f64 = 1.06;

/// The tree of who weighs only the two buckets beside a plane costs at least this, by the same: luck
/// must not hide what is often seen.
pub const MIN_ADJACENT_COST: f64 = 1.2;

/// One question, about a mesh that is fair and that tells: drawn again until it is.
fn cost_item(name: &str, points: u32, text: [&str; 2], draw_of: Rng, mesh: MeshFn) -> Item {
    let mut draw = draw_of;
    let asked = draw.retry(|draw| {
        let shapes = mesh(draw);
        let asked = cost_question(meshes::number_shapes(draw.shuffled(shapes)), 4);
        (highest_correct_cost(&asked) <= MAX_CORRECT_COST
            && lowest_adjacent_cost(&asked) >= MIN_ADJACENT_COST)
            .then_some(asked)
    });
    item(name, points, text, vec![asked])
}

/// The cost of the dearest tree that buckets lead to, by the cost of the exact sweep's. Now and then
/// all planes of some builder just miss what divides a mesh best.
fn highest_correct_cost(asked: &ExamQuestion) -> f64 {
    let costs = [8, 12, 16, 17, 24, 32].into_iter().flat_map(|count| {
        [BucketExtent::Centers, BucketExtent::Bounds]
            .map(|extent| relative_cost(asked, BucketedBuilder::correct(count, extent)))
    });
    costs.fold(0.0, f64::max)
}

/// The cost of the cheapest tree of who takes the two buckets beside a plane for its two sides. Now
/// and then luck leads them to planes that are good enough.
fn lowest_adjacent_cost(asked: &ExamQuestion) -> f64 {
    let costs = [8, 12, 16, 24, 32].map(|count| {
        relative_cost(
            asked,
            BucketedBuilder::with_adjacent_buckets_only(count, BucketExtent::Centers),
        )
    });
    costs.into_iter().fold(f64::INFINITY, f64::min)
}

/// What a bucketed builder's tree costs, by the cost of the exact sweep's.
pub fn relative_cost(asked: &ExamQuestion, buckets: BucketedBuilder) -> f64 {
    match (&asked.question, &asked.key) {
        (
            Question::Build {
                shapes,
                max_leaf_size,
            },
            Key::Tree {
                sweep_cost: Some(sweep),
                ..
            },
        ) => {
            let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
            buckets::cost(&boxes, *max_leaf_size as usize, buckets) / sweep
        }
        (question, _) => unreachable!("{question:?} is not about a tree's cost"),
    }
}

type MeshFn = fn(&mut Rng) -> Vec<Shape>;

pub(super) fn cost_strands(seed: Seed) -> Item {
    cost_item(
        "cost_strands",
        1,
        [
            "all three axes are tried: strands along x, y and z",
            "The cheapest of the partitions along all axes counts, at every node anew: not always \
             the same axis, and not the longest.",
        ],
        seed.rng("build.cost_strands"),
        |draw| meshes::strands(draw, 750),
    )
}

pub(super) fn cost_sheets(seed: Seed) -> Item {
    cost_item(
        "cost_sheets",
        1,
        [
            "the areas decide: sheets above each other",
            "S_A and S_B are the areas of the boxes around *all* primitives of a side: join the \
             buckets from the left and from the right.",
        ],
        seed.rng("build.cost_sheets"),
        |draw| meshes::sheets(draw, 900),
    )
}

pub(super) fn cost_town(seed: Seed) -> Item {
    cost_item(
        "cost_town",
        2,
        [
            "areas and numbers decide together: crowds on an open field",
            "C = C_trav + S_A/S_N · N_A + S_B/S_N · N_B: keep the cheapest partition so far, and \
             its cost.",
        ],
        seed.rng("build.cost_town"),
        |draw| meshes::town(draw, 1200),
    )
}
