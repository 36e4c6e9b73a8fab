//! Compares a submitted picture with the expected one for display. The comparison shows the judge's
//! findings and doesn't affect points.
//!
//! Pixels are listed in the order of the question's elements: row by row from the bottom.

mod paint;
mod worst_pixels;

use std::collections::BTreeMap;

use glam::UVec2;
use protocol::{Answer, PIXEL_OFFSETS, Question};

use crate::exam::ExamQuestion;
use crate::judge::{Aspect, Mismatch, mismatches};

pub use paint::{Colour, Layer, LayerComparison};
pub use worst_pixels::WorstPixel;

/// A submitted picture compared with the expected one.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width and height of the picture, in pixels.
    pub film: UVec2,
    /// The quantities that can be displayed, starting with the one that shows the most serious
    /// error.
    pub layers: Vec<LayerComparison>,
    /// The error in each pixel.
    pub mask: Vec<MaskPixel>,
    /// Number of judged positions. In pictures of first hits, each pixel has five positions.
    pub positions: usize,
    /// Number of positions where each aspect is wrong, the most serious aspect first.
    pub wrong_counts: Vec<(Aspect, usize)>,
    /// The worst pixels.
    pub worst_pixels: Vec<WorstPixel>,
}

/// A submitted picture without a comparison.
#[derive(Clone, Debug)]
pub struct SubmittedPicture {
    /// Width and height of the picture, in pixels.
    pub film: UVec2,
    /// The quantities that can be displayed.
    pub layers: Vec<Layer>,
}

/// One pixel of a mask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaskPixel {
    /// The pixel is correct and shows no surface.
    Empty,
    /// The pixel is correct and shows a surface.
    Right,
    /// The pixel is wrong. Contains the most serious error at its positions.
    Wrong(Aspect),
}

/// Returns whether the question asks for a picture rather than for single rays.
pub fn asks_for_picture(question: &ExamQuestion) -> bool {
    grid(&question.question).is_some()
}

/// Compares a submitted picture with the expected one. Returns `None` if the question doesn't ask
/// for a picture, or if the answer is the wrong size.
pub fn compare(question: &ExamQuestion, answer: &Answer) -> Option<Picture> {
    let (film, per_pixel) = grid(&question.question)?;
    let all_mismatches = mismatches(question, answer)?;
    let layers = paint::compare_layers(question, answer, &all_mismatches, per_pixel)?;
    let mut wrong: BTreeMap<Aspect, usize> = BTreeMap::new();
    for mismatch in all_mismatches.iter().flatten() {
        *wrong.entry(mismatch.aspect).or_default() += 1;
    }
    let has_surface = paint::has_surface(question);
    let pixels = all_mismatches
        .chunks(per_pixel)
        .zip(has_surface.chunks(per_pixel));
    Some(Picture {
        film,
        mask: pixels
            .map(|(found, surfaces)| mask_pixel(found, surfaces))
            .collect(),
        positions: all_mismatches.len(),
        wrong_counts: wrong.into_iter().collect(),
        worst_pixels: worst_pixels::pick(film, per_pixel, &all_mismatches),
        layers,
    })
}

/// Returns the layers of a submitted picture that is known to be correct, or `None` if the question
/// doesn't ask for a picture. Most pictures are correct. For a correct picture, [`compare`] would
/// return the same layers but take ten times as long.
pub fn submitted_picture(question: &ExamQuestion, answer: &Answer) -> Option<SubmittedPicture> {
    let (film, per_pixel) = grid(&question.question)?;
    let layers = paint::submitted_layers(question, answer, per_pixel)?;
    Some(SubmittedPicture { film, layers })
}

fn mask_pixel(all_mismatches: &[Option<Mismatch>], surfaces: &[bool]) -> MaskPixel {
    let aspects = all_mismatches
        .iter()
        .flatten()
        .map(|mismatch| mismatch.aspect);
    match aspects.min() {
        Some(aspect) => MaskPixel::Wrong(aspect),
        None if surfaces.contains(&true) => MaskPixel::Right,
        None => MaskPixel::Empty,
    }
}

/// Returns the film size and the number of positions per pixel.
fn grid(question: &Question) -> Option<(UVec2, usize)> {
    let is_radiance = matches!(question, Question::Radiance { .. });
    let per_pixel = if is_radiance { 1 } else { PIXEL_OFFSETS.len() };
    Some((question.film()?, per_pixel))
}

#[cfg(test)]
mod tests;
