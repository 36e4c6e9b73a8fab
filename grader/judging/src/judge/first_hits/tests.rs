use glam::{Vec2, Vec3};

use super::*;
use crate::judge::Mismatch;
use crate::tests::HIT;

fn judge(
    hits: &[Option<Surface>],
    alternatives: &[(u32, Option<Surface>)],
    answers: &[ElementOutcome<Option<Trace>>],
) -> Judgement {
    let picture = FirstHits {
        scale: 1.0,
        hits,
        alternatives,
        answers,
    };
    let judgement = picture.judge();
    // A mask should show exactly the wrong positions that cost points.
    let positions = picture.positions();
    let positions = positions.expect("there are as many answers as rays");
    let mismatches: Vec<_> = positions.iter().map(Mismatch::first_at).collect();
    let tallies = picture.tallies();
    for ((aspect, _), tally) in QUANTITIES.iter().zip(&tallies) {
        let found = mismatches.iter().flatten();
        assert_eq!(
            found.filter(|found| found.aspect == *aspect).count(),
            tally.wrong
        );
    }
    let mut measured = picture.measure().into_iter();
    let is_right = measured.all(|measured| measured.deciding_deviation().is_right());
    assert_eq!(is_right, judgement.credit == Credit::FULL);
    judgement
}

const WALL: Surface = Surface {
    depth: 2.0,
    normal: Vec3::Z,
    uv: Vec2::ZERO,
};

fn answer_of(surface: Surface) -> ElementOutcome<Option<Trace>> {
    ElementOutcome::Value(Some(Trace {
        distance: surface.depth,
        normal: surface.normal,
        uv: surface.uv,
        ..HIT
    }))
}

/// Returns a key with a hundred positions. The first half show a wall.
fn key() -> Vec<Option<Surface>> {
    (0..100).map(|i| (i < 50).then_some(WALL)).collect()
}

fn answers(at_wall: ElementOutcome<Option<Trace>>) -> Vec<ElementOutcome<Option<Trace>>> {
    let elsewhere = vec![ElementOutcome::Value(None); 50];
    [vec![at_wall; 50], elsewhere].concat()
}

#[test]
fn a_correct_picture_earns_full_credit() {
    let judgement = judge(&key(), &[], &answers(answer_of(WALL)));
    assert_eq!(judgement.credit, Credit::FULL);
    assert_eq!(judgement.failure, None);
}

#[test]
fn wrong_normals_cost_the_normal_and_uv_credit() {
    let flipped = Surface {
        normal: -WALL.normal,
        ..WALL
    };
    let judgement = judge(&key(), &[], &answers(answer_of(flipped)));
    assert_eq!(judgement.credit.apply(10), 7);
    let failure = judgement.failure.expect("the normals are wrong");
    assert!(matches!(failure.kind, FailureKind::Wrong { what, .. } if what == "normal"));
    assert_eq!(failure.count, Some((50, 50)));
}

#[test]
fn a_wrong_quantity_is_shown_with_its_own_numbers() {
    let shown = |surface: Surface| {
        let failure = judge(&key(), &[], &answers(answer_of(surface))).failure;
        match failure.expect("it is wrong").kind {
            FailureKind::Wrong {
                what, got, wanted, ..
            } => [what, got, wanted],
            FailureKind::Uneven { .. } | FailureKind::Panicked(_) | FailureKind::Protocol(_) => {
                panic!("there is an answer")
            }
        }
    };
    let (normal, uv) = (Vec3::X, Vec2::new(0.25, 0.75));
    assert_eq!(
        shown(Surface { normal, ..WALL }),
        [
            "normal".to_owned(),
            describe::point(normal),
            describe::point(WALL.normal)
        ]
    );
    assert_eq!(
        shown(Surface { uv, ..WALL }),
        ["uv".to_owned(), describe::uv(uv), describe::uv(WALL.uv)]
    );
}

#[test]
fn a_quantity_judged_at_too_few_positions_earns_nothing() {
    let mut got = vec![ElementOutcome::Value(None); 100];
    got[..24].fill(answer_of(WALL));
    let few = judge(&key(), &[], &got);
    assert_eq!(few.credit.apply(100), 0);
    // Depth, normal and uv are judged if half of the wall is hit. Hit or miss still earns nothing.
    got[..25].fill(answer_of(WALL));
    assert_eq!(judge(&key(), &[], &got).credit.apply(100), 60);
}

#[test]
fn missing_everything_earns_nothing_and_hitting_everything_only_part() {
    let nothing = vec![ElementOutcome::Value(None); 100];
    assert_eq!(judge(&key(), &[], &nothing).credit, Credit::NONE);
    let everything = vec![answer_of(WALL); 100];
    assert_eq!(judge(&key(), &[], &everything).credit.apply(100), 60);
    let elsewhere = vec![answer_of(Surface { depth: 9.0, ..WALL }); 100];
    assert_eq!(judge(&key(), &[], &elsewhere).credit, Credit::NONE);
}

#[test]
fn either_answer_is_correct_at_an_edge() {
    let mut got = answers(answer_of(WALL));
    // One more than is tolerated.
    for answer in &mut got[..6] {
        *answer = ElementOutcome::Value(None);
    }
    assert!(judge(&key(), &[], &got).credit < Credit::FULL);
    let alternatives = [0, 1, 2, 3, 4, 5].map(|position| (position, None));
    assert_eq!(judge(&key(), &alternatives, &got).credit, Credit::FULL);
}

#[test]
fn alternatives_may_be_unsorted_and_follow_a_missing_answer() {
    let mut got = answers(answer_of(WALL));
    got[0] = ElementOutcome::Skipped;
    got[1] = ElementOutcome::Value(None);
    got[2] = ElementOutcome::Value(None);
    let picture = FirstHits {
        scale: 1.0,
        hits: &key(),
        alternatives: &[(2, None), (0, None), (1, None)],
        answers: &got,
    };
    let [hit_or_miss, ..] = picture.tallies();
    assert_eq!((hit_or_miss.wrong, hit_or_miss.first_wrong), (1, Some(0)));
}

#[test]
fn nan_depth_is_wrong() {
    let nan = Surface {
        depth: f32::NAN,
        ..WALL
    };
    let judgement = judge(&key(), &[], &answers(answer_of(nan)));
    assert_eq!(judgement.credit.apply(100), 40);
}
