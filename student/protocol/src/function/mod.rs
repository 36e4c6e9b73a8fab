//! Functions: the methods of a submission that an exam calls in tables, once per row.

mod bbox_hit;
mod hit;
mod reflect;
mod rows;
mod sample_ray;
mod table;

use std::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::answer::{Answer, ElementOutcome};
use crate::question::Question;
use crate::value::Record;

pub use bbox_hit::{BBoxHit, Corners, Query};
pub use hit::{Geometry, Hit};
pub use reflect::{LocalDirection, Reflect};
pub use rows::{Input, NoView, Rows, View};
pub use sample_ray::SampleRay;
pub use table::{AnyTable, Table};

/// A method of a submission, with the types of what it is called on and with, and of what it returns.
pub trait Function: Copy + Debug + PartialEq + 'static {
    /// The value that the method is called on.
    type Subject: Record + Data;
    /// The arguments of one call.
    type Input: Input;
    /// The value that one call returns.
    type Output: Output;

    /// Returns the method's name, such as `BBox::hit`.
    fn name(subject: &Self::Subject) -> &'static str;

    /// Returns a sentence about one call. `{name}` stands for the field of this name.
    fn sentence(subject: &Self::Subject) -> &'static str;

    /// Returns the question that asks for the calls of a table.
    fn question(table: Table<Self>) -> Question;
}

/// A value that is sent to the probe or from it, and written to exam files.
pub trait Data: Clone + Debug + PartialEq + Serialize + DeserializeOwned + 'static {}

impl<T: Clone + Debug + PartialEq + Serialize + DeserializeOwned + 'static> Data for T {}

/// How the values that a function returns are printed. `{name}` stands for the field of this name.
#[derive(Clone, Copy, Debug)]
pub struct Words {
    /// A record in full.
    pub record: &'static str,
    /// A record where none is expected.
    pub present: &'static str,
    /// No record.
    pub absent: &'static str,
}

/// A value that a function returns: a record, or nothing if it is optional.
pub trait Output: Data {
    /// The names of the record's fields.
    const NAMES: &'static [&'static str];
    /// How values are printed.
    const WORDS: Words;
    /// An upper bound on the size of one value on the wire, in bytes.
    const MAX_BYTES: usize;

    /// Returns the record, or `None` if the function returned none.
    fn record(&self) -> Option<&dyn Record>;

    /// Returns the answer with these rows.
    fn answer(rows: Vec<ElementOutcome<Self>>) -> Answer;
}
