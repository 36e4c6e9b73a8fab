//! `BBox::hit`, which takes a ray and an interval and returns the part of the interval in which the
//! ray is inside a box.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::rows::NoView;
use super::{Function, Input, Output, Question, ResultText, Submission, Table};
use crate::answer::{Answer, ElementOutcome};
use crate::interval::Interval;
use crate::ray::Ray;
use crate::value::{Fields, Record, Value, fields};

/// Calls `BBox::hit` with rays, each with its own `times`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BBoxHit;

/// The corners of a box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Corners {
    /// The corner with the smallest coordinates.
    pub min: Vec3,
    /// The corner with the largest coordinates.
    pub max: Vec3,
}

/// The arguments of `BBox::hit`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Query {
    /// The ray. Its range is ignored.
    pub ray: Ray,
    /// The interval of distances to search along the ray.
    pub times: Interval,
}

impl Function for BBoxHit {
    type Subject = Corners;
    type Input = Query;
    type Output = Option<Interval>;

    fn name(_: &Corners) -> &'static str {
        "BBox::hit"
    }

    fn sentence(_: &Corners) -> &'static str {
        "{ray}, times {times}; box {min} to {max}"
    }

    fn question(table: Table<Self>) -> Question {
        Question::BBoxHit(table)
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        corners: &'a Corners,
    ) -> impl Fn(&Query) -> Option<Interval> + 'a {
        let Corners { min, max } = *corners;
        move |query| submission.intersect_box(min, max, &query.ray, query.times)
    }
}

fields! {
    Corners {
        "min": Point = min,
        "max": Point = max,
    }
}

fields! {
    Query {
        "origin": Point = ray.origin,
        "direction": Direction = ray.dir,
        "range": Range = ray.range,
        "times": Interval = times,
    }
}

impl Input for Query {
    type View = NoView;
}

impl Fields for Interval {
    const NAMES: &'static [&'static str] = &["interval inside the box"];
}

impl Record for Interval {
    fn names(&self) -> &'static [&'static str] {
        <Interval as Fields>::NAMES
    }

    fn value(&self, _: usize) -> Value<'_> {
        Value::Interval(*self)
    }

    fn set(&mut self, _: usize, value: Value<'_>) {
        if let Value::Interval(interval) = value {
            *self = interval;
        }
    }
}

impl Output for Option<Interval> {
    type Record = Interval;

    const NAMES: &'static [&'static str] = <Interval as Fields>::NAMES;
    const RESULT_TEXT: ResultText = ResultText {
        record: "{interval inside the box}",
        present: "{interval inside the box}",
        absent: "None",
    };
    const MAX_BYTES: usize = 2 * size_of::<f32>() + 1;

    fn record(&self) -> Option<&Interval> {
        self.as_ref()
    }

    fn record_mut(&mut self) -> Option<&mut Interval> {
        self.as_mut()
    }

    fn answer(rows: Vec<ElementOutcome<Self>>) -> Answer {
        Answer::Spans(rows)
    }
}
