//! The scale of a question: the magnitude of the numbers an answer is computed from. Rounding
//! errors grow with it, so lengths are compared relative to the scale, never absolutely.

use protocol::{AnyTable, Record, Value};

use crate::types;

/// The scale for questions without positions in space: the length of a unit vector.
const UNIT: f32 = 1.0;

/// The scales of a table's rows.
pub(crate) struct Scales<'a> {
    table: &'a dyn AnyTable,
    /// The largest coordinate of the subject.
    subject: Option<f32>,
}

impl<'a> Scales<'a> {
    pub(crate) fn new(table: &'a dyn AnyTable) -> Self {
        Scales {
            table,
            subject: largest_coordinate(table.subject()),
        }
    }

    /// Returns the scale of a row: the largest of its expected distance and the coordinates of the
    /// arguments and the subject.
    pub(crate) fn of_row(&self, row: usize, expected: Option<&dyn Record>) -> f32 {
        let input = self.table.input(row);
        let input = input.as_deref().and_then(largest_coordinate);
        let largest = self.subject.into_iter().chain(input).reduce(f32::max);
        let lengths = expected.into_iter().flat_map(|record| record.values());
        let lengths = lengths.filter_map(|value| {
            let Value::Length(length) = value else {
                return None;
            };
            Some(length.abs())
        });
        largest.map_or(UNIT, |largest| lengths.fold(largest, f32::max))
    }
}

/// Returns the scale of a picture: the largest coordinate of the eye and of the subject.
pub(crate) fn of_picture(table: &dyn AnyTable) -> f32 {
    Scales::new(table).of_row(0, None)
}

fn largest_coordinate(record: &dyn Record) -> Option<f32> {
    let coordinates = record.values();
    let coordinates = coordinates.filter_map(|value| types::of(&value).largest_coordinate());
    coordinates.reduce(f32::max)
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};
    use protocol::{Corners, Geometry, Interval, Query, Ray, Table, Trace};

    use super::*;

    fn scale(table: &dyn AnyTable, distance: Option<f32>) -> f32 {
        let trace = distance.map(|distance| Trace {
            distance,
            position: Vec3::ZERO,
            normal: Vec3::Z,
            uv: glam::Vec2::ZERO,
            origin: Vec3::ZERO,
            shape: 0,
        });
        let trace = trace.as_ref().map(|trace| trace as &dyn Record);
        Scales::new(table).of_row(0, trace)
    }

    #[test]
    fn the_largest_number_is_the_scale() {
        let sphere = crate::tests::sphere(vec3(0.0, -4.0, 1.0), 0.5);
        let ray = Ray::new(vec3(3.0, 0.0, 0.0), Vec3::X);
        let hits =
            |shapes, ray| Table::<protocol::Hit>::of_list(Geometry::List { shapes }, vec![ray]);
        assert_eq!(scale(&hits(vec![], ray), None), 3.0);
        assert_eq!(scale(&hits(vec![sphere], ray), None), 4.5);
        assert_eq!(scale(&hits(vec![sphere], ray), Some(7.0)), 7.0);
        assert_eq!(scale(&hits(vec![sphere], ray), Some(-7.0)), 7.0);
        let far = Ray {
            origin: Vec3::splat(-20.0),
            range: Interval::AHEAD,
            ..ray
        };
        assert_eq!(of_picture(&hits(vec![sphere], far)), 20.0);
        let times = Interval::new(0.0, 1e9);
        for (min, max, ray, expected) in [
            (Vec3::splat(-8.0), Vec3::ONE, ray, 8.0),
            (Vec3::ONE, Vec3::splat(8.0), ray, 8.0),
            (Vec3::ZERO, Vec3::ONE, far, 20.0),
        ] {
            let table = Table::<protocol::BBoxHit>::of_list(
                Corners { min, max },
                vec![Query { ray, times }],
            );
            assert_eq!(scale(&table, None), expected);
        }
    }
}
