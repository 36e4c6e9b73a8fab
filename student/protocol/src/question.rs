//! Questions that the grader asks the probe.

use glam::UVec2;
use serde::{Deserialize, Serialize};

use crate::function::{
    AnyTable, BBoxHit, Corners, Geometry, Hit, Query, Reflect, SampleRay, Table,
};
use crate::packed;
use crate::ray::Ray;
use crate::shape::Shape;

/// A question. It consists of elements (the rows of a table, or a tree or a picture as a whole) that
/// are answered separately, so that a panic affects only its own element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// Calls `Camera::sample_ray` once per row.
    SampleRay(Table<SampleRay>),
    /// Finds the closest hit of one ray per row, without or with a tree.
    Hit(Table<Hit>),
    /// Calls `BBox::hit` once per row.
    #[serde(rename = "bbox_hit")]
    BBoxHit(Table<BBoxHit>),
    /// Calls `reflect` once per row.
    Reflect(Table<Reflect>),
    /// Calls `Bvh::build` once. The answer is the whole tree.
    Build {
        /// The primitives, each with a different number.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The maximum number of primitives in a leaf.
        max_leaf_size: u32,
    },
    /// Renders a path-traced picture. The framework draws every random number.
    Radiance {
        /// The scene, as the text of a scene file that needs no other file.
        scene: String,
        /// The number of pixels, across and up.
        film: UVec2,
        /// The number of paths per pixel.
        samples: u32,
        /// The maximum number of times that a path is scattered.
        bounces: u32,
        /// The seed of all random numbers.
        seed: u64,
    },
}

impl Question {
    /// Returns the question that asks for the closest hits of these rays.
    pub fn hits(subject: Geometry, rays: Vec<Ray>) -> Self {
        Question::Hit(Table::of_list(subject, rays))
    }

    /// Returns the question that asks when rays are in the box between these corners.
    pub fn boxes(corners: Corners, queries: Vec<Query>) -> Self {
        Question::BBoxHit(Table::of_list(corners, queries))
    }

    /// Returns the table, if the question is one.
    pub fn table(&self) -> Option<&dyn AnyTable> {
        match self {
            Question::SampleRay(table) => Some(table),
            Question::Hit(table) => Some(table),
            Question::BBoxHit(table) => Some(table),
            Question::Reflect(table) => Some(table),
            Question::Build { .. } | Question::Radiance { .. } => None,
        }
    }

    /// Returns the number of elements, which is also the number of outcomes in the answer.
    pub fn count(&self) -> usize {
        self.table().map_or(1, AnyTable::count)
    }

    /// Returns the number of pixels, across and up, if the question asks for a picture.
    pub fn film(&self) -> Option<UVec2> {
        match self {
            Question::Radiance { film, .. } => Some(*film),
            other => other.table()?.film(),
        }
    }

    /// Returns the maximum number of nodes in a tree over this many primitives. A binary tree with
    /// one primitive per leaf has `2n - 1`; the limit is higher to allow for unused nodes.
    pub fn max_nodes(primitives: usize) -> usize {
        primitives.saturating_mul(4).saturating_add(64)
    }

    /// Returns an upper bound on the size of a well-formed answer on the wire, in bytes.
    pub fn max_answer_bytes(&self) -> usize {
        const PANIC_BYTES: usize = 16 * 1024;
        // A node is six floats and four numbers of variable length.
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
