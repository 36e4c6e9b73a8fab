//! One row of a table, with the expected and the submitted result.

use glam::DVec3;
use judging::describe;
use judging::exam::{ExamQuestion, Key};
use judging::judge::{FailureKind, judge};
use judging::symptom::SOME_OR_NONE;
use protocol::{Answer, ElementOutcome, Record, Value};

use crate::drawing::numbers::{direction_difference, short};
use crate::drawing::sheet::{Sheet, Symbol};

/// The name of the output field that most drawings show.
const DIRECTION: &str = "direction";

/// A row of a table, with the expected and the submitted result.
pub(super) struct RowComparison<'a> {
    /// The arguments of the call.
    pub(super) input: Box<dyn Record>,
    /// The value that the function is called on.
    pub(super) subject: &'a dyn Record,
    /// The expected record, or `None` if the function should return `None`.
    pub(super) wanted: Option<Box<dyn Record>>,
    /// The submitted record, or `None` if the function returned `None` or gave no answer.
    pub(super) got: Option<&'a dyn Record>,
    /// The name of the first quantity that the key judges.
    pub(super) judged: &'a str,
    /// Whether the function returned anything, which may be `None`.
    has_answer: bool,
    /// The expected record as text, without names if it has only one field.
    row_text: String,
    /// The first quantity that is wrong.
    difference: Option<Difference>,
}

/// A quantity that is wrong.
struct Difference {
    what: String,
    got: String,
    wanted: String,
}

impl<'a> RowComparison<'a> {
    /// Compares a row with its key. Returns `None` if the row doesn't exist, or if the key isn't a
    /// list of rows.
    pub(super) fn new(
        question: &'a ExamQuestion,
        row: usize,
        answer: Option<&'a Answer>,
    ) -> Option<Self> {
        let Key::Table { rows, judged, .. } = &question.key else {
            return None;
        };
        let table = question.question.table()?;
        let input = table.input(row).filter(|_| row < rows.count())?;
        let answer = answer.filter(|answer| answer.names() == Some(table.output_names()));
        let outcome = answer.and_then(|answer| answer.rows()?.get(row).cloned());
        let got = outcome.as_ref().and_then(ElementOutcome::value).copied();
        let single = answer.and_then(|answer| answer.single(row));
        let failure = single.and_then(|answer| judge(&question.single(row), &answer).failure);
        let difference = if let Some(FailureKind::Wrong {
            what, got, wanted, ..
        }) = failure.map(|failure| failure.kind)
        {
            Some(Difference { what, got, wanted })
        } else {
            None
        };
        Some(RowComparison {
            input,
            subject: table.subject(),
            wanted: rows.record(row),
            got: got.flatten(),
            judged: judged.first()?,
            has_answer: got.is_some(),
            row_text: describe::answer::wanted(question, row).join(", or "),
            difference,
        })
    }

    /// Returns whether the submitted result is right.
    pub(super) fn is_right(&self) -> bool {
        self.has_answer && self.difference.is_none()
    }

    /// Returns the expected direction, if any.
    pub(super) fn wanted_direction(&self) -> Option<DVec3> {
        last_direction(self.wanted.as_deref()?)
    }

    /// Returns the submitted direction if it is wrong.
    pub(super) fn wrong_direction(&self) -> Option<DVec3> {
        let is_wrong = self.difference.as_ref()?.is_of_direction();
        last_direction(self.got?).filter(|_| is_wrong)
    }

    /// Adds the expected and the submitted result to the legend. `symbols` stand for the expected
    /// and the submitted direction.
    pub(super) fn add_results(&self, sheet: &mut Sheet, symbols: [Symbol; 2]) {
        let symbol = |direction: Option<DVec3>, symbol| direction.map_or(Symbol::None, |_| symbol);
        let mut right = symbol(self.wanted_direction(), symbols[0]);
        let Some(difference) = &self.difference else {
            sheet.add_wanted(right, &self.wanted_text());
            return;
        };
        let Difference { what, got, wanted } = difference;
        let name = match what.as_str() {
            SOME_OR_NONE | DIRECTION => String::new(),
            _ if difference.is_of_direction() => "length ".to_owned(),
            _ => format!("{what} "),
        };
        if self.wanted_direction().is_some() && !difference.is_of_direction() {
            sheet.add_legend(symbols[0], "the correct direction");
            right = Symbol::None;
        }
        sheet.add_wanted(right, &format!("{name}{wanted}"));
        let wrong = symbol(self.wrong_direction(), symbols[1]);
        sheet.add_got(wrong, &format!("{name}{got}"));
    }

    /// Returns the expected result as text. A single number has its name in front.
    fn wanted_text(&self) -> String {
        let names = self.wanted.as_deref().map(Record::names);
        if names == Some(&[self.judged]) && self.judged != DIRECTION {
            return format!("{} {}", self.judged, self.row_text);
        }
        self.row_text.clone()
    }

    /// Returns a sentence that says what is wrong with the submitted result.
    pub(super) fn caption(&self) -> String {
        let directions = self.wanted_direction().zip(self.wrong_direction());
        match (&self.difference, directions) {
            _ if !self.has_answer => {
                let wanted = self.wanted_text();
                format!("The correct result is {wanted}; your code gave no answer.")
            }
            (None, _) => "Your answer is right.".to_owned(),
            (_, Some((wanted, got))) => {
                direction_difference(DIRECTION, wanted.as_vec3(), got.as_vec3())
            }
            (Some(Difference { what, got, wanted }), None) if what == SOME_OR_NONE => {
                format!("Your code returns {got}; the correct result is {wanted}.")
            }
            (Some(Difference { what, got, wanted }), None) => {
                format!("Your {what} is {got}; the correct {what} is {wanted}.")
            }
        }
    }
}

impl Difference {
    /// Returns whether the direction or its length is wrong, or whether there should be one.
    fn is_of_direction(&self) -> bool {
        self.what == SOME_OR_NONE || self.what.ends_with(DIRECTION)
    }
}

/// Returns the directions in a record, in order.
pub(super) fn directions(record: &dyn Record) -> impl Iterator<Item = DVec3> {
    record.values().filter_map(|value| {
        if let Value::Direction(direction) = value {
            Some(direction.as_dvec3())
        } else {
            None
        }
    })
}

/// Returns the last direction in a record, which is the one that a density or a result is about.
pub(super) fn last_direction(record: &dyn Record) -> Option<DVec3> {
    directions(record).last()
}

/// Describes the angle between a direction and the normal, +z.
pub(super) fn angle_text(direction: DVec3) -> String {
    let (height, along) = (direction.z, direction.truncate().length());
    let degrees = short(along.atan2(height.abs()).to_degrees());
    let side = if height < 0.0 {
        ", below the surface"
    } else {
        ""
    };
    format!("{degrees}° from the normal{side}")
}
