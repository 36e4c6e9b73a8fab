//! Compares the rows of tables with the key. All functions share this comparison.

use std::iter;

use protocol::{Answer, AnyTable, ElementOutcome, Record, RowOutcome};

use super::deviation::{outcome_deviations, worst_by_threshold};
use super::quantity::Quantity;
use super::scale::Scales;
use super::{
    Aspect, Comparison, Credit, Deviation, Failure, FailureKind, Judgement, Measurement, Position,
    Threshold,
};
use crate::describe;
use crate::exam::{Aggregate, ExamQuestion, ExpectedRows, Key};
use crate::symptom::{PRESENCE, SOME_OR_NONE, Side};

/// The rows of an answer and their key. Every row must be right, except in a picture, where a few
/// may be wrong.
pub(crate) struct TableAnswer<'a> {
    table: &'a dyn AnyTable,
    scales: Scales<'a>,
    judged: Vec<Quantity>,
    expected: &'a ExpectedRows,
    aggregate: Aggregate,
    rows: Vec<RowOutcome<'a>>,
}

/// One row: the function's result and the expected one.
pub(crate) struct Row<'a> {
    pub(crate) got: Option<&'a dyn Record>,
    pub(crate) wanted: Option<Box<dyn Record>>,
    pub(crate) scale: f32,
}

/// Returns the quantities that a key compares, or `None` if the key is for another function.
pub(crate) fn judged_quantities(
    table: &dyn AnyTable,
    judged: &[String],
    rows: &ExpectedRows,
) -> Option<Vec<Quantity>> {
    let names = table.output_names();
    if rows.names() != names {
        return None;
    }
    judged
        .iter()
        .map(|name| Quantity::named(name, names))
        .collect()
}

impl<'a> TableAnswer<'a> {
    /// Combines an answer with its key. Returns `None` if one of them doesn't belong to this
    /// question, or if the question isn't a table.
    pub(crate) fn new(question: &'a ExamQuestion, answer: &'a Answer) -> Option<Self> {
        let table = question.question.table()?;
        let Key::Table {
            judged,
            rows,
            aggregate,
        } = &question.key
        else {
            return None;
        };
        if answer.names()? != table.output_names() {
            return None;
        }
        Some(TableAnswer {
            table,
            scales: Scales::new(table),
            judged: judged_quantities(table, judged, rows)?,
            expected: rows,
            aggregate: *aggregate,
            rows: answer.rows()?,
        })
    }

    /// Returns the quantities that are compared.
    pub(crate) fn judged(&self) -> &[Quantity] {
        &self.judged
    }

    /// Returns the rows that the submission answered.
    pub(crate) fn rows(&self) -> &[RowOutcome<'a>] {
        &self.rows
    }

    /// Returns a row whose call returned `got`.
    pub(crate) fn row<'b>(&self, index: usize, got: Option<&'b dyn Record>) -> Row<'b> {
        let wanted = self.expected.record(index);
        Row {
            got,
            scale: self.scales.of_row(index, wanted.as_deref()),
            wanted,
        }
    }

    /// Returns the deviations of all quantities in a row.
    fn deviations(&self, row: &Row) -> Vec<Deviation> {
        match (row.got, row.wanted.as_deref()) {
            (None, None) => Vec::new(),
            (Some(_), None) | (None, Some(_)) => vec![Deviation::WRONG],
            (Some(got), Some(wanted)) => {
                let judged = self.judged.iter();
                judged
                    .map(|quantity| quantity.deviation(got, wanted, row.scale))
                    .collect()
            }
        }
    }

    /// Returns the error in a row, if any.
    fn failure(&self, row: &Row) -> Option<FailureKind> {
        let deviations = self.deviations(row);
        let wrong = deviations.iter().position(|one| !one.is_right())?;
        Some(match (row.got, row.wanted.as_deref()) {
            (Some(got), Some(wanted)) => self.judged[wrong].failure(got, wanted),
            (got, wanted) => FailureKind::Wrong {
                what: self.presence().to_owned(),
                side: Some(Side::of_presence(got.is_some())),
                got: describe::answer::presence(self.table, got),
                wanted: describe::answer::presence(self.table, wanted),
            },
        })
    }

    /// Returns the name of the quantity that says whether there is a record.
    fn presence(&self) -> &'static str {
        if matches!(self.expected, ExpectedRows::OptionalDirections(_)) {
            SOME_OR_NONE
        } else {
            PRESENCE
        }
    }

    fn is_whole(&self) -> bool {
        self.rows.len() == self.expected.count()
    }

    fn is_picture(&self) -> bool {
        self.table.film().is_some()
    }

    /// Returns the deviations in each row.
    fn deviations_by_row(&self) -> impl Iterator<Item = Vec<Deviation>> {
        let rows = self.rows.iter().enumerate();
        rows.map(|(index, outcome)| {
            outcome_deviations(outcome, |got| self.deviations(&self.row(index, *got)))
        })
    }

    /// Returns the largest deviation in each row.
    fn worst_by_row(&self) -> impl Iterator<Item = Deviation> {
        self.deviations_by_row().map(|all| {
            let worst = all.into_iter().max_by(|a, b| a.value.total_cmp(&b.value));
            worst.unwrap_or(Deviation::RIGHT)
        })
    }
}

impl Comparison for TableAnswer<'_> {
    fn judge(&self) -> Judgement {
        if !self.is_whole() {
            return Judgement::protocol(
                "the number of answers differs from the number of questions",
            );
        }
        let rows = self.rows.iter().enumerate();
        let mut failures = rows.filter_map(|(index, outcome)| {
            let kind = match outcome {
                ElementOutcome::Value(got) => self.failure(&self.row(index, *got)),
                ElementOutcome::Panicked(panic) => Some(FailureKind::Panicked(panic.clone())),
                // Rows are skipped only after panics, so this is never the first failure.
                ElementOutcome::Skipped => Some(FailureKind::Protocol("skipped".to_owned())),
            };
            Some((index, kind?))
        });
        let Some((element, kind)) = failures.next() else {
            return Judgement::RIGHT;
        };
        let (wrong, all) = (1 + failures.count(), self.rows.len());
        let credit = match self.aggregate {
            Aggregate::EveryRow => Credit::NONE,
            Aggregate::ShareOfRows => Credit::by_count(wrong, all),
        };
        if credit == Credit::FULL {
            return Judgement::RIGHT;
        }
        Judgement {
            credit,
            failure: Some(Failure {
                element,
                kind,
                count: Some((wrong, all)),
            }),
        }
    }

    fn measure(&self) -> Vec<Measurement> {
        if !self.is_whole() {
            return worst_by_threshold([Deviation::WRONG]);
        }
        if self.aggregate == Aggregate::ShareOfRows {
            let allowed = Credit::tolerated(self.rows.len());
            let rows = self.worst_by_row().collect();
            return vec![Measurement::of_positions(
                rows,
                allowed,
                Threshold::PicturePositions,
            )];
        }
        worst_by_threshold(self.deviations_by_row().flatten())
    }

    fn positions(&self) -> Option<Vec<Position>> {
        let position = |(outcome, worst): (&RowOutcome, Deviation)| {
            outcome.value()?;
            Some(iter::once((Aspect::Direction, worst)).collect())
        };
        let rows = self.rows.iter().zip(self.worst_by_row());
        (self.is_whole() && self.is_picture()).then(|| rows.map(position).collect())
    }
}

/// The rows expected in a table.
pub(crate) struct ExpectedTable {
    /// The quantities that are compared.
    pub(crate) judged: Vec<Quantity>,
    /// Each row's record, if any, and the row's scale.
    pub(crate) rows: Vec<(Option<Box<dyn Record>>, f32)>,
}

impl ExpectedTable {
    /// Returns the expected rows, or `None` if the question isn't a table or its key doesn't fit.
    pub(crate) fn new(question: &ExamQuestion) -> Option<Self> {
        let table = question.question.table()?;
        let Key::Table { judged, rows, .. } = &question.key else {
            return None;
        };
        let scales = Scales::new(table);
        let expected = (0..rows.count()).map(|index| {
            let record = rows.record(index);
            let scale = scales.of_row(index, record.as_deref());
            (record, scale)
        });
        Some(ExpectedTable {
            judged: judged_quantities(table, judged, rows)?,
            rows: expected.collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use glam::{UVec2, Vec3};
    use protocol::{Geometry, Interval, PinholeCamera, Question, Ray, Rows, Table};

    use super::*;
    use crate::judge::{judge, mismatches};
    use crate::tests::{HIT, boxes, sphere};
    use crate::types::{direction, length};

    #[test]
    fn an_error_is_judged_by_the_scale_of_its_ray() {
        for from in [8.0, 800.0] {
            // Both hits are at the same distance, but the second ray's coordinates are larger.
            let ray = Ray::new(Vec3::X * from, -Vec3::X);
            let shapes = vec![sphere(Vec3::X * (from - 2.0), 1.0)];
            let hits = ExpectedRows::Hits(vec![Some(HIT)]);
            let question = ExamQuestion::new(
                Question::hits(Geometry::List { shapes }, vec![ray]),
                Key::table(&["distance"], hits),
            );
            let is_right = |tolerances: f32| {
                let mut hit = HIT;
                hit.distance += tolerances * length::TOLERANCE * from;
                let answer = Answer::Hits(vec![ElementOutcome::Value(Some(hit))]);
                judge(&question, &answer).failure.is_none()
            };
            assert!(is_right(0.5), "from {from}");
            assert!(!is_right(1.5), "from {from}");
        }
    }

    /// Returns a picture of one pixel whose rays all point along −z.
    fn pixel() -> ExamQuestion {
        let film = UVec2::ONE;
        let camera = PinholeCamera {
            vertical_fov: 90.0,
            aspect_ratio: 1.0,
            film,
        };
        let question = Question::SampleRay(Table {
            subject: camera,
            rows: Rows::Picture(film),
        });
        let directions = ExpectedRows::Rays(vec![Vec3::NEG_Z; question.count()]);
        let judged = ["origin", "direction", "range"];
        ExamQuestion::new(question, Key::share_of_rows(&judged, directions))
    }

    /// Returns an answer whose rays are all off by this many tolerances in origin and direction, and
    /// begin at this distance.
    fn rays(origin: f32, direction: f32, start: f32) -> Answer {
        let ray = Ray {
            origin: Vec3::X * (origin * length::TOLERANCE),
            dir: Vec3::NEG_Z + Vec3::X * (direction * direction::TOLERANCE),
            range: Interval::new(start, f32::INFINITY),
        };
        Answer::Rays(vec![ElementOutcome::Value(ray); pixel().question.count()])
    }

    #[test]
    fn the_first_quantity_that_is_wrong_is_named() {
        let what = |answer| match judge(&pixel().single(0), &answer).failure?.kind {
            FailureKind::Wrong { what, .. } => Some(what),
            other @ (FailureKind::Uneven { .. }
            | FailureKind::Panicked(_)
            | FailureKind::Protocol(_)) => panic!("{other:?}"),
        };
        let what = |origin, direction, start| what(rays(origin, direction, start).single(0)?);
        assert_eq!(what(2.0, 9.0, 1.0).as_deref(), Some("origin"));
        assert_eq!(what(0.5, 2.0, 1.0).as_deref(), Some("direction"));
        // The ends of a ray's range are constants, so no error is too small.
        assert_eq!(what(0.5, 0.5, 1e-6).as_deref(), Some("range"));
        assert_eq!(what(0.5, 0.5, 0.0), None);
    }

    #[test]
    fn the_largest_error_of_a_pixel_counts() {
        for (origin, direction) in [(3.0, 7.0), (7.0, 3.0)] {
            let mask = mismatches(&pixel(), &rays(origin, direction, 0.0)).unwrap();
            let deviation = mask[0].unwrap().deviation;
            assert!((deviation - 7.0).abs() < 0.01, "{deviation}");
        }
    }

    #[test]
    fn an_answer_of_another_function_is_wrong_even_where_nothing_is_hit() {
        let ray = Ray::new(Vec3::ZERO, Vec3::X);
        let question = boxes(Vec3::ONE, 2.0 * Vec3::ONE, &[ray]);
        let question = ExamQuestion::new(question, Key::spans(vec![None]));
        let spans = Answer::Spans(vec![ElementOutcome::Value(None)]);
        assert_eq!(judge(&question, &spans).credit, Credit::FULL);
        let hits = Answer::Hits(vec![ElementOutcome::Value(None)]);
        assert_eq!(judge(&question, &hits).credit, Credit::NONE);
    }
}
