use glam::{UVec2, Vec3};
use protocol::{Answer, Outcome, Question};

use super::{Cell, Picture, of};
use crate::exam::{Asked, Key};
use crate::judge::{Aspect, judge};

/// A path-traced picture of 10 × 10 grey pixels.
fn asked() -> Asked {
    let question = Question::Radiance {
        scene: String::new(),
        film: UVec2::splat(10),
        samples: 1,
        bounces: 1,
        seed: 1,
    };
    let key = Key::Radiance {
        pixels: vec![Vec3::splat(0.5); 100],
        allowed: 0,
    };
    Asked::new(question, key)
}

fn answered(wrong: &[usize]) -> Option<Picture> {
    let mut pixels = vec![Vec3::splat(0.5); 100];
    for (count, place) in wrong.iter().enumerate() {
        pixels[*place] += 0.1 * (count + 1) as f32;
    }
    of(&asked(), &Answer::Picture(Outcome::Value(pixels)))
}

#[test]
fn a_mask_shows_what_is_wrong_and_nothing_else() {
    let picture = answered(&[3, 57]).unwrap();
    let wrong = |place: usize| picture.mask[place] == Cell::Wrong(Aspect::Radiance);
    assert_eq!(
        (0..100).filter(|place| wrong(*place)).collect::<Vec<_>>(),
        [3, 57]
    );
    assert_eq!(picture.wrong, [(Aspect::Radiance, 2)]);
    let seen = picture.views[0]
        .difference
        .iter()
        .filter(|colour| **colour != [0; 3]);
    assert_eq!(seen.count(), 2);
    assert!(answered(&[]).unwrap().spots.is_empty());
}

#[test]
fn the_worst_pixels_come_first_and_do_not_crowd() {
    // All but the last are neighbours; the later, the farther off.
    let picture = answered(&[0, 1, 2, 99]).unwrap();
    let pixels: Vec<UVec2> = picture.spots.iter().map(|spot| spot.pixel).collect();
    assert_eq!(pixels[0], UVec2::new(9, 9));
    assert_eq!(pixels[1], UVec2::new(2, 0));
    assert!(!pixels.contains(&UVec2::new(1, 0)));
}

#[test]
fn what_is_no_number_is_painted_and_wrong() {
    let mut pixels = vec![Vec3::splat(0.5); 100];
    pixels[7] = Vec3::new(0.5, f32::NAN, 0.5);
    let answer = Answer::Picture(Outcome::Value(pixels));
    let picture = of(&asked(), &answer).unwrap();
    assert_eq!(picture.views[0].got[7], [255, 0, 255]);
    assert_eq!(picture.spots[0].element, 7);
    assert!(judge(&asked(), &answer).failure.is_some());
}

#[test]
fn an_answer_of_another_size_is_no_picture() {
    let answer = Answer::Picture(Outcome::Value(vec![Vec3::ONE; 99]));
    assert!(of(&asked(), &answer).is_none());
}
