//! Properties of every exam.

use std::collections::BTreeSet;

use author::items::shares_a_question;
use author::seed::Seed;
use glam::Vec3;
use judging::assignment::RAYS;
use judging::exam::{ExpectedRows, Item, Key};
use judging::scene::{self, QuestionScene};
use protocol::{Question, Ray, Shape};

use crate::sample_exams::{SEEDS, exam_of};

fn rays(question: &Question) -> impl Iterator<Item = Ray> {
    (0..question.count()).filter_map(|row| scene::ray(question, row))
}

#[test]
fn ids_are_unique_and_begin_with_their_task() {
    let exam = exam_of(SEEDS[0]);
    let ids: BTreeSet<&String> = exam.items.iter().map(|item| &item.id).collect();
    assert_eq!(ids.len(), exam.items.len());
    assert!(exam.items.len() >= 60, "{}", exam.items.len());
    for item in &exam.items {
        let task = format!("{}.", item.task);
        assert!(item.id.starts_with(&task), "{}", item.id);
    }
}

#[test]
fn points_add_up_per_task() {
    let exam = exam_of(SEEDS[0]);
    for task in RAYS.tasks() {
        let of_task = exam.items.iter().filter(|item| item.task == task);
        let points: u32 = of_task.map(|item| item.points).sum();
        assert_eq!(points, RAYS.info(task).points, "{task}");
    }
    assert!(exam.items.iter().all(|item| item.points >= 1));
}

#[test]
fn items_come_after_their_dependencies_which_are_of_other_tasks() {
    let exam = exam_of(SEEDS[0]);
    for (index, item) in exam.items.iter().enumerate() {
        for needed in &item.needs {
            let found = exam.items[..index].iter().find(|other| other.id == *needed);
            let found = found.unwrap_or_else(|| panic!("{} needs {needed}", item.id));
            assert_ne!(found.task, item.task, "{} needs {needed}", item.id);
        }
    }
}

#[test]
fn titles_and_advice_are_sentences_without_code() {
    for item in &exam_of(SEEDS[0]).items {
        let (title, look) = (&item.title, &item.look);
        assert!(title.chars().count() <= 80, "{title}");
        assert!(!title.ends_with('.'), "{title}");
        assert!(look.ends_with(['.', '?']) && !look.contains("  "), "{look}");
        assert!((40..=240).contains(&look.chars().count()), "{look}");
        assert!(!look.contains(';') || !look.contains("()"), "{look}");
    }
}

#[test]
fn rays_have_unit_length_and_exams_stay_within_the_budget() {
    for seed in SEEDS {
        let mut count = 0;
        for item in &exam_of(seed).items {
            for question in &item.questions {
                count += question.question.count();
                for ray in rays(&question.question) {
                    let is_unit = (ray.dir.length() - 1.0).abs() < 1e-5;
                    assert!(is_unit, "{}: {ray:?}", item.id);
                }
            }
        }
        assert!(count < 110_000, "{count} elements");
    }
}

/// Returns whether the keys of an item rule out a constant answer: they contain both hits and
/// misses, directions that differ, or a tree.
fn has_opposites(item: &Item) -> bool {
    let is_hit = |key: &Key| -> Vec<bool> {
        match key {
            Key::Table { rows, .. } => match rows {
                ExpectedRows::Rays(directions) => {
                    let is_other = |dir: &Vec3| dir.distance(directions[0]) > 0.1;
                    directions.iter().map(is_other).collect()
                }
                ExpectedRows::Hits(_) | ExpectedRows::Spans(_) | ExpectedRows::Directions(_) => {
                    (0..rows.count()).map(|row| rows.is_present(row)).collect()
                }
            },
            Key::FirstHits { hits, .. } => hits.iter().map(Option::is_some).collect(),
            Key::Tree { .. } => vec![true, false],
            Key::Radiance { .. } => Vec::new(),
        }
    };
    let keys = item.questions.iter().map(|question| &question.key);
    let all: BTreeSet<bool> = keys.flat_map(is_hit).collect();
    all.len() == 2
}

#[test]
fn every_item_has_opposite_answers() {
    for seed in SEEDS {
        for item in &exam_of(seed).items {
            assert!(has_opposites(item), "seed {seed}, {}", item.id);
        }
    }
}

#[test]
fn pictures_show_no_pole() {
    for item in &exam_of(SEEDS[0]).items {
        for question in &item.questions {
            let of_spheres = matches!(
                &question.question,
                Question::Hit(table)
                    if table.subject.shapes().iter().any(|shape| matches!(shape, Shape::Sphere { .. }))
            );
            if let (true, Key::FirstHits { hits, .. }) = (of_spheres, &question.key) {
                let mut hits = hits.iter().flatten();
                let has_pole = hits.any(|hit| hit.normal.y.abs() > 0.999);
                assert!(!has_pole, "{}", item.id);
            }
        }
    }
}

#[test]
fn materials_are_distinct_in_trees() {
    for item in &exam_of(SEEDS[0]).items {
        for question in &item.questions {
            let Some(scene) = QuestionScene::of(&question.question) else {
                continue;
            };
            if scene.tree.is_some() || scene.max_leaf_size.is_some() {
                let numbers: BTreeSet<u32> = scene.shapes.iter().map(Shape::number).collect();
                assert_eq!(numbers.len(), scene.shapes.len(), "{}", item.id);
            }
        }
    }
}

#[test]
fn a_final_exam_shares_no_question_with_the_practice_exam() {
    let [practice, finals @ ..] = SEEDS;
    assert_eq!(Seed(practice), Seed::PRACTICE);
    for exam in finals.map(exam_of) {
        for (item, other) in exam.items.iter().zip(&exam_of(practice).items) {
            assert_ne!(item.questions, other.questions, "{}", item.id);
            // The path-traced picture is a placeholder here.
            let is_picture = item.id == "traverse.radiance";
            assert!(is_picture || !shares_a_question(item, other), "{}", item.id);
        }
    }
}
