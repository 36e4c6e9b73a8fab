//! A picture that was asked for: what is right, what came, and what is wrong where. Pure, and of
//! no influence on points: it shows what the judge has found.
//!
//! Pixels are listed as they are asked: row by row from the bottom.

mod paint;
mod worst_pixels;

use std::collections::BTreeMap;

use glam::UVec2;
use protocol::{Answer, PIXEL_OFFSETS, Question, Rays, Samples};

use crate::exam::ExamQuestion;
use crate::judge::{Aspect, Mismatch, mismatches};

pub use paint::{Colour, Layer, LayerComparison};
pub use worst_pixels::WorstPixel;

/// A picture beside the right one.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The number of pixels, across and up.
    pub film: UVec2,
    /// The quantities that can be looked at, the one with most to see first.
    pub layers: Vec<LayerComparison>,
    /// What is wrong in each pixel.
    pub mask: Vec<MaskPixel>,
    /// How many positions are judged. A pixel of first hits has five.
    pub positions: usize,
    /// At how many of them each aspect is wrong, the gravest aspect first.
    pub wrong_counts: Vec<(Aspect, usize)>,
    /// The worst pixels.
    pub worst_pixels: Vec<WorstPixel>,
}

/// A picture alone.
#[derive(Clone, Debug)]
pub struct SubmittedPicture {
    /// The number of pixels, across and up.
    pub film: UVec2,
    /// The quantities that can be looked at.
    pub layers: Vec<Layer>,
}

/// What a mask shows of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaskPixel {
    /// All is right, and there is nothing to be seen.
    Empty,
    /// All is right, and there is something.
    Right,
    /// This is the gravest that is wrong at one of its positions.
    Wrong(Aspect),
}

/// Whether a picture is asked for, rather than single rays.
pub fn asks_for_picture(asked: &ExamQuestion) -> bool {
    grid(&asked.question).is_some()
}

/// The picture that was answered. None where none was asked for, or what came is none of its size.
pub fn compare(asked: &ExamQuestion, answer: &Answer) -> Option<Picture> {
    let (film, per_pixel) = grid(&asked.question)?;
    let blemishes = mismatches(asked, answer)?;
    let views = paint::compare_layers(asked, answer, &blemishes, per_pixel)?;
    let mut wrong: BTreeMap<Aspect, usize> = BTreeMap::new();
    for blemish in blemishes.iter().flatten() {
        *wrong.entry(blemish.aspect).or_default() += 1;
    }
    let is_something = paint::has_surface(asked);
    let cells = blemishes
        .chunks(per_pixel)
        .zip(is_something.chunks(per_pixel));
    Some(Picture {
        film,
        mask: cells
            .map(|(found, something)| mask_pixel(found, something))
            .collect(),
        positions: blemishes.len(),
        wrong_counts: wrong.into_iter().collect(),
        worst_pixels: worst_pixels::pick(film, per_pixel, &blemishes),
        layers: views,
    })
}

/// What came of a picture that is right: the same as [`of`] has, for a tenth of the work, since most
/// pictures are right.
pub fn submitted_picture(asked: &ExamQuestion, answer: &Answer) -> Option<SubmittedPicture> {
    let (film, per_pixel) = grid(&asked.question)?;
    let plates = paint::submitted_layers(asked, answer, per_pixel)?;
    Some(SubmittedPicture {
        film,
        layers: plates,
    })
}

fn mask_pixel(blemishes: &[Option<Mismatch>], something: &[bool]) -> MaskPixel {
    let aspects = blemishes.iter().flatten().map(|blemish| blemish.aspect);
    match aspects.min() {
        Some(aspect) => MaskPixel::Wrong(aspect),
        None if something.contains(&true) => MaskPixel::Right,
        None => MaskPixel::Empty,
    }
}

/// The film, and how many positions each of its pixels has.
fn grid(question: &Question) -> Option<(UVec2, usize)> {
    match question {
        Question::Camera { camera, samples } => match samples {
            Samples::EveryPixel => Some((camera.film, PIXEL_OFFSETS.len())),
            Samples::List(_) => None,
        },
        Question::Shapes { rays, .. }
        | Question::Traverse { rays, .. }
        | Question::BuildAndTraverse { rays, .. } => match rays {
            Rays::View(view) => Some((view.film, PIXEL_OFFSETS.len())),
            Rays::List(_) => None,
        },
        Question::Radiance { film, .. } => Some((*film, 1)),
        Question::BBox { .. } | Question::Build { .. } | Question::Done => None,
    }
}

#[cfg(test)]
mod tests;
