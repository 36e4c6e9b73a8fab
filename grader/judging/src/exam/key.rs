//! Answer keys: the data that [`judge`](mod@crate::judge) compares answers with.

use glam::Vec3;
use protocol::{
    Answer, Color, Density, ElementOutcome, Fields, Fraction, Interval, LocalDirection, Output,
    Ray, Record, Scattered, Trace, Value, packed,
};
use serde::{Deserialize, Serialize};

/// The correct answers to one question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Key {
    /// Key for a table.
    Table {
        /// The quantities to compare, in addition to whether the function returns anything. Each is
        /// the name of a field in the result or, for the length of a direction, `unit_` followed by
        /// the direction's name.
        judged: Vec<String>,
        /// The expected row for each call.
        rows: ExpectedRows,
        /// How the rows' results are combined into credit.
        #[serde(default, skip_serializing_if = "Aggregate::is_default")]
        aggregate: Aggregate,
    },
    /// Key for a `Build` question: properties of the tree, and optionally its cost.
    Tree {
        /// Properties to check. Whether the nodes form a tree is always checked.
        checks: Vec<TreeCheck>,
        /// SAH cost of the tree from the exact sweep, which uses the best split at every node and
        /// the question's maximum leaf size. C_trav = C_isect = 1, and areas are divided by the
        /// root's area. `None` if the cost isn't checked.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        sweep_cost: Option<f64>,
    },
    /// Key for a picture of first hits. Partial credit depends on the number of correct positions.
    FirstHits {
        /// The expected first hit at each position.
        #[serde(with = "packed")]
        hits: Vec<Option<Surface>>,
        /// Additional correct answers, each with the index of its position. They exist where moving
        /// the ray by up to 1/2000 of a pixel along each axis makes it hit a different surface or
        /// nothing.
        #[serde(with = "packed")]
        alternatives: Vec<(u32, Option<Surface>)>,
    },
    /// Key for a table of directions that must be spread evenly over the sphere. Every direction
    /// must have length one. Any random numbers may lead to any direction.
    SpreadEvenly {
        /// The maximum χ² of the numbers of directions in cells of equal area.
        max_chi_squared: f64,
    },
    /// Key for a `Radiance` question.
    Radiance {
        /// The expected colour of each pixel in linear RGB, row by row from the bottom.
        #[serde(with = "packed")]
        pixels: Vec<Vec3>,
        /// Maximum number of pixels that may differ by more than 1%.
        max_wrong_pixels: u32,
    },
}

impl Key {
    /// Returns a key for a table that compares these quantities and requires every row to be right.
    pub fn table(judged: &[&str], rows: ExpectedRows) -> Key {
        Key::Table {
            judged: judged.iter().map(|name| (*name).to_owned()).collect(),
            rows,
            aggregate: Aggregate::EveryRow,
        }
    }

    /// Returns a key for a table where the credit depends on the share of correct rows.
    pub fn share_of_rows(judged: &[&str], rows: ExpectedRows) -> Key {
        let mut key = Key::table(judged, rows);
        if let Key::Table { aggregate, .. } = &mut key {
            *aggregate = Aggregate::ShareOfRows;
        }
        key
    }

    /// Returns the key for a table of the intervals that rays spend inside a box.
    pub fn spans(spans: Vec<Option<Interval>>) -> Key {
        Key::table(<Interval as Fields>::NAMES, ExpectedRows::Spans(spans))
    }

    /// Returns a correct answer, or `None` if many different answers are correct: for a tree, or for
    /// directions that must only be spread evenly.
    pub fn answer(&self) -> Option<Answer> {
        Some(match self {
            Key::Table { rows, .. } => rows.answer(),
            Key::FirstHits { hits, .. } => {
                let trace = |surface: &Surface| Trace {
                    distance: surface.depth,
                    position: Vec3::ZERO,
                    normal: surface.normal,
                    uv: surface.uv,
                    origin: Vec3::ZERO,
                    shape: 0,
                };
                Answer::Hits(values(hits.iter().map(|hit| hit.as_ref().map(trace))))
            }
            Key::Radiance { pixels, .. } => Answer::Picture(ElementOutcome::Value(pixels.clone())),
            Key::Tree { .. } | Key::SpreadEvenly { .. } => return None,
        })
    }
}

/// How the results of a table's rows are combined into credit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aggregate {
    /// Full credit if every row is right, and none otherwise.
    #[default]
    EveryRow,
    /// The fewer wrong rows, the more credit. A few wrong rows cost nothing.
    ShareOfRows,
}

impl Aggregate {
    fn is_default(&self) -> bool {
        *self == Aggregate::default()
    }
}

/// The rows a function should return.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExpectedRows {
    /// The directions of camera rays. Every ray starts at the origin, with range `[0, ∞)`.
    Rays(#[serde(with = "packed")] Vec<Vec3>),
    /// The rays' hits.
    Hits(#[serde(with = "packed")] Vec<Option<Trace>>),
    /// The intervals the rays spend inside a box.
    Spans(#[serde(with = "packed")] Vec<Option<Interval>>),
    /// Directions.
    Directions(#[serde(with = "packed")] Vec<LocalDirection>),
    /// Directions where there is one.
    OptionalDirections(#[serde(with = "packed")] Vec<Option<LocalDirection>>),
    /// How a material continues paths.
    Scattered(#[serde(with = "packed")] Vec<Scattered>),
    /// Values of the colour channels.
    Colors(#[serde(with = "packed")] Vec<Color>),
    /// Probability densities.
    Densities(#[serde(with = "packed")] Vec<Density>),
    /// Fractions of the light.
    Fractions(#[serde(with = "packed")] Vec<Fraction>),
}

/// Evaluates an expression with `$list` bound to the list of rows and, optionally, `$wrap` bound to
/// the variant that contains it. Camera rays are excluded, because only their directions are
/// stored.
macro_rules! with_list {
    ($rows:expr, rays($dirs:ident) => $rays:expr, $wrap:ident($list:ident) => $other:expr) => {
        with_list!(@ $rows, $dirs, $rays, $wrap, $list, $other,
            [Hits Spans Directions OptionalDirections Scattered Colors Densities Fractions])
    };
    (@ $rows:expr, $dirs:ident, $rays:expr, $wrap:ident, $list:ident, $other:expr,
        [$($variant:ident)+]) => {
        match $rows {
            ExpectedRows::Rays($dirs) => $rays,
            $(ExpectedRows::$variant($list) => {
                #[allow(unused_variables, reason = "not every expression needs the variant")]
                let $wrap = ExpectedRows::$variant;
                $other
            })+
        }
    };
}

impl ExpectedRows {
    /// Returns the number of rows.
    pub fn count(&self) -> usize {
        with_list!(self, rays(dirs) => dirs.len(), _wrap(list) => list.len())
    }

    /// Returns the names of the fields in each row.
    pub fn names(&self) -> &'static [&'static str] {
        fn of<T: Output>(_: &[T]) -> &'static [&'static str] {
            T::NAMES
        }
        with_list!(self, rays(_dirs) => <Ray as Output>::NAMES, _wrap(list) => of(list))
    }

    /// Returns whether the function should return something for a row.
    pub fn is_present(&self, row: usize) -> bool {
        self.record(row).is_some()
    }

    /// Returns the expected record for a row, or `None` if the function should return nothing or
    /// the row doesn't exist.
    pub fn record(&self, row: usize) -> Option<Box<dyn Record>> {
        fn boxed<T: Output>(rows: &[T], row: usize) -> Option<Box<dyn Record>> {
            Some(Box::new(rows.get(row)?.record()?.clone()))
        }
        with_list!(self,
            rays(dirs) => Some(Box::new(camera_ray(*dirs.get(row)?))),
            _wrap(list) => boxed(list, row)
        )
    }

    /// Returns the correct answer to a table with these rows.
    pub fn answer(&self) -> Answer {
        fn of<T: Output>(rows: &[T]) -> Answer {
            T::answer(values(rows.iter().cloned()))
        }
        with_list!(self,
            rays(dirs) => Answer::Rays(values(dirs.iter().map(|dir| camera_ray(*dir)))),
            _wrap(list) => of(list)
        )
    }

    /// Returns one of the rows.
    pub(super) fn single(&self, row: usize) -> ExpectedRows {
        with_list!(self,
            rays(dirs) => ExpectedRows::Rays(vec![dirs[row]]),
            wrap(list) => wrap(vec![list[row]])
        )
    }

    /// Returns the rows with `change` applied to the value of every field. Camera rays aren't
    /// changed.
    pub fn changed(&self, change: &dyn Fn(Value<'_>) -> Value<'static>) -> ExpectedRows {
        with_list!(self, rays(_dirs) => self.clone(), wrap(list) => {
            let mut rows = list.clone();
            for record in rows.iter_mut().filter_map(Output::record_mut) {
                (record as &mut dyn Record).change(change);
            }
            wrap(rows)
        })
    }
}

fn values<T>(rows: impl Iterator<Item = T>) -> Vec<ElementOutcome<T>> {
    rows.map(ElementOutcome::Value).collect()
}

/// Returns the camera ray with this direction.
fn camera_ray(dir: Vec3) -> Ray {
    Ray {
        origin: Vec3::ZERO,
        dir,
        range: Interval::AHEAD,
    }
}

/// A check on a tree. The checks are independent of each other: where a check needs correct boxes,
/// the judge computes them itself, so that points for a mistake are only deducted once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TreeCheck {
    /// Every primitive is in exactly one leaf.
    Partition,
    /// Every box contains all primitives below its node.
    Contains,
    /// No box exceeds the union of the primitives below it by more than 1e-4 of its diagonal.
    Tight,
    /// The primitives were split: every leaf contains fewer than half of them.
    Split,
    /// No leaf contains more than `max_leaf_size` primitives.
    LeafSize,
    /// No node with at most `max_leaf_size` primitives was split.
    Stops,
}

impl TreeCheck {
    /// Returns the requirement as part of a sentence about the tree.
    pub fn requirement(self) -> &'static str {
        match self {
            TreeCheck::Partition => "every primitive is in exactly one leaf",
            TreeCheck::Contains => "every box contains the primitives below it",
            TreeCheck::Tight => "no box is larger than necessary",
            TreeCheck::Split => "no leaf holds half or more of the primitives",
            TreeCheck::LeafSize => "no leaf holds more than `max_leaf_size` primitives",
            TreeCheck::Stops => "nodes with at most `max_leaf_size` primitives are leaves",
        }
    }
}

/// The correct hit at one position of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Distance along the ray.
    pub depth: f32,
    /// Unit surface normal at the hit.
    pub normal: Vec3,
    /// Texture coordinates at the hit.
    pub uv: glam::Vec2,
}

impl From<&Trace> for Surface {
    fn from(trace: &Trace) -> Self {
        Surface {
            depth: trace.distance,
            normal: trace.normal,
            uv: trace.uv,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::TreeCheck;

    #[test]
    fn each_check_of_a_tree_has_a_requirement_of_its_own() {
        let checks = [
            TreeCheck::Partition,
            TreeCheck::Contains,
            TreeCheck::Tight,
            TreeCheck::Split,
            TreeCheck::LeafSize,
            TreeCheck::Stops,
        ];
        let requirements: BTreeSet<&str> = checks.map(TreeCheck::requirement).into();
        assert_eq!(requirements.len(), checks.len());
    }
}
