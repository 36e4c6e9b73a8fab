//! The quantities of hits and rays that are compared, each with its own tolerance.

use glam::{Vec2, Vec3};
use protocol::{Interval, Ray, Trace};

use super::measure::{
    DIRECTION, LENGTH, UV, direction_error, length_error, point_error, unit_error, uv_error,
};
use super::{Deviation, FailureKind, Threshold};
use crate::describe;
use crate::exam::{HitCheck, RayCheck};

/// A quantity of a hit or of a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quantity {
    name: &'static str,
    /// The threshold of errors that have a size.
    threshold: Option<Threshold>,
    value: Value,
}

/// The value of a quantity.
#[derive(Clone, Copy, Debug)]
enum Value {
    /// A length along a ray.
    Length(f32),
    Point(Vec3),
    /// A direction, regardless of its length.
    Direction(Vec3),
    /// A vector that must have length one.
    Unit(Vec3),
    Uv(Vec2),
    /// The number of a material.
    Material(u32),
    /// The range of a camera ray, which has no end.
    Range(Interval),
}

impl Quantity {
    fn new(name: &'static str, threshold: Threshold, value: Value) -> Self {
        Quantity {
            name,
            threshold: Some(threshold),
            value,
        }
    }

    /// Returns the quantity of a hit to which a check applies.
    pub(crate) fn of_hit(check: HitCheck, hit: &Trace) -> Self {
        use Threshold as T;

        match check {
            HitCheck::Distance => {
                Quantity::new("distance", T::Distance, Value::Length(hit.distance))
            }
            HitCheck::Position => {
                Quantity::new("position", T::Position, Value::Point(hit.position))
            }
            HitCheck::Normal => Quantity::new("normal", T::Normal, Value::Direction(hit.normal)),
            HitCheck::UnitNormal => {
                let name = "length of the normal";
                Quantity::new(name, T::UnitLength, Value::Unit(hit.normal))
            }
            HitCheck::Uv => Quantity::new("uv", T::Uv, Value::Uv(hit.uv)),
            HitCheck::Origin => Quantity::new("origin", T::Origin, Value::Point(hit.origin)),
            HitCheck::Material => Quantity {
                name: "material",
                threshold: None,
                value: Value::Material(hit.material),
            },
        }
    }

    /// Returns the quantity of a camera ray to which a check applies.
    pub(crate) fn of_ray(check: RayCheck, ray: &Ray) -> Self {
        use Threshold as T;

        match check {
            RayCheck::Origin => Quantity::new("origin", T::Origin, Value::Point(ray.origin)),
            RayCheck::Direction => {
                Quantity::new("direction", T::Direction, Value::Direction(ray.dir))
            }
            RayCheck::UnitLength => {
                let name = "length of the direction";
                Quantity::new(name, T::UnitLength, Value::Unit(ray.dir))
            }
            RayCheck::Range => Quantity::new("range", T::Times, Value::Range(ray.range)),
        }
    }

    /// Returns how far the quantity deviates from the expected one.
    pub(super) fn deviation(self, wanted: Quantity, scale: f32) -> Deviation {
        let error = match (self.value, wanted.value) {
            (Value::Length(got), Value::Length(wanted)) => length_error(got, wanted, scale, LENGTH),
            (Value::Point(got), Value::Point(wanted)) => point_error(got, wanted, scale),
            (Value::Direction(got), Value::Direction(wanted)) => {
                direction_error(got, wanted, DIRECTION)
            }
            (Value::Unit(got), _) => unit_error(got),
            (Value::Uv(got), Value::Uv(wanted)) => uv_error(got, wanted),
            (Value::Material(got), Value::Material(wanted)) => {
                return Deviation::binary(got == wanted);
            }
            (Value::Range(got), Value::Range(wanted)) if got.max == wanted.max => {
                length_error(got.min, wanted.min, scale, LENGTH)
            }
            _ => return Deviation::WRONG,
        };
        Deviation {
            threshold: self.threshold,
            value: error,
        }
    }

    /// Returns the failure if the quantity is wrong.
    pub(super) fn failure(self, wanted: Quantity) -> FailureKind {
        FailureKind::Wrong {
            what: self.name.to_owned(),
            got: self.describe(),
            wanted: wanted.describe(),
        }
    }

    fn describe(self) -> String {
        match self.value {
            Value::Length(length) => describe::number(length),
            Value::Point(vector) | Value::Direction(vector) => describe::point(vector),
            Value::Unit(vector) => describe::number(vector.length()),
            Value::Uv(uv) => describe::uv(uv),
            Value::Material(number) => number.to_string(),
            Value::Range(range) => describe::interval(range),
        }
    }

    /// Returns the quantity in units of its tolerance.
    pub(crate) fn in_tolerances(self, scale: f32) -> Vec<f32> {
        match self.value {
            Value::Length(length) => lengths_in_tolerances(&[length], scale),
            Value::Point(point) => lengths_in_tolerances(&point.to_array(), scale),
            Value::Direction(direction) => {
                let unit = direction / direction.length();
                (unit / DIRECTION).to_array().to_vec()
            }
            Value::Unit(vector) => vec![vector.length() / DIRECTION],
            Value::Uv(uv) => (uv / UV).to_array().to_vec(),
            // Each material is far from the others.
            Value::Material(number) => vec![number as f32 / DIRECTION],
            // All mistakes that give the range an end are alike.
            Value::Range(Interval { min, max }) => {
                let end = if max.is_finite() { 0.0 } else { max };
                lengths_in_tolerances(&[min, end], scale)
            }
        }
    }
}

/// Returns lengths in units of their tolerance.
pub(crate) fn lengths_in_tolerances(lengths: &[f32], scale: f32) -> Vec<f32> {
    // Everything in a question can be at the origin.
    let tolerance = (LENGTH * scale).max(f32::MIN_POSITIVE);
    lengths.iter().map(|length| length / tolerance).collect()
}
