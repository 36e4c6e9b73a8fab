//! The meshes of the cost items distinguish good builders from bad ones: all builders with SAH
//! buckets come close to the exact sweep, and builders without the heuristic do not.

mod builders;

use author::items::build::{self, MAX_CORRECT_COST, MIN_ADJACENT_COST, relative_cost};
use author::items::resolve;
use author::oracle::buckets::{BucketExtent, BucketedBuilder};
use author::seed::Seed;
use judging::exam::{ExamQuestion, Item, Key};
use protocol::Question;

use crate::builders::Splitter;

/// The minimum relative cost of a bad builder. The judge gives half marks up to 1.25.
const MIN_BAD_RATIO: f64 = 1.3;

const SEEDS: [u64; 4] = [2025, 1, 2, 3];

fn cost_items(seed: u64) -> Vec<Item> {
    let mut items = resolve(build::items(Seed(seed)));
    items.retain(|item| item.id.starts_with("build.cost_"));
    items
}

/// Returns the cost of the tree that this splitter builds, relative to that of the exact sweep.
fn ratio(item: &Item, splitter: Splitter) -> f64 {
    let exam_question = &item.questions[0];
    let Question::Build {
        shapes,
        max_leaf_size,
    } = &exam_question.question
    else {
        unreachable!("the question of a cost item is a build question")
    };
    let Key::Tree {
        sweep_cost: Some(sweep),
        ..
    } = exam_question.key
    else {
        unreachable!("the key of a cost item has the sweep's cost")
    };
    builders::cost(shapes, *max_leaf_size as usize, splitter) / sweep
}

#[test]
fn bucketed_builders_come_close_to_the_sweep() {
    for seed in SEEDS {
        for item in cost_items(seed) {
            for count in [8, 12, 16, 32] {
                for extent in [BucketExtent::Centers, BucketExtent::Bounds] {
                    let buckets = BucketedBuilder::correct(count, extent);
                    let ratio = relative_cost(&item.questions[0], buckets);
                    println!("{seed} {} {count} {extent:?}: {ratio:.3}", item.id);
                    assert!(
                        ratio <= MAX_CORRECT_COST,
                        "{seed} {} {count} {extent:?}: {ratio}",
                        item.id
                    );
                }
            }
        }
    }
}

#[test]
fn weighing_only_the_two_buckets_beside_a_plane_is_not_enough() {
    for seed in SEEDS {
        for item in cost_items(seed) {
            for count in [8, 12, 16, 24, 32] {
                let buckets =
                    BucketedBuilder::with_adjacent_buckets_only(count, BucketExtent::Centers);
                let ratio = relative_cost(&item.questions[0], buckets);
                println!("{seed} {} {count}: {ratio:.3}", item.id);
                assert!(
                    ratio >= MIN_ADJACENT_COST,
                    "{seed} {} {count}: {ratio}",
                    item.id
                );
            }
        }
    }
}

#[test]
fn ignoring_the_areas_is_not_enough() {
    for seed in SEEDS {
        for splitter in [Splitter::Middle, Splitter::Median] {
            let ratios = cost_items(seed)
                .iter()
                .map(|item| ratio(item, splitter))
                .collect::<Vec<_>>();
            println!("{seed} {splitter:?}: {ratios:.3?}");
            let far_off = ratios
                .iter()
                .filter(|ratio| **ratio >= MIN_BAD_RATIO)
                .count();
            assert!(far_off >= 2, "{splitter:?}: {ratios:?}");
        }
    }
}

#[test]
fn one_axis_alone_is_not_enough() {
    for seed in SEEDS {
        for axis in 0..3 {
            let ratios = cost_items(seed)
                .iter()
                .map(|item| ratio(item, Splitter::OneAxis(axis)))
                .collect::<Vec<_>>();
            println!("{seed} axis {axis}: {ratios:.3?}");
            assert!(ratios[0] >= MIN_BAD_RATIO, "axis {axis}: {ratios:?}");
        }
    }
}

#[test]
fn a_wrong_heuristic_is_not_enough() {
    for seed in SEEDS {
        for splitter in [Splitter::AreaPerBucket, Splitter::Worst] {
            let items = cost_items(seed);
            let ratios: Vec<f64> = items.iter().map(|item| ratio(item, splitter)).collect();
            println!("{seed} {splitter:?}: {ratios:.3?}");
            assert!(
                ratios.iter().any(|ratio| *ratio >= MIN_BAD_RATIO),
                "{splitter:?}: {ratios:?}"
            );
        }
    }
}

/// Returns the questions of `build.one_split`, each of which has one best split, without the
/// control.
fn one_split(seed: u64) -> Vec<ExamQuestion> {
    let items = resolve(build::items(Seed(seed)));
    let item = items.into_iter().find(|item| item.id == "build.one_split");
    let mut questions = item.expect("the item exists").questions;
    questions.pop().expect("the control is the last question");
    questions
}

#[test]
fn eight_or_more_buckets_find_the_best_split_and_four_do_not() {
    for seed in SEEDS {
        let questions = one_split(seed);
        for extent in [BucketExtent::Centers, BucketExtent::Bounds] {
            let ratios = |count: usize| -> Vec<f64> {
                let buckets = BucketedBuilder::correct(count, extent);
                let ratio = |question| relative_cost(question, buckets);
                questions.iter().map(ratio).collect()
            };
            for count in [8, 9, 10, 11, 12, 13, 16, 20, 25, 32, 40, 64] {
                let ratios = ratios(count);
                let as_good = ratios.iter().all(|ratio| (ratio - 1.0).abs() < 1e-9);
                assert!(as_good, "{seed} {count} {extent:?}: {ratios:?}");
            }
            let four = ratios(4);
            println!("{seed} 4 {extent:?}: {four:.3?}");
            let missed = four.iter().filter(|ratio| **ratio > 1.15).count();
            assert!(missed >= 3, "{seed} {extent:?}: {four:?}");
        }
    }
}
