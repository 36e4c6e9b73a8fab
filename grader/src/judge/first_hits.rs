//! Pictures of first hits, against a key that is a *set* at every position.
//!
//! Near an edge a last bit decides what a ray sees, and every answer that a neighbour within
//! ±5e-4 of a pixel would get is right. Leaving such positions out instead would hide cracks,
//! which are to be found nowhere else.

use std::collections::BTreeMap;

use protocol::{Outcome, Trace};

use crate::describe;
use crate::exam::Surface;
use crate::judge::measure::{same_direction, same_length, same_uv};
use crate::judge::{Failure, How, Judgement, Share};

const DEPTH: f32 = 2e-4;
const NORMAL: f32 = 5e-3;

/// What is compared, each only where the ones before it are right, with its weight in hundredths.
const QUANTITIES: [(&str, u32); 4] = [
    ("hit or miss", 40),
    ("depth", 30),
    ("normal", 20),
    ("uv", 10),
];

pub(super) fn judge(
    hits: &[Option<Surface>],
    also: &[(u32, Option<Surface>)],
    answers: &[Outcome<Option<Trace>>],
) -> Judgement {
    if answers.len() != hits.len() {
        return Judgement::protocol("another number of answers than of rays");
    }
    let mut others: BTreeMap<usize, Vec<Option<Surface>>> = BTreeMap::new();
    for (position, answer) in also {
        others.entry(*position as usize).or_default().push(*answer);
    }

    // How many quantities are right at each position, in order; a true miss has no others.
    let mut wrong = [0; QUANTITIES.len()];
    let mut judged = [0; QUANTITIES.len()];
    let mut first_wrong = [None; QUANTITIES.len()];
    for (position, outcome) in answers.iter().enumerate() {
        let others = others.get(&position).map_or(&[][..], Vec::as_slice);
        let right = match outcome {
            Outcome::Value(got) => {
                let candidates = others.iter().chain([&hits[position]]);
                candidates
                    .map(|wanted| right_quantities(got.as_ref(), wanted.as_ref()))
                    .max()
            }
            Outcome::Panicked(_) | Outcome::GivenUp => Some(Right::So(0)),
        };
        match right.unwrap_or(Right::So(0)) {
            Right::Miss => judged[0] += 1,
            Right::So(count) => {
                for quantity in judged.iter_mut().take(count + 1) {
                    *quantity += 1;
                }
                if count < QUANTITIES.len() {
                    wrong[count] += 1;
                    first_wrong[count].get_or_insert(position);
                }
            }
        }
    }

    // Whoever hits nothing has no wrong normals: half of what there is to hit must be judged.
    let to_hit = hits.iter().flatten().count();
    let shares = std::array::from_fn::<Share, { QUANTITIES.len() }, _>(|quantity| {
        if quantity > 0 && judged[quantity] * 2 < to_hit {
            return Share::NONE;
        }
        Share::by_count(wrong[quantity], judged[quantity])
    });
    let share = Share::weighted(
        QUANTITIES
            .iter()
            .zip(shares)
            .map(|((_, weight), share)| (*weight, share)),
    );
    let worst = (0..QUANTITIES.len()).find(|&quantity| shares[quantity] < Share::ALL);
    Judgement {
        share,
        failure: worst.map(|quantity| {
            let element = first_wrong[quantity].unwrap_or(0);
            Failure {
                element,
                how: how(quantity, &answers[element], hits[element].as_ref()),
                count: Some((wrong[quantity], judged[quantity])),
            }
        }),
    }
}

/// How much of an answer agrees with one of the right ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Right {
    /// A hit: so many of the quantities, in order.
    So(usize),
    /// Nothing is there, and nothing was hit.
    Miss,
}

fn right_quantities(got: Option<&Trace>, wanted: Option<&Surface>) -> Right {
    match (got, wanted) {
        (None, None) => Right::Miss,
        (Some(_), None) | (None, Some(_)) => Right::So(0),
        (Some(got), Some(wanted)) => {
            let right = [
                true,
                same_length(got.distance, wanted.depth, DEPTH),
                same_direction(got.normal, wanted.normal, NORMAL),
                same_uv(got.uv, wanted.uv),
            ];
            Right::So(right.into_iter().take_while(|right| *right).count())
        }
    }
}

fn how(quantity: usize, answer: &Outcome<Option<Trace>>, wanted: Option<&Surface>) -> How {
    let got = match answer {
        Outcome::Value(got) => got.as_ref(),
        Outcome::Panicked(panic) => return How::Panicked(panic.clone()),
        Outcome::GivenUp => return How::Protocol("given up".to_owned()),
    };
    let tell = |tell: fn(&Trace) -> String| got.map_or("no hit".to_owned(), tell);
    let want = |want: fn(&Surface) -> String| wanted.map_or("no hit".to_owned(), want);
    let (got, wanted) = match QUANTITIES[quantity].0 {
        "normal" => (
            tell(|trace| describe::point(trace.normal)),
            want(|surface| describe::point(surface.normal)),
        ),
        "uv" => (
            tell(|trace| describe::uv(trace.uv)),
            want(|surface| describe::uv(surface.uv)),
        ),
        _ => (
            tell(|trace| describe::hit_at(trace.distance)),
            want(|surface| describe::hit_at(surface.depth)),
        ),
    };
    How::Wrong {
        what: QUANTITIES[quantity].0.to_owned(),
        got,
        wanted,
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};

    use super::*;

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
    fn not_a_number_is_wrong() {
        let nan = Surface {
            depth: f32::NAN,
            ..WALL
        };
        assert_eq!(judge(&key(), &[], &answers(seen(nan))).share.of(100), 40);
    }
}
