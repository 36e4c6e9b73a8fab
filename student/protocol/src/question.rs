//! The sizes of questions and answers.

use glam::UVec2;

use crate::function::{AnyTable, Corners, Geometry, Query, Question, Table};
use crate::ray::Ray;

impl Question {
    /// Returns the question that asks for the closest hits of these rays.
    pub fn hits(subject: Geometry, rays: Vec<Ray>) -> Self {
        Question::Hit(Table::of_list(subject, rays))
    }

    /// Returns the question that asks when rays are inside the box between these corners.
    pub fn boxes(corners: Corners, queries: Vec<Query>) -> Self {
        Question::BBoxHit(Table::of_list(corners, queries))
    }

    /// Returns the number of elements, which is also the number of outcomes in the answer.
    pub fn count(&self) -> usize {
        self.table().map_or(1, AnyTable::count)
    }

    /// Returns the picture's width and height in pixels, if the question asks for a picture.
    pub fn film(&self) -> Option<UVec2> {
        match self {
            Question::Radiance { film, .. } => Some(*film),
            other => other.table()?.film(),
        }
    }

    /// Returns the maximum number of nodes in a tree over this many primitives. A binary tree with
    /// one primitive per leaf has `2n - 1` nodes. The limit is higher to allow for unused nodes.
    pub fn max_nodes(primitives: usize) -> usize {
        primitives.saturating_mul(4).saturating_add(64)
    }

    /// Returns an upper bound on the size of a well-formed answer on the wire, in bytes.
    pub fn max_answer_bytes(&self) -> usize {
        const PANIC_BYTES: usize = 16 * 1024;
        // A node is six floats and four variable-length numbers.
        const NODE_BYTES: usize = 64;
        const PIXEL_BYTES: usize = 12;
        let bytes = match self {
            Question::Build { shapes, .. } => Self::max_nodes(shapes.len())
                .saturating_add(shapes.len())
                .saturating_mul(NODE_BYTES),
            Question::Radiance { film, .. } => (film.x as usize)
                .saturating_mul(film.y as usize)
                .saturating_mul(PIXEL_BYTES),
            other => other.table().map_or(0, |table| {
                // Each outcome has a tag.
                table.count().saturating_mul(1 + table.max_row_bytes())
            }),
        };
        bytes.saturating_add(PANIC_BYTES)
    }
}
