//! Tests of exams as data: the numbering of elements, rejected exams, and the mistake behind an
//! answer.

use std::collections::BTreeSet;
use std::path::Path;

use crate::assignment::{RAYS, Task};
use crate::exam::{Exam, ExamQuestion, ExpectedRows, Key};
use crate::exam_file;
use crate::judge::{Failure, judge};
use crate::recognise::Observations;
use crate::signatures::{MistakeSignatures, ObservedAnswer};
use glam::Vec3;
use protocol::{Answer, ElementOutcome, Interval, Question, Ray, Rows};
use serde_json::{Value, json};

use super::{EXAM, PART};

fn parse(text: &str) -> Result<Exam, String> {
    let file = exam_file::parse(Path::new("exam.json"), text.as_bytes(), &RAYS);
    file.map(|file| file.exam)
        .map_err(|error| error.to_string())
}

/// Returns the problem found in a changed copy of an exam, if any.
fn problem_after(exam: &Exam, change: impl FnOnce(&mut Exam)) -> Option<String> {
    let mut exam = exam.clone();
    change(&mut exam);
    parse(&serde_json::to_string(&exam).unwrap()).err()
}

fn index_of(exam: &Exam, id: &str) -> usize {
    exam.items.iter().position(|item| item.id == id).unwrap()
}

/// Returns a camera's answer to a question about rays. `change` computes each ray's direction from
/// the ray's index and the correct direction.
fn camera_answer(question: &ExamQuestion, change: impl Fn(usize, Vec3) -> Vec3) -> Answer {
    let Key::Table {
        rows: ExpectedRows::Rays(directions),
        ..
    } = &question.key
    else {
        panic!("the camera is asked for rays, not for {:?}", question.key);
    };
    let rays = directions.iter().enumerate().map(|(index, &dir)| Ray {
        origin: Vec3::ZERO,
        dir: change(index, dir),
        range: Interval::AHEAD,
    });
    Answer::Rays(rays.map(ElementOutcome::Value).collect())
}

#[test]
fn the_elements_of_an_item_are_numbered_without_gaps() {
    for item in &EXAM.items {
        let counts = item
            .questions
            .iter()
            .map(|question| question.question.count());
        let all = counts.clone().enumerate();
        let all =
            all.flat_map(|(question, count)| (0..count).map(move |element| (question, element)));
        assert_eq!(item.count(), counts.sum::<usize>());
        for (number, (question, element)) in (1..).zip(all) {
            assert_eq!(
                item.element(number),
                Some((question, element)),
                "{}",
                item.id
            );
            assert_eq!(item.number(question, element), number, "{}", item.id);
        }
        assert_eq!(item.element(0), None);
        assert_eq!(item.element(item.count() + 1), None);
        let last = item.questions.len() - 1;
        assert_eq!(
            item.number(last, usize::MAX),
            item.count(),
            "of a picture's pixels"
        );
    }
}

#[test]
fn tasks_are_found_by_their_ids_and_those_of_their_items() {
    for (index, task) in RAYS.tasks.iter().enumerate() {
        let found = RAYS.find(task.id).unwrap();
        assert_eq!(found.title, task.title);
        assert_eq!(Task::in_id(&format!("{}.any", task.id)), Some(task.task()));
        assert_eq!(RAYS.id_list().split(", ").nth(index), Some(task.id));
    }
    assert_eq!(RAYS.find("light").map(|task| task.id), None);
    assert_eq!(Task::in_id("sphere"), None);
    assert_eq!(
        Task::in_id("light.any").as_ref().map(Task::id),
        Some("light")
    );
}

#[test]
fn a_part_of_the_exam_has_the_items_that_it_needs() {
    let mut items = EXAM.items.iter();
    let item = items.find(|item| !item.needs.is_empty()).unwrap();
    let part = EXAM.with_needed_items(|other| other.id == item.id);
    let ids: BTreeSet<&str> = part.items.iter().map(|item| item.id.as_str()).collect();
    let needed = item.needs.iter().chain([&item.id]);
    assert_eq!(ids, needed.map(String::as_str).collect());
}

#[test]
fn an_exam_is_read_as_it_was_written() {
    let text = serde_json::to_string(&*PART).unwrap();
    assert_eq!(serde_json::to_string(&parse(&text).unwrap()).unwrap(), text);
    let problem = problem_after(&PART, |exam| exam.assignment = "light".to_owned());
    assert!(problem.unwrap().contains("for the assignment `light`"));
}

#[test]
fn an_exam_in_another_format_is_refused_for_its_format_and_not_for_its_fields() {
    let problem = |schema| parse(&format!(r#"{{"schema": {schema}, "ideas": []}}"#)).unwrap_err();
    let other = problem("2");
    assert!(other.contains("its format is version 2, but"), "{other}");
    assert!(other.ends_with("`cargo author exam --seed S` writes a valid one"));
    assert!(problem("3").contains("unknown field `ideas`"));
}

#[test]
fn an_exam_that_cannot_be_asked_or_judged_is_refused() {
    let ids = ["camera.corners", "camera.picture", "sphere.near_side"];
    // Unlike in `PART`, the picture has all of its rays here: as many as a film with the maximum
    // width and a height of 1 would have.
    let items = EXAM.items.iter();
    let items = items.filter(|item| ids.contains(&item.id.as_str()));
    let exam = Exam {
        items: items.cloned().collect(),
        ..PART.clone()
    };
    let [camera, picture, sphere] = ids.map(|id| index_of(&exam, id));
    let exam = serde_json::to_value(exam).unwrap();
    let item = |path: &str| format!("/items/{camera}/{path}");
    for (path, value, problem) in [
        ("/schema".to_owned(), json!(99), "its format is version 99"),
        ("/items".to_owned(), json!([]), "it has no items"),
        (
            item("id"),
            json!("sphere.corners"),
            "does not start with `camera.`",
        ),
        (
            item("task"),
            json!("light"),
            "unknown task `light`; the tasks are camera",
        ),
        (item("points"), json!(0), "no points or no questions"),
        (item("questions"), json!([]), "no points or no questions"),
        (
            item("needs"),
            json!(["sphere.near_side"]),
            "which must come before it",
        ),
        (
            format!("/items/{picture}/id"),
            json!("camera.corners"),
            "another item has the same id",
        ),
        (
            format!("/items/{picture}/questions/0/question/sample_ray/rows/picture"),
            json!([100_000, 2]),
            "asks for 100000 x 2 pixels",
        ),
        (
            format!("/items/{picture}/questions/0/question/sample_ray/rows/picture"),
            json!([4097, 1]),
            "asks for 4097 x 1 pixels; the maximum is 4096",
        ),
        (
            format!("/items/{sphere}/questions/0/key"),
            exam["items"][camera]["questions"][0]["key"].clone(),
            "a key for a different kind of question",
        ),
        (
            item("questions/0/key"),
            exam["items"][picture]["questions"][0]["key"].clone(),
            "elements, but its key has",
        ),
    ] {
        let mut changed = exam.clone();
        let (around, key) = path.rsplit_once('/').unwrap();
        let around = changed.pointer_mut(around);
        let around = around.unwrap_or_else(|| panic!("the exam has no {path}"));
        if let Value::Array(list) = around {
            list[key.parse::<usize>().unwrap()] = value;
        } else {
            around[key] = value;
        }
        let error = parse(&changed.to_string()).map(drop).unwrap_err();
        assert!(error.contains(problem), "{path}: {error}");
    }
    let mut largest = exam;
    largest["items"][picture]["questions"][0]["question"]["sample_ray"]["rows"]["picture"] =
        json!([4096, 1]);
    parse(&largest.to_string()).map(drop).unwrap();
}

#[test]
fn signatures_that_refer_to_nothing_are_refused() {
    let position = index_of(&EXAM, "camera.corners");
    let problem_after = |change: &dyn Fn(&mut MistakeSignatures)| {
        problem_after(&EXAM, |exam| change(&mut exam.items[position].signatures))
    };
    assert_eq!(problem_after(&|_| ()), None);
    let elements = EXAM.items[position].count() as u32;
    let mistakes = EXAM.mistakes.len() as u32;
    let changes: [&dyn Fn(&mut MistakeSignatures); 4] = [
        &|signatures| signatures.elements[0] = elements,
        &|signatures| drop(signatures.correct_answers.pop()),
        &|signatures| signatures.mistake_answers[0].mistakes.push(mistakes),
        &|signatures| {
            let no_element = (signatures.elements.len() as u32, ObservedAnswer::NoHit);
            signatures.mistake_answers[0].answers.push(no_element);
        },
    ];
    for change in changes {
        let problem = problem_after(change).unwrap_or_default();
        assert!(problem.contains("signatures refer to"), "{problem}");
    }
}

#[test]
fn a_key_of_first_hits_fits_only_the_rays_of_a_view() {
    let problem_after = |change: fn(&mut ExamQuestion)| {
        problem_after(&PART, |exam| {
            let mut questions = exam.items.iter_mut().flat_map(|item| &mut item.questions);
            let has_first_hits =
                |asked: &&mut ExamQuestion| matches!(asked.key, Key::FirstHits { .. });
            change(questions.find(has_first_hits).unwrap());
        })
    };
    fn add_alternative(question: &mut ExamQuestion, after_the_last: u32) {
        if let Key::FirstHits { hits, alternatives } = &mut question.key {
            alternatives.push((hits.len() as u32 - 1 + after_the_last, None));
        }
    }
    assert_eq!(problem_after(|question| add_alternative(question, 0)), None);
    for change in [
        |question: &mut ExamQuestion| add_alternative(question, 1),
        |question: &mut ExamQuestion| {
            if let Question::Hit(table) = &mut question.question {
                table.rows = Rows::List(table.rows.to_vec().into_owned());
            }
        },
    ] {
        let problem = problem_after(change).unwrap_or_default();
        assert!(
            problem.contains("a key for a different kind of question"),
            "{problem}"
        );
    }
}

/// Returns the observed answers of a camera that changes each correct direction with `change`.
fn camera_answers(exam: &Exam, change: impl Fn(Vec3) -> Vec3) -> Observations {
    let mut observations = Observations::default();
    for item in exam.items.iter().filter(|item| item.task.id() == "camera") {
        let answer = |question| camera_answer(question, |_, dir| change(dir));
        let answers: Vec<Answer> = item.questions.iter().map(answer).collect();
        observations.record(item, Ok(&answers));
    }
    observations
}

#[test]
fn a_known_mistake_is_recognised_by_its_answers_and_right_answers_have_none() {
    let flipped = camera_answers(&EXAM, |dir| Vec3::new(dir.x, -dir.y, dir.z));
    let mirrored = camera_answers(&EXAM, |dir| Vec3::new(-dir.x, dir.y, dir.z));
    let right = camera_answers(&EXAM, |dir| dir);
    let item = &EXAM.items[index_of(&EXAM, "camera.corners")];
    let explain = |observations: &Observations| -> Vec<String> {
        let mistakes = observations.explain(&EXAM, item);
        mistakes.iter().map(|mistake| mistake.id.clone()).collect()
    };
    assert_eq!(explain(&flipped), ["camera.upside_down"]);
    assert_eq!(explain(&mirrored), ["camera.mirrored"]);
    assert_eq!(explain(&right), [""; 0]);
}

#[test]
fn a_failure_counts_all_wrong_elements_and_names_the_first() {
    let item = &EXAM.items[index_of(&EXAM, "camera.corners")];
    let question = &item.questions[0];
    let turned = |index, dir: Vec3| if [1, 3].contains(&index) { -dir } else { dir };
    let failure = judge(question, &camera_answer(question, turned)).failure;
    let Some(Failure { element, count, .. }) = failure else {
        panic!("two rays are wrong");
    };
    assert_eq!((element, count), (1, Some((2, question.question.count()))));
}

#[test]
fn an_exam_file_names_its_assignment_even_if_it_is_not_valid() {
    let id = |text: &str| exam_file::assignment_id(text.as_bytes());
    let other = r#"{"schema": 1, "assignment": "light", "pages": []}"#;
    assert_eq!(id(other).as_deref(), Some("light"));
    assert_eq!(id(r#"{"schema": 2}"#), None);
    assert_eq!(id("[]"), None);
}
