//! One row of a table, with the expected and the submitted result.

use glam::{DVec3, Vec3};
use judging::describe;
use judging::exam::{ExamQuestion, Key};
use judging::judge::{FailureKind, judge};
use protocol::{Answer, ElementOutcome, Record, Value};

use crate::drawing::numbers::{direction_difference, short};
use crate::drawing::sheet::{Sheet, Symbol};

/// The name of the output field that most drawings show.
const DIRECTION: &str = "direction";

/// The submission's result for a row.
pub(super) enum RowResult<'a> {
    /// The code panicked or gave no answer.
    NoAnswer,
    /// The function returned `None`.
    Absent,
    /// The function returned a record.
    Record(&'a dyn Record),
}

/// A row of a table, with the expected and the submitted result.
pub(super) struct RowComparison<'a> {
    /// The arguments of the call.
    pub(super) input: Box<dyn Record>,
    /// The value that the function is called on.
    pub(super) subject: &'a dyn Record,
    /// The expected record, or `None` if the function should return `None`.
    pub(super) wanted: Option<Box<dyn Record>>,
    /// The submitted result.
    pub(super) got: RowResult<'a>,
    /// The names of the quantities that the key judges.
    judged: &'a [String],
    /// The expected result as text.
    wanted_text: String,
    /// The error, or `None` if there is no answer or the answer is right.
    failure: Option<FailureKind>,
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
        let got = match outcome {
            Some(ElementOutcome::Value(Some(record))) => RowResult::Record(record),
            Some(ElementOutcome::Value(None)) => RowResult::Absent,
            Some(ElementOutcome::Panicked(_) | ElementOutcome::Skipped) | None => {
                RowResult::NoAnswer
            }
        };
        let single = answer.and_then(|answer| answer.single(row));
        let failure = single.and_then(|answer| judge(&question.single(row), &answer).failure);
        Some(RowComparison {
            input,
            subject: table.subject(),
            wanted: rows.record(row),
            got,
            judged,
            wanted_text: describe::answer::wanted(question, row).join(", or "),
            failure: failure.map(|failure| failure.kind),
        })
    }

    /// Returns the number in a result that the key judges, or `None` if it judges the direction. A
    /// colour counts as the mean of its channels.
    pub(super) fn judged_value(&self, result: &dyn Record) -> Option<f64> {
        let judged = self.judged.first()?;
        let index = result.names().iter().position(|name| name == judged)?;
        number(&result.value(index))
    }

    /// Returns whether the submitted result is right.
    pub(super) fn is_right(&self) -> bool {
        self.failure.is_none() && !matches!(self.got, RowResult::NoAnswer)
    }

    /// Returns the submitted record, if any.
    pub(super) fn got_record(&self) -> Option<&dyn Record> {
        match self.got {
            RowResult::Record(record) => Some(record),
            RowResult::Absent | RowResult::NoAnswer => None,
        }
    }

    /// Returns the expected direction, if any.
    pub(super) fn wanted_direction(&self) -> Option<DVec3> {
        direction(self.wanted.as_deref()?)
    }

    /// Returns the submitted direction if it is wrong.
    pub(super) fn wrong_direction(&self) -> Option<DVec3> {
        direction(self.got_record()?).filter(|_| self.is_direction_wrong())
    }

    /// Returns whether the direction is wrong, whether there should be one, or its length.
    fn is_direction_wrong(&self) -> bool {
        match &self.failure {
            Some(FailureKind::Wrong { what, .. }) => {
                self.wanted.is_none() || what.ends_with(DIRECTION)
            }
            Some(FailureKind::Panicked(_) | FailureKind::Protocol(_)) | None => false,
        }
    }

    /// Adds the expected and the submitted result to the legend. `symbols` stand for the expected
    /// and the submitted direction.
    pub(super) fn add_results(&self, sheet: &mut Sheet, symbols: [Symbol; 2]) {
        match (&self.failure, self.got_record()) {
            // Another quantity is wrong, which no symbol stands for.
            (
                Some(FailureKind::Wrong {
                    what, got, wanted, ..
                }),
                Some(_),
            ) if !self.is_direction_wrong() => {
                if self.wanted_direction().is_some() {
                    sheet.add_legend(symbols[0], "the correct direction");
                }
                sheet.add_wanted(Symbol::None, &format!("{what} {wanted}"));
                sheet.add_got(Symbol::None, &format!("{what} {got}"));
            }
            (_, record) => {
                let symbol = |direction: Option<DVec3>, symbol| match direction {
                    Some(_) => symbol,
                    None => Symbol::None,
                };
                let wanted = self.wanted_direction();
                sheet.add_wanted(symbol(wanted, symbols[0]), &self.wanted_text);
                let text = |direction: DVec3| describe::point(direction.as_vec3());
                match (&self.got, record.and_then(direction)) {
                    (RowResult::NoAnswer, _) | (RowResult::Record(_), None) => {}
                    (RowResult::Absent, _) => sheet.add_got(Symbol::None, "None"),
                    (RowResult::Record(_), Some(got)) => sheet.add_got(symbols[1], &text(got)),
                }
            }
        }
    }

    /// Returns a sentence that says what is wrong with the submitted result.
    pub(super) fn caption(&self) -> String {
        let wanted = self.wanted_text.as_str();
        match (&self.failure, &self.got, self.wanted_direction()) {
            (_, RowResult::NoAnswer, _) => {
                format!("The correct result is {wanted}; your code gave no answer.")
            }
            (None, ..) => "Your answer is right.".to_owned(),
            (Some(_), RowResult::Absent, _) => {
                format!("Your code returns None; the correct result is {wanted}.")
            }
            (
                Some(FailureKind::Wrong {
                    what, got, wanted, ..
                }),
                RowResult::Record(record),
                to,
            ) => match (to, direction(*record)) {
                (Some(to), Some(direction)) if self.is_direction_wrong() => {
                    let [to, direction] = [to, direction].map(|one| one.as_vec3());
                    direction_difference(DIRECTION, to, direction)
                }
                _ if self.wanted.is_none() => {
                    "Your code returns a direction; the correct result is None.".to_owned()
                }
                _ => format!("Your {what} is {got}; the correct {what} is {wanted}."),
            },
            (
                Some(FailureKind::Panicked(_) | FailureKind::Protocol(_)),
                RowResult::Record(_),
                _,
            ) => "Your answer doesn't belong to this question.".to_owned(),
        }
    }
}

/// Returns the last direction in a record, if any.
pub(super) fn direction(record: &dyn Record) -> Option<DVec3> {
    directions(record).last().map(|one| one.as_dvec3())
}

/// Returns the first direction in a record, if any.
pub(super) fn first_direction(record: &dyn Record) -> Option<DVec3> {
    directions(record).next().map(|one| one.as_dvec3())
}

fn directions(record: &dyn Record) -> impl Iterator<Item = Vec3> {
    record.values().filter_map(|value| {
        if let Value::Direction(direction) = value {
            Some(direction)
        } else {
            None
        }
    })
}

/// Returns the number that stands for a value, or `None` for a direction. No density counts as 0.
fn number(value: &Value) -> Option<f64> {
    if let Value::Density(number) | Value::Fraction(number) = value {
        Some(f64::from(*number))
    } else if let Value::OptionalDensity(density) = value {
        Some(density.map_or(0.0, f64::from))
    } else if let Value::Color(color) = value {
        Some(color.as_dvec3().element_sum() / 3.0)
    } else {
        None
    }
}

/// Describes the angle between a direction and the normal, +z.
pub(super) fn angle_text(direction: DVec3) -> String {
    let (height, along) = (direction.z, direction.truncate().length());
    let degrees = along.atan2(height.abs()).to_degrees();
    let side = if height < 0.0 {
        ", below the surface"
    } else {
        ""
    };
    format!("{}° from the normal{side}", short(degrees))
}
