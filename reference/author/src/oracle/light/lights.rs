//! Lists of lights, and sampling directions toward them. Points and directions are in world space.

use glam::{DVec2, DVec3, dvec2};

use super::flat_shape::{FlatShape, PlaneHit, determinant};
use super::spherical_light::SphericalLight64;
use super::{WithMargin, luminance, nearest_border};

/// A flat light. It emits at its front only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatLight64 {
    /// The shape.
    pub shape: FlatShape,
    /// The radiance that is emitted in every direction.
    pub radiance: DVec3,
}

/// A light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light64 {
    /// A flat light.
    Flat(FlatLight64),
    /// A sphere.
    Sphere(SphericalLight64),
}

/// The lights of a scene that have power.
#[derive(Clone, Debug)]
pub struct Lights64 {
    lights: Vec<Light64>,
    /// For each light, the probability that it is picked.
    shares: Vec<f64>,
}

impl FlatLight64 {
    /// Returns the power up to a constant factor: the area times the luminance.
    pub fn power(&self) -> f64 {
        self.shape.area() * luminance(self.radiance)
    }

    /// Returns the point on the light for two random numbers in `[0, 1)`.
    ///
    /// In a triangle, the line through the point and parallel to the far side cuts off a smaller
    /// triangle at the first corner. `random.x` is that triangle's fraction of the area, and
    /// `random.y` is the position on the line.
    pub fn point(&self, random: DVec2) -> DVec3 {
        if !self.shape.is_triangle {
            return self.shape.at(random);
        }
        let scale = libm::sqrt(random.x);
        let line = [dvec2(scale, 0.0), dvec2(0.0, scale)];
        self.shape.at(line[0].lerp(line[1], random.y))
    }

    /// Returns the probability density, per solid angle, of a direction if points on the light are
    /// sampled uniformly. It is zero if the direction misses the light, and from behind.
    ///
    /// Let v be the vector to the point at `along`. When `along` changes, the solid angle changes at
    /// the rate |det(e0, e1, v)| / |v|³. The density of `along` is 1, or 2 for a triangle, whose
    /// range is half a unit square.
    pub fn pdf(&self, from: DVec3, direction: DVec3) -> f64 {
        let Some(hit) = self.front_hit(from, direction) else {
            return 0.0;
        };
        let [e0, e1] = self.shape.edges;
        let v = hit.distance * direction;
        let length = v.length();
        let density = if self.shape.is_triangle { 2.0 } else { 1.0 };
        density * length * length * length / determinant(e0, e1, v).abs()
    }

    /// Returns the hit of a ray on the front of the light.
    fn front_hit(&self, from: DVec3, direction: DVec3) -> Option<PlaneHit> {
        let hit = self.shape.intersect_plane(from, direction);
        hit.filter(|hit| hit.is_hit() && hit.cosine < 0.0)
    }
}

impl Light64 {
    /// Returns the light if it is flat.
    pub fn flat(self) -> Option<FlatLight64> {
        match self {
            Light64::Flat(light) => Some(light),
            Light64::Sphere(_) => None,
        }
    }

    /// Returns the light if it is a sphere.
    pub fn sphere(self) -> Option<SphericalLight64> {
        match self {
            Light64::Sphere(light) => Some(light),
            Light64::Flat(_) => None,
        }
    }

    /// Returns the radiance that is emitted in every direction.
    pub fn radiance(&self) -> DVec3 {
        match self {
            Light64::Flat(light) => light.radiance,
            Light64::Sphere(light) => light.radiance,
        }
    }

    /// Returns the power up to a constant factor.
    pub fn power(&self) -> f64 {
        match self {
            Light64::Flat(light) => light.power(),
            Light64::Sphere(light) => light.power(),
        }
    }

    /// Samples a unit direction to the light. Returns `None` if the light faces away. The margin is
    /// how far it is from that.
    pub fn sample(&self, from: DVec3, random: DVec2) -> WithMargin<Option<DVec3>> {
        let light = match self {
            Light64::Flat(light) => light,
            Light64::Sphere(light) => return light.sample(from, random),
        };
        let direction = (light.point(random) - from).normalize();
        let cosine = direction.dot(light.shape.normal());
        WithMargin {
            value: (cosine < 0.0).then_some(direction),
            margin: cosine.abs(),
        }
    }

    /// Returns the probability density, per solid angle, of a direction if only this light is
    /// sampled. The margin is how far the direction is from the light's edges and its plane.
    fn pdf(&self, from: DVec3, direction: DVec3) -> WithMargin<f64> {
        let light = match self {
            Light64::Flat(light) => light,
            Light64::Sphere(light) => return light.pdf(from, direction),
        };
        let hit = light.shape.intersect_plane(from, direction);
        WithMargin {
            value: light.pdf(from, direction),
            margin: hit.map_or(f64::INFINITY, |hit| hit.margin()),
        }
    }
}

impl From<FlatLight64> for Light64 {
    fn from(light: FlatLight64) -> Self {
        Light64::Flat(light)
    }
}

impl Lights64 {
    /// Creates a list of lights. Lights without power are left out.
    pub fn new(lights: impl IntoIterator<Item = impl Into<Light64>>) -> Lights64 {
        let lights = lights.into_iter().map(Into::into);
        let lights: Vec<Light64> = lights.filter(|light| light.power() > 0.0).collect();
        let total: f64 = lights.iter().map(Light64::power).sum();
        let shares = lights.iter().map(|light| light.power() / total).collect();
        Lights64 { lights, shares }
    }

    /// Returns whether there are no lights with power.
    pub fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }

    /// Samples a unit direction to a light. `choice` picks the light by its share of the power, and
    /// `random` the point on it. Returns `None` if there are no lights, or if the light that was
    /// picked faces away.
    ///
    /// The margin is the distance of `choice` from the nearest border between two lights, or that of
    /// the sample of the light, whichever is less.
    pub fn sample(&self, from: DVec3, choice: f64, random: DVec2) -> WithMargin<Option<DVec3>> {
        let margin = nearest_border(choice, self.borders());
        let Some(light) = self.picked(choice) else {
            return WithMargin {
                value: None,
                margin,
            };
        };
        let sample = light.sample(from, random);
        sample.and(sample.value, margin)
    }

    /// Returns the light that a random number picks.
    pub fn picked(&self, choice: f64) -> Option<&Light64> {
        let index = self.borders().filter(|&border| border <= choice).count();
        self.lights.get(index)
    }

    /// Returns the start and the end of each light's share.
    pub fn portions(&self) -> Vec<[f64; 2]> {
        let ends = self.shares.iter().scan(0.0, |sum, share| {
            let start = *sum;
            *sum += share;
            Some([start, *sum])
        });
        ends.collect()
    }

    /// Returns the starts of all shares but the first.
    fn borders(&self) -> impl Iterator<Item = f64> {
        self.portions().into_iter().skip(1).map(|[start, _]| start)
    }

    /// Returns the probability density, per solid angle, with which [`Lights64::sample`] chooses a
    /// direction. The expected value over all lights: each light that is hit counts, even if
    /// another light is in front of it.
    ///
    /// The margin is the smallest one of all lights.
    pub fn pdf(&self, from: DVec3, direction: DVec3) -> WithMargin<f64> {
        let nowhere = WithMargin {
            value: 0.0,
            margin: f64::INFINITY,
        };
        let with_shares = self.lights.iter().zip(&self.shares);
        with_shares.fold(nowhere, |sum, (light, share)| {
            let pdf = light.pdf(from, direction);
            sum.and(sum.value + share * pdf.value, pdf.margin)
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::dvec3;

    use super::*;
    use crate::oracle::light::{grid, uniform_sphere};

    fn light(is_triangle: bool, radiance: f64) -> FlatLight64 {
        FlatLight64 {
            shape: FlatShape {
                corner: dvec3(-1.0, 2.0, -1.0),
                edges: [dvec3(2.0, 0.5, 0.0), dvec3(0.5, 0.0, 2.5)],
                is_triangle,
            },
            radiance: DVec3::splat(radiance),
        }
    }

    /// Returns the solid angle of a triangle at the origin. See van Oosterom and Strackee, "The
    /// Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng. 30(2), 1983.
    fn solid_angle(corners: [DVec3; 3]) -> f64 {
        let [a, b, c] = corners.map(DVec3::normalize);
        let denominator = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
        2.0 * libm::atan2(determinant(a, b, c).abs(), denominator)
    }

    fn subtended(light: &FlatLight64) -> f64 {
        let [c00, c10, c01, c11] =
            [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE].map(|along| light.shape.at(along));
        let near = solid_angle([c00, c10, c01]);
        if light.shape.is_triangle {
            near
        } else {
            near + solid_angle([c10, c11, c01])
        }
    }

    #[test]
    fn samples_have_the_density_that_is_returned() {
        // The mean of 1 / pdf over all samples is the light's solid angle.
        for light in [light(false, 1.0), light(true, 1.0)] {
            let lights = Lights64::new([light]);
            let side = 200;
            let inverse = grid(side).map(|random| {
                let direction = lights.sample(DVec3::ZERO, 0.5, random).value;
                let direction = direction.expect("the light is seen from its front");
                1.0 / lights.pdf(DVec3::ZERO, direction).value
            });
            let mean = inverse.sum::<f64>() / f64::from(side * side);
            assert!((mean / subtended(&light) - 1.0).abs() < 1e-4, "{mean}");
        }
    }

    #[test]
    fn the_density_integrates_to_one_over_all_directions() {
        let lights = Lights64::new([light(true, 1.0), light(false, 3.0)]);
        let side = 800;
        let densities = grid(side).map(|at| lights.pdf(DVec3::ZERO, uniform_sphere(at)).value);
        let total = densities.sum::<f64>() * 4.0 * PI / f64::from(side * side);
        assert!((total - 1.0).abs() < 2e-3, "{total}");
    }

    #[test]
    fn densities_match_hand_computed_values() {
        let square = FlatLight64 {
            shape: FlatShape {
                corner: dvec3(-1.0, 3.0, -1.0),
                edges: [2.0 * DVec3::X, 2.0 * DVec3::Z],
                is_triangle: false,
            },
            radiance: DVec3::ONE,
        };
        assert!((square.pdf(DVec3::ZERO, DVec3::Y) - 9.0 / 4.0).abs() < 1e-14);
        let slanted = square.pdf(4.0 * DVec3::X, dvec3(-0.8, 0.6, 0.0));
        assert!((slanted - 25.0 / 2.4).abs() < 1e-13);
        // Past the light, behind it and facing away from it.
        assert_eq!(square.pdf(4.0 * DVec3::X, DVec3::Y), 0.0);
        assert_eq!(square.pdf(6.0 * DVec3::Y, DVec3::NEG_Y), 0.0);
        assert_eq!(square.pdf(DVec3::ZERO, DVec3::NEG_Y), 0.0);
    }

    #[test]
    fn lights_are_picked_by_power_in_order() {
        let moved = FlatLight64 {
            shape: FlatShape {
                corner: dvec3(-9.0, 2.0, -1.0),
                ..light(false, 3.0).shape
            },
            ..light(false, 3.0)
        };
        let lights = Lights64::new([light(false, 1.0), light(true, 0.0), moved]);
        let sample = |choice| lights.sample(DVec3::ZERO, choice, dvec2(0.5, 0.5));
        for (choice, center, margin) in [
            (0.2, light(false, 1.0).shape.at(dvec2(0.5, 0.5)), 0.05),
            (0.3, moved.shape.at(dvec2(0.5, 0.5)), 0.05),
        ] {
            let WithMargin {
                value,
                margin: found,
            } = sample(choice);
            assert!(value.unwrap().abs_diff_eq(center.normalize(), 1e-15));
            assert!((found - margin).abs() < 1e-14, "{found}");
        }
    }

    #[test]
    fn without_a_light_that_faces_the_point_there_is_no_direction() {
        let lights = Lights64::new([light(false, 1.0)]);
        let above = 9.0 * DVec3::Y;
        assert_eq!(lights.sample(above, 0.5, dvec2(0.5, 0.5)).value, None);
        let none = Lights64::new(Vec::<Light64>::new());
        assert_eq!(none.sample(above, 0.5, dvec2(0.5, 0.5)).value, None);
        assert_eq!(none.pdf(above, DVec3::NEG_Y).value, 0.0);
    }
}
