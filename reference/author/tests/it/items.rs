//! Properties of every exam.

#![allow(
    clippy::wildcard_enum_match_arm,
    reason = "only some kinds of answers are treated in a special way"
)]

use std::collections::BTreeSet;

use author::authoring;
use author::exams::{assemble, load_practice};
use author::items::shares_a_question;
use author::seed::Seed;
use glam::Vec3;
use judging::assignment::{Assignment, LIGHT, RAYS};
use judging::drawing_data::DrawingData;
use judging::exam::{Exam, ExpectedRows, Item, Key, TreeCheck};
use judging::scene::{self, QuestionScene};
use judging::symptom::{SOME_OR_NONE, SPREAD, Side, Symptom};
use protocol::{Question, Ray, Shape};

use crate::harness::{SEEDS, exam_of, root};

/// Returns one exam for each assignment.
fn exam_of_each() -> [(&'static Assignment, Exam); 2] {
    let light = assemble(&authoring::LIGHT, "test", Seed(SEEDS[0]));
    let light = light.expect("the practice exam can be read");
    [(&RAYS, exam_of(SEEDS[0]).clone()), (&LIGHT, light)]
}

fn rays(question: &Question) -> impl Iterator<Item = Ray> {
    (0..question.count()).filter_map(|row| scene::ray(question, row))
}

#[test]
fn ids_are_unique_and_begin_with_their_task() {
    for (assignment, exam) in exam_of_each() {
        let fewest = if *assignment == RAYS { 60 } else { 56 };
        let ids: BTreeSet<&String> = exam.items.iter().map(|item| &item.id).collect();
        assert_eq!(ids.len(), exam.items.len());
        assert!(exam.items.len() >= fewest, "{}", exam.items.len());
        for item in &exam.items {
            let task = format!("{}.", item.task);
            assert!(item.id.starts_with(&task), "{}", item.id);
        }
    }
}

#[test]
fn points_add_up_per_task() {
    for (assignment, exam) in exam_of_each() {
        for task in assignment.tasks() {
            let of_task = exam.items.iter().filter(|item| item.task == task);
            let points: u32 = of_task.map(|item| item.points).sum();
            assert_eq!(points, assignment.info(task).points, "{task}");
        }
        assert!(exam.items.iter().all(|item| item.points >= 1));
    }
}

#[test]
fn items_come_after_their_dependencies_which_are_of_other_tasks() {
    for (_, exam) in exam_of_each() {
        for (index, item) in exam.items.iter().enumerate() {
            for needed in &item.needs {
                let found = exam.items[..index].iter().find(|other| other.id == *needed);
                let found = found.unwrap_or_else(|| panic!("{} needs {needed}", item.id));
                assert_ne!(found.task, item.task, "{} needs {needed}", item.id);
            }
        }
    }
}

#[test]
fn titles_and_advice_are_sentences_without_code() {
    let exams = exam_of_each();
    for item in exams.iter().flat_map(|(_, exam)| &exam.items) {
        let (title, look) = (&item.title, &item.look);
        assert!(title.chars().count() <= 80, "{title}");
        assert!(!title.ends_with('.'), "{title}");
        assert!(look.ends_with(['.', '?']) && !look.contains("  "), "{look}");
        assert!((40..=240).contains(&look.chars().count()), "{look}");
        assert!(!look.contains(';') || !look.contains("()"), "{look}");
    }
}

/// Returns the symptoms that an answer to a question can show.
fn possible_symptoms(key: &Key) -> Vec<Symptom> {
    let quantity = |judged: &String| match judged.strip_prefix("unit_") {
        Some(direction) => format!("length of the {direction}"),
        None => judged.clone(),
    };
    let any = |what: &str| Symptom {
        what: what.to_owned().into(),
        side: None,
    };
    match key {
        Key::Table { judged, rows, .. } => {
            let presence = match rows {
                ExpectedRows::Hits(_) | ExpectedRows::Spans(_) => vec![Symptom::MISS, Symptom::HIT],
                ExpectedRows::OptionalDirections(_) => {
                    vec![Symptom::less(SOME_OR_NONE), Symptom::more(SOME_OR_NONE)]
                }
                _ => Vec::new(),
            };
            let directions = judged
                .iter()
                .filter(|judged| ["normal", "direction"].contains(&judged.as_str()));
            let reversed = directions.map(|direction| Symptom {
                side: Some(Side::Reversed),
                ..any(direction)
            });
            let judged = judged.iter().map(|judged| any(&quantity(judged)));
            presence.into_iter().chain(judged).chain(reversed).collect()
        }
        Key::FirstHits { .. } => vec![
            Symptom::MISS,
            Symptom::HIT,
            Symptom::less("depth"),
            Symptom::more("depth"),
            Symptom::of("normal"),
            Symptom::of("uv"),
        ],
        Key::Tree { checks, sweep_cost } => {
            let of_check = |check: &TreeCheck| match check {
                TreeCheck::Partition => Vec::new(),
                TreeCheck::Contains => vec![Symptom::of("box too small")],
                TreeCheck::Tight => vec![Symptom::of("box too large")],
                TreeCheck::Split => vec![Symptom::less("splits")],
                TreeCheck::LeafSize => vec![Symptom::of("leaf size")],
                TreeCheck::Stops => vec![Symptom::more("splits")],
            };
            let cost = sweep_cost.map(|_| Symptom::of("SAH cost"));
            let always = ["nodes", "root", "l", "r", "leaves"].map(Symptom::of);
            let checks = checks.iter().flat_map(of_check);
            always.into_iter().chain(cost).chain(checks).collect()
        }
        Key::Radiance { .. } => vec![Symptom::of("radiance")],
        Key::SpreadEvenly { .. } => vec![Symptom::of(SPREAD)],
    }
}

#[test]
fn there_is_advice_for_every_symptom() {
    let exams = exam_of_each();
    let items = exams
        .iter()
        .flat_map(|(assignment, exam)| exam.items.iter().map(move |item| (assignment, item)));
    for (assignment, item) in items {
        let clues = &assignment.info(item.task).clues;
        let keys = item.questions.iter().map(|question| &question.key);
        for symptom in keys.flat_map(possible_symptoms) {
            let has_advice = item.has_look_for(&symptom) || clues.of_symptom(&symptom).is_some();
            assert!(
                has_advice,
                "{}: neither `look_fits` nor the task's clues (by_symptom) cover {symptom:?}",
                item.id
            );
        }
        for fitting in &item.look_fits {
            let keys = item.questions.iter().map(|question| &question.key);
            let mut possible = keys.flat_map(possible_symptoms);
            let is_possible = possible.any(|it| fitting.includes(&it) || it.includes(fitting));
            assert!(is_possible, "{} never shows {fitting:?}", item.id);
        }
    }
    let tasks = RAYS.tasks.iter().chain(LIGHT.tasks);
    for clue in tasks.flat_map(|task| task.clues.by_symptom) {
        let text = clue.clue;
        assert!(text.ends_with(['.', '?']) && !text.contains("  "), "{text}");
        assert!((40..=240).contains(&text.chars().count()), "{text}");
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

/// Returns whether an item's keys rule out a constant answer: they contain both hits and misses,
/// directions that differ, or a tree.
fn has_opposites(item: &Item) -> bool {
    let is_hit = |key: &Key| -> Vec<bool> {
        match key {
            Key::Table { rows, .. } => match rows {
                ExpectedRows::Rays(directions) => {
                    let is_other = |dir: &Vec3| dir.distance(directions[0]) > 0.1;
                    directions.iter().map(is_other).collect()
                }
                ExpectedRows::Hits(_) | ExpectedRows::Spans(_) => {
                    (0..rows.count()).map(|row| rows.is_present(row)).collect()
                }
                rows => {
                    let text = |row| format!("{:?}", rows.record(row));
                    (0..rows.count()).map(|row| text(row) == text(0)).collect()
                }
            },
            Key::FirstHits { hits, .. } => hits.iter().map(Option::is_some).collect(),
            Key::Tree { .. } | Key::SpreadEvenly { .. } => vec![true, false],
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
    let [_, (_, light)] = exam_of_each();
    for item in &light.items {
        assert!(has_opposites(item), "{}", item.id);
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
            // The rendered picture is a placeholder here.
            let is_picture = item.id == "traverse.radiance";
            assert!(is_picture || !shares_a_question(item, other), "{}", item.id);
        }
    }
}

#[test]
fn the_light_along_a_drawn_path_adds_up_to_its_key() {
    let exam = load_practice(&root(), &authoring::LIGHT).expect("the exam is committed");
    let mut checked = 0;
    for asked in exam.items.iter().flat_map(|item| &item.questions) {
        let DrawingData::Paths(paths) = &asked.drawing_data else {
            continue;
        };
        let Key::Table {
            rows: ExpectedRows::Colors(rows),
            ..
        } = &asked.key
        else {
            panic!("radiance is a colour");
        };
        for (steps, row) in paths.iter().zip(rows) {
            let sum: Vec3 = steps.iter().map(|step| step.light).sum();
            let tolerance = 1e-4 * row.value.max_element();
            assert!(sum.abs_diff_eq(row.value, tolerance), "{steps:?}, {row:?}");
            checked += 1;
        }
    }
    assert!(checked > 0, "there are no paths in the exam");
}
