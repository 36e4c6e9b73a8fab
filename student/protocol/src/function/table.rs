//! Tables: questions that call one function on one subject, once per row.

use std::ops::Range;

use glam::UVec2;
use serde::{Deserialize, Serialize};

use super::{Function, Output, Question, ResultText, Rows, Submission, View};
use crate::answer::{Answer, ElementOutcome};
use crate::value::{Record, Value};

/// A question that calls a function on a subject once per row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, bound = "")]
pub struct Table<F: Function> {
    /// The value that the function is called on.
    pub subject: F::Subject,
    /// The arguments of each call.
    pub rows: Rows<F::Input>,
}

impl<F: Function> Table<F> {
    /// Creates a table with a list of rows.
    pub fn of_list(subject: F::Subject, rows: Vec<F::Input>) -> Self {
        Table {
            subject,
            rows: Rows::List(rows),
        }
    }
}

/// Runs the calls in one table.
pub trait Attempts {
    /// Runs `call` and returns its outcome.
    fn attempt(&mut self, call: &mut dyn FnMut()) -> ElementOutcome<()>;
}

/// A table for any function.
pub trait AnyTable {
    /// Returns the function's name, such as `BBox::hit`.
    fn name(&self) -> &'static str;

    /// Returns a sentence about one row. `{name}` stands for the field with this name.
    fn sentence(&self) -> &'static str;

    /// Returns the value that the function is called on.
    fn subject(&self) -> &dyn Record;

    /// Returns the number of rows.
    fn count(&self) -> usize;

    /// Returns the arguments in a row, or `None` if the row is out of range.
    fn input(&self, row: usize) -> Option<Box<dyn Record>>;

    /// Returns the picture's width and height in pixels, if the rows come from a picture.
    fn film(&self) -> Option<UVec2>;

    /// Returns the field names of the function's result.
    fn output_names(&self) -> &'static [&'static str];

    /// Returns the templates for printing the function's results.
    fn result_text(&self) -> ResultText;

    /// Returns an upper bound on the size of one row of the answer on the wire, in bytes.
    fn max_row_bytes(&self) -> usize;

    /// Returns a submission's answer. The subject is converted in the first attempt, so that a
    /// panic in a constructor is reported like any other panic.
    fn answer(&self, submission: &dyn Submission, attempts: &mut dyn Attempts) -> Answer;

    /// Returns a question with only these rows, as a list.
    ///
    /// # Panics
    ///
    /// If the range is out of bounds.
    fn subset(&self, rows: Range<usize>) -> Question;

    /// Returns the question with `change` applied to the value of every field, in both the subject
    /// and the rows. Returns `None` if the rows come from a picture.
    fn changed(&self, change: &dyn Fn(Value<'_>) -> Value<'static>) -> Option<Question>;
}

impl<F: Function> AnyTable for Table<F> {
    fn name(&self) -> &'static str {
        F::name(&self.subject)
    }

    fn sentence(&self) -> &'static str {
        F::sentence(&self.subject)
    }

    fn subject(&self) -> &dyn Record {
        &self.subject
    }

    fn count(&self) -> usize {
        self.rows.count()
    }

    fn input(&self, row: usize) -> Option<Box<dyn Record>> {
        Some(Box::new(self.rows.get(row)?))
    }

    fn film(&self) -> Option<UVec2> {
        self.rows.view().map(View::film)
    }

    fn output_names(&self) -> &'static [&'static str] {
        F::Output::NAMES
    }

    fn result_text(&self) -> ResultText {
        F::Output::RESULT_TEXT
    }

    fn max_row_bytes(&self) -> usize {
        F::Output::MAX_BYTES
    }

    fn answer(&self, submission: &dyn Submission, attempts: &mut dyn Attempts) -> Answer {
        let mut call = None;
        let mut outcome = |row| {
            let mut output = None;
            let ended = attempts.attempt(&mut || {
                let call = call.get_or_insert_with(|| F::calls(submission, &self.subject));
                output = Some(call(row));
            });
            match (ended, output) {
                (ElementOutcome::Value(()), Some(output)) => ElementOutcome::Value(output),
                (ElementOutcome::Panicked(panic), _) => ElementOutcome::Panicked(panic),
                (ElementOutcome::Value(()) | ElementOutcome::Skipped, _) => ElementOutcome::Skipped,
            }
        };
        F::Output::answer(self.rows.to_vec().iter().map(&mut outcome).collect())
    }

    fn subset(&self, rows: Range<usize>) -> Question {
        F::question(Table {
            subject: self.subject.clone(),
            rows: self.rows.subset(rows),
        })
    }

    fn changed(&self, change: &dyn Fn(Value<'_>) -> Value<'static>) -> Option<Question> {
        let Rows::List(mut rows) = self.rows.clone() else {
            return None;
        };
        let mut subject = self.subject.clone();
        (&mut subject as &mut dyn Record).change(change);
        for row in &mut rows {
            (row as &mut dyn Record).change(change);
        }
        Some(F::question(Table::of_list(subject, rows)))
    }
}
