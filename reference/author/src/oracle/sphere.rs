//! Rays and spheres: the closest approach to the centre, then half the chord to either side.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec2};

use super::{Intersection, Ray64};

/// A sphere, its numbers taken exactly.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    /// Its centre.
    pub center: DVec3,
    /// Its radius.
    pub radius: f64,
}

/// How a ray passes a sphere.
#[derive(Clone, Copy, Debug)]
pub struct LineIntersection {
    /// From the centre to the ray, where they are closest, in radii: below 1 they meet.
    pub closest_approach: f64,
    /// Where the ray enters and leaves, whatever its range; not numbers if they do not meet.
    pub roots: [f64; 2],
}

impl Sphere {
    /// How the ray's whole line passes the sphere.
    pub fn intersect_line(&self, beam: &Ray64) -> LineIntersection {
        let length = beam.dir.length();
        let closest = (self.center - beam.origin).dot(beam.dir) / (length * length);
        let miss_by = beam.at(closest).distance(self.center);
        let half_chord = (self.radius * self.radius - miss_by * miss_by).sqrt() / length;
        LineIntersection {
            closest_approach: miss_by / self.radius,
            roots: [closest - half_chord, closest + half_chord],
        }
    }

    /// Whether the ray's whole line passes through the sphere.
    pub fn is_hit_by_line(&self, beam: &Ray64) -> bool {
        let aside = (self.center - beam.origin).cross(beam.dir);
        aside.length_squared() <= self.radius * self.radius * beam.dir.length_squared()
    }

    /// Where the ray first meets the sphere within its range.
    pub fn intersect(&self, beam: &Ray64, material: u32) -> Option<Intersection> {
        let roots = self.intersect_line(beam).roots;
        let distance = roots.into_iter().find(|&root| beam.is_in_range(root))?;
        let position = beam.at(distance);
        let normal = (position - self.center).normalize();
        Some(Intersection {
            distance,
            position,
            normal,
            uv: uv(normal),
            material,
        })
    }
}

/// The texture coordinates in this direction from the centre: u once around the y-axis, from +x
/// over +z; v from 0 at −y to 1 at +y, by the angle.
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
    use crate::seed::Seed;

    const BALL: Sphere = Sphere {
        center: DVec3::new(1.0, 2.0, 3.0),
        radius: 2.0,
    };

    fn distance(ray: Ray) -> Option<f64> {
        BALL.intersect(&Ray64::from(&ray), 0)
            .map(|met| met.distance)
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

    #[test]
    fn both_roots_solve_the_quadratic() {
        let mut draw = Seed(2).rng("oracle");
        for _ in 0..1000 {
            let beam = Ray64 {
                origin: draw.point(6.0),
                dir: draw.direction() * draw.uniform(0.5, 2.0),
                min: 0.0,
                max: f64::INFINITY,
            };
            let o = beam.origin - BALL.center;
            let (a, b) = (beam.dir.dot(beam.dir), 2.0 * o.dot(beam.dir));
            let c = o.dot(o) - BALL.radius * BALL.radius;
            let discriminant = b * b - 4.0 * a * c;
            let passage = BALL.intersect_line(&beam);
            assert_eq!(passage.closest_approach <= 1.0, discriminant >= 0.0);
            if discriminant > 1e-6 {
                let near = (-b - discriminant.sqrt()) / (2.0 * a);
                let far = (-b + discriminant.sqrt()) / (2.0 * a);
                assert!((passage.roots[0] - near).abs() < 1e-8);
                assert!((passage.roots[1] - far).abs() < 1e-8);
            }
        }
    }
}
