use glam::{Vec2, Vec3};

use super::*;

fn judge(
    hits: &[Option<Surface>],
    also: &[(u32, Option<Surface>)],
    answers: &[Outcome<Option<Trace>>],
) -> Judgement {
    let picture = FirstHits {
        hits,
        also,
        answers,
    };
    let judgement = picture.judge();
    // A mask shows what is counted, neither more nor less.
    let blemishes = picture.blemishes().expect("as many answers as rays");
    let tallies = picture.tallies();
    for (aspect, tally) in ASPECTS.iter().zip(&tallies) {
        let found = blemishes.iter().flatten();
        assert_eq!(
            found.filter(|found| found.aspect == *aspect).count(),
            tally.wrong
        );
    }
    let mut measured = picture.measure().into_iter();
    let is_right = measured.all(|measured| measured.decider().is_right());
    assert_eq!(is_right, judgement.share == Share::ALL);
    judgement
}

const WALL: Surface = Surface {
    depth: 2.0,
    normal: Vec3::Z,
    uv: Vec2::ZERO,
};

fn seen(surface: Surface) -> Outcome<Option<Trace>> {
    Outcome::Value(Some(Trace {
        distance: surface.depth,
        position: Vec3::ZERO,
        normal: surface.normal,
        uv: surface.uv,
        origin: Vec3::ZERO,
        material: 0,
    }))
}

/// A hundred positions, of which the first half is a wall.
fn key() -> Vec<Option<Surface>> {
    (0..100).map(|i| (i < 50).then_some(WALL)).collect()
}

fn answers(at_wall: Outcome<Option<Trace>>) -> Vec<Outcome<Option<Trace>>> {
    let answer = |i| {
        if i < 50 {
            at_wall.clone()
        } else {
            Outcome::Value(None)
        }
    };
    (0..100).map(answer).collect()
}

#[test]
fn the_right_picture_earns_everything() {
    let judgement = judge(&key(), &[], &answers(seen(WALL)));
    assert_eq!(judgement.share, Share::ALL);
    assert_eq!(judgement.failure, None);
}

#[test]
fn a_wrong_normal_costs_normal_and_what_is_judged_after_it() {
    let flipped = Surface {
        normal: -WALL.normal,
        ..WALL
    };
    let judgement = judge(&key(), &[], &answers(seen(flipped)));
    assert_eq!(judgement.share.of(10), 7);
    let failure = judgement.failure.expect("it is wrong");
    assert!(matches!(failure.how, How::Wrong { what, .. } if what == "normal"));
    assert_eq!(failure.count, Some((50, 50)));
}

#[test]
fn hitting_nothing_or_everything_earns_nothing() {
    let nothing = vec![Outcome::Value(None); 100];
    assert_eq!(judge(&key(), &[], &nothing).share, Share::NONE);
    let everything = vec![seen(WALL); 100];
    assert_eq!(judge(&key(), &[], &everything).share.of(100), 60);
    let elsewhere = vec![seen(Surface { depth: 9.0, ..WALL }); 100];
    assert_eq!(judge(&key(), &[], &elsewhere).share, Share::NONE);
}

#[test]
fn at_an_edge_either_answer_is_right() {
    let mut got = answers(seen(WALL));
    for answer in &mut got[..3] {
        *answer = Outcome::Value(None);
    }
    assert!(judge(&key(), &[], &got).share < Share::ALL);
    let also = [(0, None), (1, None), (2, None)];
    assert_eq!(judge(&key(), &also, &got).share, Share::ALL);
}

#[test]
fn an_edge_counts_in_any_order_and_after_one_without_an_answer() {
    let mut got = answers(seen(WALL));
    got[0] = Outcome::GivenUp;
    got[1] = Outcome::Value(None);
    got[2] = Outcome::Value(None);
    let picture = FirstHits {
        hits: &key(),
        also: &[(2, None), (0, None), (1, None)],
        answers: &got,
    };
    let [hit_or_miss, ..] = picture.tallies();
    assert_eq!((hit_or_miss.wrong, hit_or_miss.first_wrong), (1, Some(0)));
}

#[test]
fn not_a_number_is_wrong() {
    let nan = Surface {
        depth: f32::NAN,
        ..WALL
    };
    assert_eq!(judge(&key(), &[], &answers(seen(nan))).share.of(100), 40);
}
