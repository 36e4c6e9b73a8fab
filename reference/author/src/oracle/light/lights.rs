//! Flat lights, and sampling directions toward them. Points and directions are in world space.

use glam::{DVec2, DVec3, dvec2};

use super::flat_shape::{FlatShape, PlaneHit, determinant};
use super::{WithMargin, luminance, nearest_border};

/// A flat light. It emits at its front only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatLight64 {
    /// The shape.
    pub shape: FlatShape,
    /// The radiance that is emitted in every direction.
    pub radiance: DVec3,
}

/// The lights of a scene that have power.
#[derive(Clone, Debug)]
pub struct Lights64 {
    lights: Vec<FlatLight64>,
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

impl Lights64 {
    /// Creates a list of lights. Lights without power are left out.
    pub fn new(lights: impl IntoIterator<Item = FlatLight64>) -> Lights64 {
        let has_power = |light: &FlatLight64| light.power() > 0.0;
        let lights: Vec<FlatLight64> = lights.into_iter().filter(has_power).collect();
        let total: f64 = lights.iter().map(FlatLight64::power).sum();
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
    /// The margin is the distance of `choice` from the nearest border between two lights, or the
    /// cosine at the light, whichever is less.
    pub fn sample(&self, from: DVec3, choice: f64, random: DVec2) -> WithMargin<Option<DVec3>> {
        // The starts of all shares but the first.
        let borders = self.shares.iter().scan(0.0, |sum, share| {
            *sum += share;
            Some(*sum)
        });
        let borders: Vec<f64> = borders.take(self.lights.len().saturating_sub(1)).collect();
        let margin = nearest_border(choice, borders.iter().copied());
        let index = borders.iter().filter(|&&border| border <= choice).count();
        let Some(light) = self.lights.get(index) else {
            return WithMargin {
                value: None,
                margin,
            };
        };
        let direction = (light.point(random) - from).normalize();
        let cosine = direction.dot(light.shape.normal());
        WithMargin {
            value: (cosine < 0.0).then_some(direction),
            margin: margin.min(cosine.abs()),
        }
    }

    /// Returns the probability density, per solid angle, with which [`Lights64::sample`] chooses a
    /// direction. The expected value over all lights: each light that is hit counts, even if
    /// another light is in front of it.
    ///
    /// The margin is how far the direction is from the edges and the planes of the lights.
    pub fn pdf(&self, from: DVec3, direction: DVec3) -> WithMargin<f64> {
        let with_shares = self.lights.iter().zip(&self.shares);
        let value = with_shares.map(|(light, share)| share * light.pdf(from, direction));
        let hits = self.lights.iter();
        let hits = hits.filter_map(|light| light.shape.intersect_plane(from, direction));
        WithMargin {
            value: value.sum(),
            margin: hits.map(|hit| hit.margin()).fold(f64::INFINITY, f64::min),
        }
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
        let none = Lights64::new([]);
        assert_eq!(none.sample(above, 0.5, dvec2(0.5, 0.5)).value, None);
        assert_eq!(none.pdf(above, DVec3::NEG_Y).value, 0.0);
    }
}
