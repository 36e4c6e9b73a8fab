//! Functions: the methods of a submission that an exam calls once for each row of a table.
//!
//! Each function is declared in its own file. This file contains the two lists of all functions:
//! `Question`, which also has a few variants that aren't tables, and the methods of `Submission`.

mod bbox_hit;
mod hit;
pub mod light;
mod rows;
mod sample_ray;
mod table;

use std::fmt::Debug;

use glam::{UVec2, Vec3};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::answer::{Answer, ElementOutcome};
use crate::interval::Interval;
use crate::packed;
use crate::ray::Ray;
use crate::shape::Shape;
use crate::submission::{Aggregate, CameraRays, Hierarchy};
use crate::tree::TreeNode;
use crate::value::Record;
use crate::view::PinholeCamera;

pub use bbox_hit::{BBoxHit, Corners, Query};
pub use hit::{Geometry, Hit};
pub use light::{
    Color, Density, Fraction, LightFunctions, LightQuestion, LocalDirection, Scattered,
};
pub use rows::{Input, NoView, Rows, View};
pub use sample_ray::SampleRay;
pub use table::{AnyTable, Attempts, Table};

/// A question. It consists of elements (the rows of a table, or an entire tree or picture) that are
/// answered separately, so that a panic only affects its own element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// Calls `Camera::sample_ray` once per row.
    SampleRay(Table<SampleRay>),
    /// Finds the closest hit of one ray per row, with or without a tree.
    Hit(Table<Hit>),
    /// Calls `BBox::hit` once per row.
    #[serde(rename = "bbox_hit")]
    BBoxHit(Table<BBoxHit>),
    /// Calls a function of part two once per row.
    Light(LightQuestion),
    /// Calls `Bvh::build` once. The answer is the whole tree.
    Build {
        /// The primitives, each with a different number.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The maximum number of primitives in a leaf.
        max_leaf_size: u32,
    },
    /// Renders a picture in clay. The framework draws every random number.
    Radiance {
        /// The scene, as the text of a scene file that needs no other file.
        scene: String,
        /// The width and height of the picture, in pixels.
        film: UVec2,
        /// The number of samples per pixel.
        samples: u32,
        /// The seed for all random numbers.
        seed: u64,
    },
}

impl Question {
    /// Returns the table, if the question is a table.
    pub fn table(&self) -> Option<&dyn AnyTable> {
        match self {
            Question::SampleRay(table) => Some(table),
            Question::Hit(table) => Some(table),
            Question::BBoxHit(table) => Some(table),
            Question::Light(question) => Some(question.table()),
            Question::Build { .. } | Question::Radiance { .. } => None,
        }
    }
}

/// A submission's files, called through the given file `world.rs`, which implements this
/// trait. The methods convert the cameras, shapes and nodes in a scene or a question to the
/// submission's own types. An assignment implements the methods for its own functions.
pub trait Submission: Sync {
    /// Calls `Camera::new`.
    fn camera(&self, _pinhole: &PinholeCamera) -> Box<dyn CameraRays> {
        unimplemented!("this assignment has no camera")
    }

    /// Creates a list of primitives, without a tree.
    fn primitive_list(&self, _shapes: &[Shape]) -> Box<dyn Aggregate> {
        unimplemented!("this assignment has no shapes")
    }

    /// Calls `BBox::hit` on the box between these corners.
    fn intersect_box(
        &self,
        _min: Vec3,
        _max: Vec3,
        _ray: &Ray,
        _times: Interval,
    ) -> Option<Interval> {
        unimplemented!("this assignment has no boxes")
    }

    /// Calls `Bvh::build`.
    fn build(&self, _shapes: &[Shape], _max_leaf_size: usize) -> Box<dyn Hierarchy> {
        unimplemented!("this assignment has no trees")
    }

    /// Calls `Bvh::from_nodes`.
    fn prebuilt_tree(
        &self,
        _shapes: &[Shape],
        _nodes: &[TreeNode],
        _root: usize,
    ) -> Box<dyn Hierarchy> {
        unimplemented!("this assignment has no trees")
    }

    /// Returns the functions of part two.
    fn light(&self) -> &dyn LightFunctions {
        unimplemented!("this assignment has no lights")
    }
}

/// A method of a submission, with the types of its subject, its arguments and its result.
pub trait Function: Copy + Debug + PartialEq + 'static {
    /// The value that the method is called on.
    type Subject: Record + Data;
    /// The arguments of one call.
    type Input: Input;
    /// The value that one call returns.
    type Output: Output;

    /// Returns the method's name, such as `BBox::hit`.
    fn name(subject: &Self::Subject) -> &'static str;

    /// Returns a sentence about one call. `{name}` stands for the field with this name.
    fn sentence(subject: &Self::Subject) -> &'static str;

    /// Returns the question for a table of calls.
    fn question(table: Table<Self>) -> Question;

    /// Converts the subject to a submission's own type and returns a closure that calls the method
    /// on it.
    fn calls<'a>(
        submission: &'a dyn Submission,
        subject: &'a Self::Subject,
    ) -> impl Fn(&Self::Input) -> Self::Output + 'a;
}

/// A value that is sent to or from the probe and written to exam files.
pub trait Data: Clone + Debug + PartialEq + Serialize + DeserializeOwned + 'static {}

impl<T: Clone + Debug + PartialEq + Serialize + DeserializeOwned + 'static> Data for T {}

/// The templates for printing a function's results. `{name}` stands for the field with that name.
#[derive(Clone, Copy, Debug)]
pub struct ResultText {
    /// A record in full.
    pub record: &'static str,
    /// A record that is present although none was expected.
    pub present: &'static str,
    /// No record.
    pub absent: &'static str,
}

/// A value that a function returns: a record or an optional record.
pub trait Output: Data {
    /// The type of the record.
    type Record: Record + Data;
    /// The names of the record's fields.
    const NAMES: &'static [&'static str];
    /// The templates for printing values.
    const RESULT_TEXT: ResultText;
    /// An upper bound on the size of one value on the wire, in bytes.
    const MAX_BYTES: usize;

    /// Returns the record, or `None` if the function returned no record.
    fn record(&self) -> Option<&Self::Record>;

    /// Returns the record, to change it.
    fn record_mut(&mut self) -> Option<&mut Self::Record>;

    /// Returns an answer with these rows.
    fn answer(rows: Vec<ElementOutcome<Self>>) -> Answer;
}
