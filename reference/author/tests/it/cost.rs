//! Each question of `build.one_split` has a best split, which good builders find and bad builders
//! miss.

use author::items::build::{self, relative_cost};
use author::items::resolve;
use author::oracle::buckets::{BucketExtent, BucketedBuilder, SideRule};
use author::seed::Seed;
use judging::exam::ExamQuestion;

const SEEDS: [u64; 4] = [2025, 1, 2, 3];

/// Returns the questions of `build.one_split` except the last, which is a control. Each of the
/// returned questions has a single best split.
fn one_split(seed: u64) -> Vec<ExamQuestion> {
    let items = resolve(build::TASK.draw(Seed(seed), &[]));
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
                let sides = SideRule::AllBuckets;
                let buckets = BucketedBuilder {
                    count,
                    extent,
                    sides,
                };
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
            // The judge gives full marks up to 1.12.
            let missed = four.iter().filter(|ratio| **ratio > 1.12).count();
            assert!(missed >= 3, "{seed} {extent:?}: {four:?}");
        }
    }
}
