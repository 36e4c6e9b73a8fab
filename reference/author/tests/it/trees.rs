//! Properties of the exam's prebuilt trees.

use std::collections::BTreeSet;

use author::oracle::{Ray64, scan};
use author::tree::{Tree, decoy};
use judging::assignment::RAYS;
use judging::exam::Exam;
use protocol::{Ray, Rows};

use crate::harness::{SEEDS, exam_of};

/// Returns the item's id, the prebuilt tree and the rays of every question that has a list of rays.
fn trees(exam: &Exam) -> Vec<(&str, Tree, Vec<Ray>)> {
    let questions = exam.items.iter().flat_map(|item| {
        let questions = item.questions.iter();
        questions.map(move |question| (&*item.id, question))
    });
    let with_tree = questions.filter_map(|(id, question)| {
        let (tree, Rows::List(rays)) = Tree::in_question(&question.question)? else {
            return None;
        };
        Some((id, tree, rays.clone()))
    });
    with_tree.collect()
}

#[test]
fn a_correct_traversal_never_reaches_a_decoy() {
    for seed in SEEDS {
        let exam = exam_of(seed);
        for (id, tree, rays) in trees(exam) {
            assert!(decoy::is_fair(&tree, &rays), "seed {seed}, {id}");
        }
    }
}

#[test]
fn child_boxes_are_inside_their_parents_box() {
    for (id, tree, _) in trees(exam_of(SEEDS[0])) {
        if tree.nodes.is_empty() {
            continue;
        }
        for index in tree.subtree(tree.root) {
            let node = &tree.nodes[index];
            for child in [node.l, node.r].iter().filter(|_| !node.is_leaf()) {
                let child = tree.bounds(*child as usize);
                assert!(tree.bounds(index).contains(&child), "{id}");
            }
        }
    }
}

#[test]
fn a_linear_scan_fails_every_traversal_item() {
    for seed in SEEDS {
        let exam = exam_of(seed);
        let is_wrong = |(_, tree, rays): &(&str, Tree, Vec<Ray>)| {
            rays.iter().any(|ray| {
                let ray64 = Ray64::from(ray);
                scan::closest_hit(&ray64, &tree.shapes) != tree.expected_hit(&ray64)
            })
        };
        let wrong = trees(exam).into_iter().filter(is_wrong);
        let caught: BTreeSet<&str> = wrong.map(|(id, ..)| id).collect();
        let traverse = RAYS.find("traverse").unwrap().task();
        for item in exam.items.iter().filter(|item| item.task == traverse) {
            assert!(caught.contains(&*item.id), "seed {seed}, {}", item.id);
        }
    }
}

#[test]
fn a_deep_tree_has_sixty_levels() {
    let exam = exam_of(SEEDS[0]);
    let trees = trees(exam);
    let (_, tree, _) = trees
        .iter()
        .find(|(id, ..)| *id == "traverse.deep")
        .unwrap();
    let levels = tree.leaves().into_iter().map(|leaf| tree.path(leaf).len());
    assert_eq!(levels.max(), Some(60));
}
