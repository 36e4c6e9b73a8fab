use glam::{UVec2, Vec3};
use protocol::{Answer, ElementOutcome, Question};

use super::{MaskPixel, Picture, compare};
use crate::exam::{ExamQuestion, Key};
use crate::judge::{Aspect, judge};

/// Returns a question for a rendered picture of 10 × 10 grey pixels.
fn question() -> ExamQuestion {
    let question = Question::Radiance {
        scene: String::new(),
        film: UVec2::splat(10),
        samples: 1,
        seed: 1,
    };
    let key = Key::Radiance {
        pixels: vec![Vec3::splat(0.5); 100],
        max_wrong_pixels: 0,
    };
    ExamQuestion::new(question, key)
}

fn picture_with_errors_at(wrong: &[usize]) -> Option<Picture> {
    let mut pixels = vec![Vec3::splat(0.5); 100];
    for (count, index) in wrong.iter().enumerate() {
        pixels[*index] += 0.1 * (count + 1) as f32;
    }
    compare(&question(), &Answer::Picture(ElementOutcome::Value(pixels)))
}

#[test]
fn mask_marks_exactly_the_wrong_pixels() {
    let picture = picture_with_errors_at(&[3, 57]).unwrap();
    let wrong = |index: usize| picture.mask[index] == MaskPixel::Wrong(Aspect::Radiance);
    assert_eq!(
        (0..100).filter(|index| wrong(*index)).collect::<Vec<_>>(),
        [3, 57]
    );
    assert_eq!(picture.wrong_counts, [(Aspect::Radiance, 2)]);
    let different = picture.layers[0]
        .difference
        .iter()
        .filter(|colour| **colour != [0; 3]);
    assert_eq!(different.count(), 2);
    assert!(picture_with_errors_at(&[]).unwrap().worst_pixels.is_empty());
}

#[test]
fn worst_pixels_are_sorted_and_spread_out() {
    // All wrong pixels except the last are neighbours, and each error is larger than the previous
    // one.
    let picture = picture_with_errors_at(&[0, 1, 2, 99]).unwrap();
    let pixels: Vec<UVec2> = picture
        .worst_pixels
        .iter()
        .map(|wrong| wrong.pixel)
        .collect();
    assert_eq!(pixels[0], UVec2::new(9, 9));
    assert_eq!(pixels[1], UVec2::new(2, 0));
    assert!(!pixels.contains(&UVec2::new(1, 0)));
}

#[test]
fn nan_pixels_are_painted_and_wrong() {
    let mut pixels = vec![Vec3::splat(0.5); 100];
    pixels[7] = Vec3::new(0.5, f32::NAN, 0.5);
    let answer = Answer::Picture(ElementOutcome::Value(pixels));
    let picture = compare(&question(), &answer).unwrap();
    assert_eq!(picture.layers[0].got[7], [255, 0, 255]);
    assert_eq!(picture.worst_pixels[0].element, 7);
    assert!(judge(&question(), &answer).failure.is_some());
}

#[test]
fn an_answer_of_another_size_has_no_picture() {
    let answer = Answer::Picture(ElementOutcome::Value(vec![Vec3::ONE; 99]));
    assert!(compare(&question(), &answer).is_none());
}
