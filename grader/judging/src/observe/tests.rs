//! Tests of observed numbers, which are multiples of their own question's tolerances.

use glam::{Vec2, Vec3};
use protocol::{Fields, Geometry, Interval, Question, Ray, Trace};

use super::*;
use crate::exam::ExpectedRows;
use crate::tests::{HIT, boxes, sphere};
use crate::types::direction::TOLERANCE as DIRECTION;
use crate::types::length::TOLERANCE as LENGTH;
use crate::types::uv::TOLERANCE as UV;

/// Returns the observed numbers of each element of one question.
fn numbers(question: &ExamQuestion, answer: &Answer) -> Vec<Vec<f32>> {
    let observed = observe_question(question, answer).into_iter();
    let numbers = observed.map(|answer| {
        let ObservedAnswer::Numbers(numbers) = answer else {
            panic!("there are no numbers in {answer:?}");
        };
        numbers
    });
    numbers.collect()
}

/// Asserts that each number in the wrong answer is six tolerances away from the corresponding
/// number in the correct answer, and that the correct answer is observed as the key predicts.
fn assert_six_apart(question: &ExamQuestion, wrong: &Answer, correct: &Answer) {
    assert_eq!(
        expected_elements(question),
        observe_question(question, correct)
    );
    let (wrong, correct) = (numbers(question, wrong), numbers(question, correct));
    assert_eq!(wrong.len(), 2, "one entry for each element");
    assert!(wrong.iter().all(|numbers| !numbers.is_empty()));
    for (wrong, correct) in wrong.iter().flatten().zip(correct.iter().flatten()) {
        assert!((wrong - correct - 6.0).abs() < 0.1, "{wrong} and {correct}");
    }
}

/// Each element has the tolerance of its own ray. The second ray starts a hundred times farther
/// away than the first.
#[test]
fn distances_are_multiples_of_the_tolerance_of_their_ray() {
    let ray = |x: f32| Ray::new(Vec3::new(x, 0.0, 0.0), -Vec3::X);
    let (near, far) = (8.0, 800.0);
    let traces = |tolerances: f32| {
        [near, far].map(|from| {
            Some(Trace {
                distance: from - 1.0 + tolerances * LENGTH * from,
                origin: Vec3::X * from,
                ..HIT
            })
        })
    };
    let shapes = vec![sphere(Vec3::ZERO, 1.0)];
    let hits = ExpectedRows::Hits(traces(0.0).to_vec());
    let question = ExamQuestion::new(
        Question::hits(Geometry::List { shapes }, vec![ray(near), ray(far)]),
        Key::table(&["distance"], hits),
    );
    let answer =
        |tolerances: f32| Answer::Hits(traces(tolerances).map(ElementOutcome::Value).to_vec());
    assert_six_apart(&question, &answer(6.0), &answer(0.0));
}

#[test]
fn times_in_a_box_are_multiples_of_the_tolerance_of_their_ray() {
    let (near, far) = (8.0, 800.0);
    let rays = [near, far].map(|x| Ray::new(Vec3::new(x, 0.0, 0.0), -Vec3::X));
    let span = |from: f32, error: f32| Interval::new(from - 1.0 + error, from + 1.0 + error);
    let question = ExamQuestion::new(
        boxes(-Vec3::ONE, Vec3::ONE, &rays),
        Key::spans(vec![Some(span(near, 0.0)), Some(span(far, 0.0))]),
    );
    let answer = |tolerances: f32| {
        let spans = [near, far].map(|from| Some(span(from, tolerances * LENGTH * from)));
        Answer::Spans(spans.map(ElementOutcome::Value).to_vec())
    };
    assert_six_apart(&question, &answer(6.0), &answer(0.0));
}

/// Observes one quantity in a record, for a question whose scale is 1.
fn observe_one(quantity: &str, record: &(impl Fields + Copy)) -> ObservedAnswer {
    let names = record.names();
    let quantity = Quantity::named(quantity, names).expect("the record has this field");
    observe_record(&[quantity], Some(record), 1.0)
}

#[test]
fn each_material_is_far_from_the_others() {
    let of = |shape| observe_one("shape", &Trace { shape, ..HIT });
    assert!(of(1).matches(&of(1)));
    assert!(!of(1).matches(&of(2)));
}

#[test]
fn uv_is_a_multiple_of_its_tolerance_and_a_direction_has_length_one() {
    let uv = Vec2::new(3.0 * UV, 0.5);
    let uv = observe_one("uv", &Trace { uv, ..HIT });
    assert_eq!(uv, ObservedAnswer::Numbers(vec![3.0, 0.5 / UV]));
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    let direction = |dir| observe_one("direction", &Ray { dir, ..ray });
    let unit = ObservedAnswer::Numbers(vec![0.0, 0.0, 1.0 / DIRECTION]);
    assert_eq!(direction(Vec3::Z), unit);
    assert_eq!(direction(4.0 * Vec3::Z), unit);
}

/// A normal that is computed from a wrong position only has length one if the code normalises it.
/// Some code does this and some doesn't, but the wrong distance is the same in both cases.
#[test]
fn what_follows_from_a_wrong_distance_is_not_observed() {
    let expected = HIT;
    let judged = ["normal", "unit_normal"];
    let judged = judged.map(|name| Quantity::named(name, expected.names()).unwrap());
    let of = |trace: &Trace, expected: Option<&Trace>| {
        let row = Row {
            got: Some(trace),
            wanted: expected.map(|trace| Box::new(*trace) as Box<dyn Record>),
            scale: 1.0,
        };
        observe_row(&judged, &row)
    };
    let farther = |normal| Trace {
        distance: 1.5,
        normal,
        ..expected
    };
    let (scaled, unit) = (farther(Vec3::Y * 1.5), farther(Vec3::Y));
    for expected in [Some(&expected), None] {
        assert!(of(&scaled, expected).matches(&of(&unit, expected)));
    }
    let even_farther = Trace {
        distance: 2.0,
        ..unit
    };
    let wrong = [
        of(&unit, Some(&expected)),
        of(&even_farther, Some(&expected)),
    ];
    assert!(!wrong[0].matches(&wrong[1]));

    // A correct normal is observed as correct at any distance. At the correct distance, different
    // wrong normals lead to different observations.
    let right = of(&expected, Some(&expected));
    assert!(of(&farther(expected.normal), Some(&expected)).matches(&right));
    let at_right_distance = |normal| Trace { normal, ..expected };
    let [one, other] = [Vec3::Y * 1.5, Vec3::Y].map(at_right_distance);
    assert!(!of(&one, Some(&expected)).matches(&of(&other, Some(&expected))));
}
