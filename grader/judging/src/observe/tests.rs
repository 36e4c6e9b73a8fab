//! Tests of observed numbers: they are multiples of the tolerances of their own question.

use glam::{Vec2, Vec3};

use super::*;
use crate::exam::ExpectedHit;
use crate::judge::measure::{DIRECTION, LENGTH, UV};
use crate::tests::{EXPECTED, HIT, sphere};

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

/// Asserts that each number of the wrong answer is six tolerances from that of the correct one, which is
/// observed as the key says.
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

/// The tolerance of each element is that of its own ray: the second one begins a hundred times farther
/// away.
#[test]
fn distances_are_multiples_of_the_tolerance_of_their_ray() {
    let ray = |x: f32| Ray::new(Vec3::new(x, 0.0, 0.0), -Vec3::X);
    let (near, far) = (8.0, 800.0);
    let hit = |distance: f32| ExpectedHit {
        distance,
        ..EXPECTED
    };
    let question = ExamQuestion::new(
        Question::Shapes {
            shapes: vec![sphere(Vec3::ZERO, 1.0)],
            rays: Rays::List(vec![ray(near), ray(far)]),
        },
        Key::Hits {
            checks: vec![HitCheck::Distance],
            hits: vec![Some(hit(near - 1.0)), Some(hit(far - 1.0))],
        },
    );
    let answer = |tolerances: f32| {
        let trace = |from: f32| Trace {
            distance: from - 1.0 + tolerances * LENGTH * from,
            origin: Vec3::X * from,
            ..HIT
        };
        let traces = [near, far].map(|from| ElementOutcome::Value(Some(trace(from))));
        Answer::Hits(traces.to_vec())
    };
    assert_six_apart(&question, &answer(6.0), &answer(0.0));
}

#[test]
fn times_in_a_box_are_multiples_of_the_tolerance_of_their_ray() {
    let (near, far) = (8.0, 800.0);
    let query = |x: f32| (Ray::new(Vec3::new(x, 0.0, 0.0), -Vec3::X), Interval::AHEAD);
    let span = |from: f32, error: f32| Interval::new(from - 1.0 + error, from + 1.0 + error);
    let question = ExamQuestion::new(
        Question::BBox {
            min: -Vec3::ONE,
            max: Vec3::ONE,
            queries: vec![query(near), query(far)],
        },
        Key::Spans {
            spans: vec![Some(span(near, 0.0)), Some(span(far, 0.0))],
        },
    );
    let answer = |tolerances: f32| {
        let spans = [near, far].map(|from| Some(span(from, tolerances * LENGTH * from)));
        Answer::Spans(spans.map(ElementOutcome::Value).to_vec())
    };
    assert_six_apart(&question, &answer(6.0), &answer(0.0));
}

#[test]
fn each_material_is_far_from_the_others() {
    let of = |material| {
        let trace = Trace { material, ..HIT };
        observe_checked(&[HitCheck::Material], Some(&trace), 1.0)
    };
    assert!(of(1).matches(&of(1)));
    assert!(!of(1).matches(&of(2)));
}

#[test]
fn uv_is_a_multiple_of_its_tolerance_and_a_direction_has_length_one() {
    let uv = Vec2::new(3.0 * UV, 0.5);
    let uv = observe_checked(&[HitCheck::Uv], Some(&Trace { uv, ..HIT }), 1.0);
    assert_eq!(uv, ObservedAnswer::Numbers(vec![3.0, 0.5 / UV]));
    let direction = |dir| observe_ray(&[RayCheck::Direction], &expected_ray(dir));
    let unit = ObservedAnswer::Numbers(vec![0.0, 0.0, 1.0 / DIRECTION]);
    assert_eq!(direction(Vec3::Z), unit);
    assert_eq!(direction(4.0 * Vec3::Z), unit);
}

/// A normal that is computed from a wrong position has length one only if it is normalised, and both are
/// usual. Which distance it belongs to is the same in both.
#[test]
fn what_follows_from_a_wrong_distance_is_not_observed() {
    let checks = [HitCheck::Normal, HitCheck::UnitNormal];
    let expected = HIT;
    let of = |trace: &Trace, expected| observe_hit(&checks, Some(trace), expected, 1.0);
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

    // Right normals are right, whatever the distance is, and wrong ones at the right distance differ.
    let right = of(&expected, Some(&expected));
    assert!(of(&farther(expected.normal), Some(&expected)).matches(&right));
    let at_right_distance = |normal| Trace { normal, ..expected };
    let [one, other] = [Vec3::Y * 1.5, Vec3::Y].map(at_right_distance);
    assert!(!of(&one, Some(&expected)).matches(&of(&other, Some(&expected))));
}

#[test]
fn a_question_whose_numbers_are_all_0_has_a_tolerance() {
    assert_eq!(lengths_in_tolerances(&[0.0, -0.0], 0.0), [0.0, 0.0]);
}
