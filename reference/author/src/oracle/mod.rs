//! What is true, in double precision and from the definitions: none of it is the formula that
//! students are taught, so that one slip can not hide in both.

pub mod bbox;
pub mod buckets;
pub mod camera;
pub mod scan;
pub mod sphere;
pub mod sweep;
pub mod triangle;

use glam::{DVec2, DVec3};
use grader::exam::{ExpectedHit, Surface};
use protocol::{Interval, Ray};

/// A ray as it was asked, its numbers taken exactly.
#[derive(Clone, Copy, Debug)]
pub struct Ray64 {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes: of length one, but for the rounding of the ray that was asked.
    pub dir: DVec3,
    /// The least distance that counts.
    pub min: f64,
    /// The largest distance that counts; may be infinite.
    pub max: f64,
}

impl Ray64 {
    /// The point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.dir
    }

    /// Whether the distance `t` counts.
    pub fn is_in_range(&self, t: f64) -> bool {
        self.min <= t && t <= self.max
    }

    /// The same ray, of which only this part counts.
    pub fn within(self, times: Interval) -> Ray64 {
        Ray64 {
            min: times.min.into(),
            max: times.max.into(),
            ..self
        }
    }

    /// The same ray from its start on, however far.
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

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// Along the ray.
    pub distance: f64,
    /// The point there.
    pub position: DVec3,
    /// The surface normal there, of length one.
    pub normal: DVec3,
    /// The texture coordinates there.
    pub uv: DVec2,
    /// The material of what was met.
    pub material: u32,
}

impl Intersection {
    /// As the key of a table.
    pub fn to_hit(&self) -> ExpectedHit {
        ExpectedHit {
            distance: self.distance as f32,
            position: self.position.as_vec3(),
            normal: self.normal.as_vec3(),
            uv: self.uv.as_vec2(),
            material: self.material,
        }
    }

    /// As the key of a picture.
    pub fn to_surface(&self) -> Surface {
        Surface {
            depth: self.distance as f32,
            normal: self.normal.as_vec3(),
            uv: self.uv.as_vec2(),
        }
    }
}
