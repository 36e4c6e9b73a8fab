//! Places: the same question elsewhere in space, and at another size. Code that depends on absolute
//! sizes, or on being near the origin, is right in one place and wrong in another.

use glam::{DVec3, Vec3};
use protocol::{Interval, Ray, Shape};

use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

/// A size and a place. Questions are drawn with sizes of about one, near the origin, and then moved
/// here.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    scale: f64,
    offset: DVec3,
}

impl Place {
    /// Returns a place like that of the Cornell box: coordinates of several hundred, and sizes of
    /// about a hundred.
    pub(super) fn room(rng: &mut Rng) -> Self {
        Place {
            scale: rng.uniform(60.0, 100.0),
            offset: rng.point(300.0),
        }
    }

    /// Returns a place for things that are a hundredth as large. They are so close to the origin
    /// that coordinates have enough digits for them.
    pub(super) fn miniature(rng: &mut Rng) -> Self {
        Place {
            scale: 0.01,
            offset: rng.point(0.2),
        }
    }

    /// Returns a place far from the origin for things of the same size, whose coordinates have the
    /// same sign on each axis.
    pub(super) fn elsewhere(rng: &mut Rng) -> Self {
        let mut far = || rng.sign() * rng.uniform(60.0, 120.0);
        Place {
            scale: 1.0,
            offset: DVec3::new(far(), far(), far()),
        }
    }

    fn point(self, point: Vec3) -> Vec3 {
        (point.as_dvec3() * self.scale + self.offset).as_vec3()
    }

    /// Moves a shape here.
    pub(super) fn shape(self, shape: &Shape) -> Shape {
        let length = |length: f32| (f64::from(length) * self.scale) as f32;
        moved_shape(shape, |point| self.point(point), length)
    }

    /// Moves all shapes here.
    pub(super) fn shapes(self, shapes: &[Shape]) -> Vec<Shape> {
        shapes.iter().map(|shape| self.shape(shape)).collect()
    }

    /// Moves a ray here.
    pub(super) fn ray(self, ray: &Ray) -> Ray {
        Ray {
            origin: self.point(ray.origin),
            range: self.interval(ray.range),
            ..*ray
        }
    }

    /// Scales times along a ray.
    pub(super) fn interval(self, times: Interval) -> Interval {
        let scaled = |time: f32| (f64::from(time) * self.scale) as f32;
        Interval::new(scaled(times.min), scaled(times.max))
    }

    /// Moves a box here. Its corners stay exact in single precision.
    pub(super) fn bounds(self, bounds: &Bounds) -> Bounds {
        let moved = |corner: DVec3| self.point(corner.as_vec3()).as_dvec3();
        Bounds {
            min: moved(bounds.min),
            max: moved(bounds.max),
        }
    }
}

/// Returns a shape whose points and lengths are moved.
pub(super) fn moved_shape(
    shape: &Shape,
    point: impl Fn(Vec3) -> Vec3,
    length: impl Fn(f32) -> f32,
) -> Shape {
    let mut shape = *shape;
    match &mut shape {
        Shape::Triangle { vertices, .. } => {
            for vertex in vertices {
                vertex.position = point(vertex.position);
            }
        }
        Shape::FlatTriangle { corners, .. } => *corners = corners.map(point),
        Shape::Sphere { center, radius, .. } => {
            *center = point(*center);
            *radius = length(*radius);
        }
    }
    shape
}
