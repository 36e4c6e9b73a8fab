//! Correct answers in double precision, computed from the definitions. The formulas differ from
//! those taught to students, so that a solution and its key cannot contain the same mistake.

pub mod bbox;
pub mod buckets;
pub mod camera;
pub mod light;
pub mod scan;
pub mod sphere;
pub mod sweep;
pub mod triangle;

use glam::{DVec2, DVec3};
use judging::exam::Surface;
use protocol::{Interval, Ray, Trace};

/// A question's ray, converted exactly to double precision.
#[derive(Clone, Copy, Debug)]
pub struct Ray64 {
    /// The point where the ray starts.
    pub origin: DVec3,
    /// The direction: a unit vector, apart from the rounding of the question's ray to single
    /// precision.
    pub dir: DVec3,
    /// The minimum distance of a valid hit.
    pub min: f64,
    /// The maximum distance of a valid hit. May be infinite.
    pub max: f64,
}

impl Ray64 {
    /// Returns the point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.dir
    }

    /// Returns whether the distance `t` is in the ray's range.
    pub fn is_in_range(&self, t: f64) -> bool {
        self.min <= t && t <= self.max
    }

    /// Returns this ray with its range replaced by `times`.
    pub fn within(self, times: Interval) -> Ray64 {
        Ray64 {
            min: times.min.into(),
            max: times.max.into(),
            ..self
        }
    }

    /// Returns the same ray with the range [0, ∞).
    pub fn ahead(self) -> Ray64 {
        self.within(Interval::AHEAD)
    }
}

impl From<&Ray> for Ray64 {
    fn from(ray: &Ray) -> Ray64 {
        Ray64 {
            origin: ray.origin.as_dvec3(),
            dir: ray.dir.as_dvec3(),
            min: ray.range.min.into(),
            max: ray.range.max.into(),
        }
    }
}

/// The intersection of a ray and a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// The distance along the ray.
    pub distance: f64,
    /// The point of the intersection.
    pub position: DVec3,
    /// The surface normal, a unit vector.
    pub normal: DVec3,
    /// The texture coordinates.
    pub uv: DVec2,
    /// The number of the shape.
    pub shape: u32,
}

impl Intersection {
    /// Converts the intersection to the trace expected for a ray.
    pub fn to_trace(&self, ray: &Ray) -> Trace {
        Trace {
            distance: self.distance as f32,
            position: self.position.as_vec3(),
            normal: self.normal.as_vec3(),
            uv: self.uv.as_vec2(),
            origin: ray.origin,
            shape: self.shape,
        }
    }

    /// Converts the intersection to the [`Surface`] that a picture's key stores.
    pub fn to_surface(&self) -> Surface {
        Surface {
            depth: self.distance as f32,
            normal: self.normal.as_vec3(),
            uv: self.uv.as_vec2(),
        }
    }
}
