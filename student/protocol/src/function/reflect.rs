//! `reflect`, which takes the direction toward the viewer and returns the direction from which a
//! mirror sends light to the viewer.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::rows::NoView;
use super::{Function, Input, Output, Question, ResultText, Submission, Table};
use crate::answer::{Answer, ElementOutcome};
use crate::value::{Fields, Record, fields};

/// Calls `reflect` with directions. It is a free function, so it has no subject.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reflect;

/// A direction at a point on a surface, in a frame whose +z is the normal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LocalDirection {
    /// The direction, as a unit vector.
    pub direction: Vec3,
}

impl Function for Reflect {
    type Subject = ();
    type Input = LocalDirection;
    type Output = LocalDirection;

    fn name((): &()) -> &'static str {
        "reflect"
    }

    fn sentence((): &()) -> &'static str {
        "direction {direction} toward the viewer, where +z is the normal"
    }

    fn question(table: Table<Self>) -> Question {
        Question::Reflect(table)
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        (): &'a (),
    ) -> impl Fn(&LocalDirection) -> LocalDirection + 'a {
        |toward_viewer| LocalDirection {
            direction: submission.reflect(toward_viewer.direction),
        }
    }
}

fields! {
    LocalDirection {
        "direction": Direction = direction,
    }
}

impl Input for LocalDirection {
    type View = NoView;
}

impl Output for LocalDirection {
    const NAMES: &'static [&'static str] = <LocalDirection as Fields>::NAMES;
    const RESULT_TEXT: ResultText = ResultText {
        record: "{direction}",
        present: "{direction}",
        absent: "no direction",
    };
    const MAX_BYTES: usize = 3 * size_of::<f32>();

    fn record(&self) -> Option<&dyn Record> {
        Some(self)
    }

    fn answer(rows: Vec<ElementOutcome<Self>>) -> Answer {
        Answer::Directions(rows)
    }
}
