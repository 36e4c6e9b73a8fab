//! Averages over the tests for all pixels, for the views that show tests and mistakes.

use serde::Serialize;
use view_probe::messages::{MarkedTests, Quantity, TestCounts};
use view_probe::rules::RULES;

use super::{Session, View};

/// Averages over the tests for all drawn pixels.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct TestsSummary {
    #[serde(flatten)]
    averages: TestAverages,
    /// The averages for the previous version of the code, if its picture from this camera was
    /// finished.
    before: Option<TestAverages>,
    /// The reason steps cannot be judged.
    problem: Option<&'static str>,
}

/// Averages over rays.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct TestAverages {
    /// The mean number of tests.
    mean: f64,
    /// The share of rays that break at least one rule.
    marked: f64,
    /// For each rule, the share of rays that break it.
    broken: [f64; RULES],
}

impl TestAverages {
    fn of(rays: &[MarkedTests]) -> Option<Self> {
        let share = |is: &dyn Fn(&MarkedTests) -> bool| {
            rays.iter().filter(|tests| is(tests)).count() as f64 / rays.len() as f64
        };
        let totals = rays.iter().map(|tests| f64::from(tests.counts.total()));
        (!rays.is_empty()).then(|| TestAverages {
            mean: totals.sum::<f64>() / rays.len() as f64,
            marked: share(&|tests| tests.marks != [0; RULES]),
            broken: std::array::from_fn(|rule| share(&|tests| tests.marks[rule] > 0)),
        })
    }
}

impl Session {
    /// Returns the averages for the page if the shown view needs them.
    pub(super) fn tests_summary(&self) -> Option<TestsSummary> {
        if self.shown.view.layer() != Quantity::Tests {
            return None;
        }
        let rays: Vec<MarkedTests> = self.picture.tests.values().flatten().collect();
        Some(TestsSummary {
            averages: TestAverages::of(&rays)?,
            before: self.averages_before,
            problem: self.judging_problem(&rays),
        })
    }

    /// Keeps the averages for the drawn picture, so that they can be compared with the averages for
    /// the next version of the code. Nothing is kept of an incomplete picture, since its averages
    /// can't be compared with others.
    pub(super) fn keep_averages(&mut self) {
        let tests = &self.picture.tests;
        let rays: Vec<MarkedTests> = tests.values().flatten().collect();
        self.averages_before = TestAverages::of(&rays).filter(|_| tests.tiles.is_complete());
    }

    fn judging_problem(&self, rays: &[MarkedTests]) -> Option<&'static str> {
        let size = self.tree_size().filter(|size| size.primitives > 0)?;
        let is_none =
            |number: fn(&TestCounts) -> u32| rays.iter().all(|tests| number(&tests.counts) == 0);
        match (size.nodes, self.shown.view) {
            (0, View::Mistakes) => {
                Some("There is no tree yet, so there are no steps that could be wrong.")
            }
            (0, _) => None,
            _ if !is_none(|counts| counts.boxes) => None,
            _ if is_none(|counts| counts.primitives) => Some(
                "`Bvh::hit` calls neither `BBox::hit` nor `Primitive::hit`, so the viewer cannot \
                 see its tests.",
            ),
            _ => Some(
                "`Bvh::hit` does not call `BBox::hit`, so the viewer cannot see which nodes it \
                 enters, and its steps are not judged.",
            ),
        }
    }
}
