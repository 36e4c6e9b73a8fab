//! Tests of observed numbers: they are multiples of the tolerances of their own question.

use glam::{Vec2, Vec3};
use protocol::Shape;

use super::*;
use crate::exam::ExpectedHit;
use crate::judge::measure::{DIRECTION, LENGTH, UV};

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

/// Asserts that each number of the wrong answers differs from the correct one by this many tolerances.
fn assert_tolerances_apart(wrong: &[Vec<f32>], correct: &[Vec<f32>], expected: f32) {
    assert_eq!(wrong.len(), 2, "one entry for each element");
    assert!(wrong.iter().all(|numbers| !numbers.is_empty()));
    let pairs = wrong.iter().flatten().zip(correct.iter().flatten());
    for (wrong, correct) in pairs {
        let tolerances = wrong - correct;
        assert!(
            (tolerances - expected).abs() < 0.1,
            "{tolerances} tolerances, not {expected}"
        );
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
        position: Vec3::X,
        normal: Vec3::X,
        uv: Vec2::ZERO,
        material: 0,
    };
    let question = ExamQuestion::new(
        Question::Shapes {
            shapes: vec![Shape::Sphere {
                center: Vec3::ZERO,
                radius: 1.0,
                material: 0,
            }],
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
            position: Vec3::X,
            normal: Vec3::X,
            uv: Vec2::ZERO,
            origin: Vec3::X * from,
            material: 0,
        };
        let traces = [near, far].map(|from| ElementOutcome::Value(Some(trace(from))));
        Answer::Hits(traces.to_vec())
    };
    let correct = numbers(&question, &answer(0.0));
    assert_tolerances_apart(&numbers(&question, &answer(6.0)), &correct, 6.0);
    let expected = expected_elements(&question);
    assert_eq!(expected, observe_question(&question, &answer(0.0)));
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
    let correct = numbers(&question, &answer(0.0));
    assert_tolerances_apart(&numbers(&question, &answer(6.0)), &correct, 6.0);
    let expected = expected_elements(&question);
    assert_eq!(expected, observe_question(&question, &answer(0.0)));
}

/// Returns a hit at the origin with this uv and material.
fn trace(uv: Vec2, material: u32) -> Trace {
    Trace {
        distance: 1.0,
        position: Vec3::X,
        normal: Vec3::X,
        uv,
        origin: Vec3::ZERO,
        material,
    }
}

#[test]
fn each_material_is_far_from_the_others() {
    let of = |material| {
        observe_checked(
            &[HitCheck::Material],
            Some(&trace(Vec2::ZERO, material)),
            1.0,
        )
    };
    assert!(of(1).matches(&of(1)));
    assert!(!of(1).matches(&of(2)));
}

#[test]
fn uv_is_a_multiple_of_its_tolerance_and_a_direction_has_length_one() {
    let uv = observe_checked(
        &[HitCheck::Uv],
        Some(&trace(Vec2::new(3.0 * UV, 0.5), 0)),
        1.0,
    );
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
    let expected = trace(Vec2::ZERO, 0);
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
