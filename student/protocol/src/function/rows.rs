//! The rows of a table: either the rays in a list, or every ray of a picture.

use std::borrow::Cow;
use std::ops::Range;

use glam::UVec2;
use serde::{Deserialize, Serialize};

use super::Data;
use crate::packed;
use crate::value::Record;
use crate::view::{PIXEL_OFFSETS, Sample};

/// The arguments of one call to a function.
pub trait Input: Record + Data {
    /// A picture with one row per position.
    type View: View<Self>;
}

/// A picture, with one row of the table for each of the five [`PIXEL_OFFSETS`] in every pixel. The
/// pixels are in order, line by line from the bottom.
pub trait View<I>: Data {
    /// Returns the width and height in pixels.
    fn film(&self) -> UVec2;

    /// Returns the row at a position.
    fn input(&self, sample: Sample) -> I;
}

/// The picture type of functions that have no pictures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum NoView {}

impl<I> View<I> for NoView {
    fn film(&self) -> UVec2 {
        match *self {}
    }

    fn input(&self, _: Sample) -> I {
        match *self {}
    }
}

/// The rows of a table, each with the arguments of one call.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", bound = "")]
pub enum Rows<I: Input> {
    /// The listed rows.
    List(#[serde(with = "packed")] Vec<I>),
    /// The rows of a picture.
    Picture(I::View),
}

impl<I: Input> Rows<I> {
    /// Returns the number of rows.
    pub fn count(&self) -> usize {
        match self {
            Rows::List(list) => list.len(),
            // Saturates if the film has more positions than a `usize` can count.
            Rows::Picture(view) => {
                let UVec2 { x, y } = view.film();
                let pixels = (x as usize).saturating_mul(y as usize);
                pixels.saturating_mul(PIXEL_OFFSETS.len())
            }
        }
    }

    /// Returns the row at `index`, or `None` if it is out of range.
    pub fn get(&self, index: usize) -> Option<I> {
        if index >= self.count() {
            return None;
        }
        match self {
            Rows::List(list) => list.get(index).cloned(),
            Rows::Picture(view) => Some(view.input(Sample::of_position(view.film(), index))),
        }
    }

    /// Returns all rows, in order.
    pub fn to_vec(&self) -> Cow<'_, [I]> {
        match self {
            Rows::List(list) => Cow::Borrowed(list),
            Rows::Picture(_) => Cow::Owned((0..self.count()).filter_map(|i| self.get(i)).collect()),
        }
    }

    /// Returns a list of some of the rows.
    ///
    /// # Panics
    ///
    /// If the range is out of bounds.
    pub fn subset(&self, rows: Range<usize>) -> Self {
        let row = |index| self.get(index).expect("the row exists");
        Rows::List(rows.map(row).collect())
    }

    /// Returns the picture that the rows come from, or `None` if the rows are a list.
    pub fn view(&self) -> Option<&I::View> {
        match self {
            Rows::List(_) => None,
            Rows::Picture(view) => Some(view),
        }
    }
}
