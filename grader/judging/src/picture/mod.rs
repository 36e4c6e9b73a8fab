//! A picture that was asked for: what is right, what came, and what is wrong where. Pure, and of
//! no influence on points: it shows what the judge has found.
//!
//! Pixels are listed as they are asked: row by row from the bottom.

mod paint;
mod spots;

use std::collections::BTreeMap;

use glam::UVec2;
use protocol::{Answer, OFFSETS, Question, Rays, Samples};

use crate::exam::Asked;
use crate::judge::{Aspect, Blemish, blemishes};

pub use paint::{Colour, Plate, View};
pub use spots::Spot;

/// A picture beside the right one.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The number of pixels, across and up.
    pub film: UVec2,
    /// The quantities that can be looked at, the one with most to see first.
    pub views: Vec<View>,
    /// What is wrong in each pixel.
    pub mask: Vec<Cell>,
    /// How many positions are judged. A pixel of first hits has five.
    pub positions: usize,
    /// At how many of them each aspect is wrong, the gravest aspect first.
    pub wrong: Vec<(Aspect, usize)>,
    /// The worst pixels.
    pub spots: Vec<Spot>,
}

/// A picture alone.
#[derive(Clone, Debug)]
pub struct Received {
    /// The number of pixels, across and up.
    pub film: UVec2,
    /// The quantities that can be looked at.
    pub plates: Vec<Plate>,
}

/// What a mask shows of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cell {
    /// All is right, and there is nothing to be seen.
    Empty,
    /// All is right, and there is something.
    Right,
    /// This is the gravest that is wrong at one of its positions.
    Wrong(Aspect),
}

/// Whether a picture is asked for, rather than single rays.
pub fn is_asked(asked: &Asked) -> bool {
    grid(&asked.question).is_some()
}

/// The picture that was answered. None where none was asked for, or what came is none of its size.
pub fn of(asked: &Asked, answer: &Answer) -> Option<Picture> {
    let (film, per_pixel) = grid(&asked.question)?;
    let blemishes = blemishes(asked, answer)?;
    let views = paint::views(asked, answer, &blemishes, per_pixel)?;
    let mut wrong: BTreeMap<Aspect, usize> = BTreeMap::new();
    for blemish in blemishes.iter().flatten() {
        *wrong.entry(blemish.aspect).or_default() += 1;
    }
    let is_something = paint::something(asked);
    let cells = blemishes
        .chunks(per_pixel)
        .zip(is_something.chunks(per_pixel));
    Some(Picture {
        film,
        mask: cells
            .map(|(found, something)| cell(found, something))
            .collect(),
        positions: blemishes.len(),
        wrong: wrong.into_iter().collect(),
        spots: spots::worst(film, per_pixel, &blemishes),
        views,
    })
}

/// What came of a picture that is right: the same as [`of`] has, for a tenth of the work, since most
/// pictures are right.
pub fn received(asked: &Asked, answer: &Answer) -> Option<Received> {
    let (film, per_pixel) = grid(&asked.question)?;
    let plates = paint::received(asked, answer, per_pixel)?;
    Some(Received { film, plates })
}

fn cell(blemishes: &[Option<Blemish>], something: &[bool]) -> Cell {
    let aspects = blemishes.iter().flatten().map(|blemish| blemish.aspect);
    match aspects.min() {
        Some(aspect) => Cell::Wrong(aspect),
        None if something.contains(&true) => Cell::Right,
        None => Cell::Empty,
    }
}

/// The film, and how many positions each of its pixels has.
fn grid(question: &Question) -> Option<(UVec2, usize)> {
    match question {
        Question::Camera { camera, samples } => match samples {
            Samples::EveryPixel => Some((camera.film, OFFSETS.len())),
            Samples::List(_) => None,
        },
        Question::Shapes { rays, .. }
        | Question::Traverse { rays, .. }
        | Question::BuildAndTraverse { rays, .. } => match rays {
            Rays::View(view) => Some((view.film, OFFSETS.len())),
            Rays::List(_) => None,
        },
        Question::Radiance { film, .. } => Some((*film, 1)),
        Question::BBox { .. } | Question::Build { .. } | Question::Done => None,
    }
}

#[cfg(test)]
mod tests;
