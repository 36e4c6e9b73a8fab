//! The error in a single element, in words. This description doesn't affect points.

use protocol::Answer;

use super::{Deviation, FailureKind, Measurement, judge, measure, mismatches};
use crate::exam::ExamQuestion;

/// Describes the error in the answer to one element and the size of the error, such as "distance;
/// the error is 12 times the tolerance". Returns `None` if the answer is correct.
///
/// # Panics
///
/// If the element doesn't exist.
pub fn element_error(question: &ExamQuestion, answer: &Answer, element: usize) -> Option<String> {
    let Some(answer) = answer.single(element) else {
        return Some("there is no answer".to_owned());
    };
    let question = question.single(element);
    // A picture passes with a few wrong positions, but this position should be reported if it is
    // wrong.
    if let Some(mismatches) = mismatches(&question, &answer) {
        let mismatch = mismatches.into_iter().flatten().next()?;
        let what = mismatch.aspect.name();
        return Some(with_size(what, mismatch.deviation));
    }
    Some(match judge(&question, &answer).failure?.kind {
        FailureKind::Wrong {
            what, got, wanted, ..
        } if matches!(answer, Answer::Tree(_)) => {
            format!("{what}: {got}; wanted: {wanted}")
        }
        FailureKind::Wrong { what, .. } => {
            let measured = measure(&question, &answer).into_iter();
            let deviations = measured.map(Measurement::deciding_deviation);
            let sizes = deviations.filter(|deviation| deviation.threshold.is_some());
            let largest = sizes
                .map(|Deviation { value, .. }| value)
                .fold(0.0, f64::max);
            with_size(&what, largest)
        }
        FailureKind::Uneven { .. } => "unevenly spread".to_owned(),
        FailureKind::Panicked(panic) if panic.is_unimplemented() => "not written yet".to_owned(),
        FailureKind::Panicked(_) => "a panic".to_owned(),
        FailureKind::Protocol(why) => why,
    })
}

/// Appends the size of the error, if any.
fn with_size(what: &str, deviation: f64) -> String {
    if !(deviation > 1.0 && deviation.is_finite()) {
        return what.to_owned();
    }
    let times = match deviation {
        1e6.. => format!("{deviation:.0e}"),
        10.0.. => format!("{deviation:.0}"),
        _ => format!("{deviation:.1}"),
    };
    format!("{what}; the error is {times} times the tolerance")
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};
    use protocol::{ElementOutcome, Geometry, Question, Ray, Trace};

    use super::*;
    use crate::exam::{ExpectedRows, Key, Surface};
    use crate::judge::tree::tests::{ALL_CHECKS, row, valid_tree};
    use crate::tests::{HIT, sphere};

    fn question(key: Key) -> ExamQuestion {
        let ray = |x| Ray::new(Vec3::new(x, 0.0, 0.0), Vec3::NEG_Z);
        let shapes = vec![sphere(Vec3::NEG_Z * 3.0, 1.0)];
        let question = Question::hits(Geometry::List { shapes }, vec![ray(5.0), ray(0.0)]);
        ExamQuestion::new(question, key)
    }

    fn hit(distance: f32) -> Trace {
        Trace {
            distance,
            normal: Vec3::Z,
            ..HIT
        }
    }

    /// Returns a miss followed by a hit at this distance.
    fn answer(distance: f32) -> Answer {
        Answer::Hits(vec![
            ElementOutcome::Value(None),
            ElementOutcome::Value(Some(hit(distance))),
        ])
    }

    #[test]
    fn names_the_quantity_and_the_size_of_the_error_in_a_table() {
        let hits = ExpectedRows::Hits(vec![None, Some(hit(2.0))]);
        let question = question(Key::table(&["distance"], hits));
        assert_eq!(element_error(&question, &answer(2.0), 1), None);
        let error = element_error(&question, &answer(2.002), 1).expect("this is wrong");
        assert!(error.starts_with("distance; the error is "), "{error}");
        // This error doesn't affect the other element, which is correct.
        assert_eq!(element_error(&question, &answer(2.002), 0), None);
        let none = Answer::Hits(Vec::new());
        let error = element_error(&question, &none, 1);
        assert_eq!(error.as_deref(), Some("there is no answer"));
    }

    /// Returns a picture whose two rays both hit a wall. At the position `alternative`, a miss is
    /// correct too.
    fn picture_of_a_wall(alternative: u32) -> ExamQuestion {
        let wall = Surface {
            depth: 2.0,
            normal: Vec3::Z,
            uv: Vec2::ZERO,
        };
        question(Key::FirstHits {
            hits: vec![Some(wall), Some(wall)],
            alternatives: vec![(alternative, None)],
        })
    }

    #[test]
    fn one_wrong_position_of_a_picture_is_an_error() {
        let question = picture_of_a_wall(0);
        assert_eq!(element_error(&question, &answer(2.0), 0), None);
        assert_eq!(element_error(&question, &answer(2.0), 1), None);
        let error = element_error(&question, &answer(4.0), 1).expect("this is wrong");
        assert!(error.starts_with("depth; the error is "), "{error}");
    }

    #[test]
    fn an_alternative_is_one_only_at_its_position() {
        let question = picture_of_a_wall(1);
        let error = element_error(&question, &answer(2.0), 0);
        assert_eq!(error.as_deref(), Some("hit or miss"));
    }

    #[test]
    fn the_defect_of_a_tree_is_named_as_it_was_found() {
        let question = ExamQuestion::tree(row(4), 2, &ALL_CHECKS, None);
        let mut tree = valid_tree();
        tree.order.swap(0, 1);
        tree.order[3] = 0;
        let error = element_error(&question, &Answer::Tree(ElementOutcome::Value(tree)), 0);
        let error = error.expect("a primitive is in two leaves");
        assert!(error.contains("; wanted: "), "{error}");
    }

    #[test]
    fn only_an_error_beyond_the_tolerance_has_a_size() {
        for (deviation, expected) in [
            (0.5, "uv"),
            (1.0, "uv"),
            (f64::INFINITY, "uv"),
            (f64::NAN, "uv"),
            (1.25, "uv; the error is 1.2 times the tolerance"),
            (12.3, "uv; the error is 12 times the tolerance"),
            (3e6, "uv; the error is 3e6 times the tolerance"),
        ] {
            assert_eq!(with_size("uv", deviation), expected);
        }
    }
}
