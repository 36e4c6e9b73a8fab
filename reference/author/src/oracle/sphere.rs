//! Intersects rays with spheres: the two hits are half a chord before and half a chord after the
//! point where the ray's line is closest to the centre.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec2};

use super::{Intersection, Ray64};

/// A sphere, in double precision.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    /// The centre.
    pub center: DVec3,
    /// The radius.
    pub radius: f64,
}

/// How the whole line through a ray relates to a sphere.
#[derive(Clone, Copy, Debug)]
pub struct LineIntersection {
    /// The smallest distance from the centre to the line, as a multiple of the radius. The line
    /// hits the sphere if this distance is below 1.
    pub closest_approach: f64,
    /// The distances at which the line enters and leaves the sphere, or NaN if it misses the
    /// sphere.
    pub roots: [f64; 2],
}

impl Sphere {
    /// Intersects the ray's whole line with the sphere.
    pub fn intersect_line(&self, ray: &Ray64) -> LineIntersection {
        let length = ray.dir.length();
        let closest = (self.center - ray.origin).dot(ray.dir) / (length * length);
        let approach = ray.at(closest).distance(self.center);
        let half_chord = (self.radius * self.radius - approach * approach).sqrt() / length;
        LineIntersection {
            closest_approach: approach / self.radius,
            roots: [closest - half_chord, closest + half_chord],
        }
    }

    /// Returns the distance of the first intersection in the ray's range.
    pub fn hit_distance(&self, ray: &Ray64) -> Option<f64> {
        let roots = self.intersect_line(ray).roots;
        roots.into_iter().find(|&root| ray.is_in_range(root))
    }

    /// Returns the first intersection in the ray's range.
    pub fn intersect(&self, ray: &Ray64, shape: u32) -> Option<Intersection> {
        let distance = self.hit_distance(ray)?;
        let position = ray.at(distance);
        let normal = (position - self.center).normalize();
        Some(Intersection {
            distance,
            position,
            normal,
            uv: uv(normal),
            shape,
        })
    }
}

/// Returns the texture coordinates at the point in this direction from the centre. u goes once
/// around the y-axis, from +x toward +z. v is proportional to the angle, from 0 at −y to 1 at +y.
pub fn uv(dir: DVec3) -> DVec2 {
    let u = libm::atan2(dir.z, dir.x) / TAU;
    let v = libm::acos(-dir.y.clamp(-1.0, 1.0)) / PI;
    dvec2(if u < 0.0 { u + 1.0 } else { u }, v)
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};
    use protocol::Ray;

    use super::*;

    const SPHERE: Sphere = Sphere {
        center: DVec3::new(1.0, 2.0, 3.0),
        radius: 2.0,
    };

    fn distance(ray: Ray) -> Option<f64> {
        SPHERE
            .intersect(&Ray64::from(&ray), 0)
            .map(|hit| hit.distance)
    }

    #[test]
    fn distances_match_hand_computed_values() {
        let ray = Ray::new(vec3(1.0, 2.0, 13.0), Vec3::NEG_Z);
        assert_eq!(distance(ray), Some(8.0));
        assert_eq!(distance(ray.within(9.0, 99.0)), Some(12.0));
        assert_eq!(distance(ray.within(9.0, 11.0)), None);
        assert_eq!(distance(ray.within(0.0, 7.0)), None);
        assert_eq!(distance(Ray::new(vec3(1.0, 2.0, 3.0), Vec3::Y)), Some(2.0));
        assert_eq!(distance(Ray::new(vec3(1.0, 2.0, 13.0), Vec3::Z)), None);
        assert_eq!(distance(Ray::new(vec3(3.5, 2.0, 13.0), Vec3::NEG_Z)), None);
    }

    #[test]
    fn texture_coordinates_match_hand_computed_values() {
        assert_eq!(uv(DVec3::X), dvec2(0.0, 0.5));
        assert_eq!(uv(DVec3::Z), dvec2(0.25, 0.5));
        assert_eq!(uv(DVec3::NEG_Z), dvec2(0.75, 0.5));
        assert_eq!(uv(DVec3::Y).y, 1.0);
        assert_eq!(uv(DVec3::NEG_Y).y, 0.0);
    }
}
