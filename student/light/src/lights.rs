//! Part two, step 3: sampling the lights.
//!
//! ```text
//!       ┌─────────────────┐  an area light, which emits on one side
//!       └───────┬─────────┘
//!        normal ▼  ╱ θ             The same part of the light covers a smaller solid angle from
//!                 ╱                farther away and at a slant, so its directions have a higher
//!       distance ╱                 density:
//!               ╱
//!         from o                   pdf = distance² / (cos θ · area)
//! ```

use framework::render::film::luminance;
use framework::render::offset::{along_ray, coordinate_error};
use framework::render::sphere_light::SphereLight;
use glam::{Vec2, Vec3};
use protocol::Shape;

/// A flat light in the shape of a parallelogram or a triangle. It only emits on the side that its
/// normal points to.
#[derive(Clone, Copy, Debug)]
pub struct AreaLight {
    /// A corner.
    pub corner: Vec3,
    /// The two edges at that corner.
    pub edges: [Vec3; 2],
    /// The unit normal on the side that emits light.
    pub normal: Vec3,
    /// The area.
    pub area: f32,
    /// The radiance that is emitted in every direction.
    pub radiance: Vec3,
    /// Whether this is the half of the parallelogram next to the corner.
    pub is_triangle: bool,
    /// For each edge, the vector whose dot product with that edge is 1, and whose dot products with
    /// the other edge and the normal are 0.
    inverse: [Vec3; 2],
}

/// A light.
#[derive(Clone, Copy, Debug)]
pub enum Light {
    /// A flat light.
    Area(AreaLight),
    /// A sphere, whose sampling is given.
    Sphere(SphereLight),
}

/// The lights of a scene.
#[derive(Clone, Debug)]
pub struct Lights {
    lights: Vec<Light>,
    /// The sum of the lights' powers.
    power: f32,
}

impl AreaLight {
    /// Creates a light in the shape of a parallelogram. It emits on the side from which the turn
    /// from the first edge to the second looks counterclockwise.
    pub fn parallelogram(corner: Vec3, edges: [Vec3; 2], radiance: Vec3) -> Self {
        let [e0, e1] = edges;
        let cross = e0.cross(e1);
        let normal = cross.normalize_or_zero();
        let area = cross.length();
        AreaLight {
            corner,
            edges,
            normal,
            area,
            radiance,
            is_triangle: false,
            inverse: [e1.cross(normal) / area, normal.cross(e0) / area],
        }
    }

    /// Creates a light in the shape of a triangle. It emits on the side from which its corners
    /// appear in counterclockwise order.
    pub fn triangle([p0, p1, p2]: [Vec3; 3], radiance: Vec3) -> Self {
        let whole = AreaLight::parallelogram(p0, [p1 - p0, p2 - p0], radiance);
        AreaLight {
            area: 0.5 * whole.area,
            is_triangle: true,
            ..whole
        }
    }

    /// Returns the point on the light for two random numbers in `[0, 1)`. The points are evenly
    /// distributed.
    pub fn point(&self, random: Vec2) -> Vec3 {
        let (a, b) = if self.is_triangle {
            // See Turk, "Generating Random Points in Triangles", Graphics Gems, 1990.
            let root = random.x.sqrt();
            (root * (1.0 - random.y), root * random.y)
        } else {
            (random.x, random.y)
        };
        self.corner + a * self.edges[0] + b * self.edges[1]
    }

    /// Returns the distance from a point to the light in a direction, which must be a unit vector,
    /// or `None` if the light isn't in this direction. The light can be intersected from both
    /// sides.
    pub fn intersect(&self, from: Vec3, direction: Vec3) -> Option<f32> {
        let distance = (self.corner - from).dot(self.normal) / direction.dot(self.normal);
        let from_corner = from + distance * direction - self.corner;
        // The position in units of the edges, with a margin: a sampled point must be on the light
        // even where rounding moves it across an edge.
        let [a, b] = self.inverse.map(|inverse| from_corner.dot(inverse));
        let error = coordinate_error(from, self.corner);
        let [a_margin, b_margin] = self.inverse.map(|inverse| error * inverse.length());
        let is_above = a >= -a_margin && b >= -b_margin;
        let is_below = if self.is_triangle {
            a + b <= 1.0 + a_margin + b_margin
        } else {
            a <= 1.0 + a_margin && b <= 1.0 + b_margin
        };
        let is_ahead = distance > 0.0 && distance < f32::INFINITY;
        (is_ahead && is_above && is_below).then_some(distance)
    }

    /// Returns the probability density, per solid angle, of a direction from a point to the light
    /// if points on the light are sampled uniformly: distance² / (cos θ · area), where θ is the
    /// angle between the light's normal and the direction back to the point. See Shirley, Wang and
    /// Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", ACM TOG 15(1), 1996,
    /// section 3.
    ///
    /// - `direction` has length one. The given [`AreaLight::intersect`] finds the distance.
    /// - The result is zero if the direction misses the light, and from behind, where the light
    ///   doesn't emit.
    /// - It doesn't matter whether something else is in the way.
    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        todo!("part two, lights: what is the density of samples at {from:?} toward {direction:?}?")
    }
}

impl Light {
    /// Returns the power up to a constant factor: the area times the luminance.
    pub fn power(&self) -> f32 {
        match self {
            Light::Area(light) => light.area * luminance(light.radiance),
            Light::Sphere(light) => light.power(),
        }
    }

    /// Returns the distance from a point to the light in a direction, which must be a unit vector.
    pub fn intersect(&self, from: Vec3, direction: Vec3) -> Option<f32> {
        match self {
            Light::Area(light) => light.intersect(from, direction),
            Light::Sphere(light) => light.intersect(from, direction),
        }
    }

    /// Returns the radiance that the light emits toward a point from which it is seen in this
    /// direction. An area light is dark from behind.
    pub fn emitted(&self, direction: Vec3) -> Vec3 {
        match self {
            Light::Area(light) if direction.dot(light.normal) >= 0.0 => Vec3::ZERO,
            Light::Area(light) => light.radiance,
            Light::Sphere(light) => light.radiance,
        }
    }

    /// Returns how far in front of the light a ray from a point must end so that it doesn't hit the
    /// light itself.
    pub fn margin(&self, from: Vec3, distance: f32, direction: Vec3) -> f32 {
        let shape = match *self {
            Light::Area(AreaLight { corner, edges, .. }) => Shape::FlatTriangle {
                corners: [corner, corner + edges[0], corner + edges[1]],
                shape: 0,
            },
            Light::Sphere(SphereLight { center, radius, .. }) => Shape::Sphere {
                center,
                radius,
                shape: 0,
            },
        };
        along_ray(&shape, from, from + distance * direction, direction)
    }

    /// Returns the probability density, per solid angle, of a direction from a point to the light if
    /// only this light is sampled.
    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        match self {
            Light::Area(light) => light.pdf(from, direction),
            Light::Sphere(light) => light.pdf(from, direction),
        }
    }
}

impl Lights {
    /// Creates a list of lights. Lights without power are left out.
    pub fn new(mut lights: Vec<Light>) -> Self {
        lights.retain(|light| light.power() > 0.0);
        let power = lights.iter().map(Light::power).sum();
        Lights { lights, power }
    }

    /// Returns whether there are no lights.
    pub fn is_empty(&self) -> bool {
        self.power == 0.0
    }

    /// Returns the light that is nearest to a point in a direction, and its distance.
    pub fn nearest(&self, from: Vec3, direction: Vec3) -> Option<(&Light, f32)> {
        let mut nearest: Option<(&Light, f32)> = None;
        for light in &self.lights {
            if let Some(distance) = light.intersect(from, direction)
                && nearest.is_none_or(|(_, least)| distance < least)
            {
                nearest = Some((light, distance));
            }
        }
        nearest
    }

    /// Samples a direction from a point to a light with random numbers in `[0, 1)`.
    ///
    /// - `choice` picks the light: a light's share of `[0, 1)` is its share of the power, in the
    ///   order of the list. Numbers at the border between two lights are not tested.
    /// - `random` picks the point on that light: see [`AreaLight::point`]. The result is the
    ///   direction to that point, as a unit vector.
    /// - The result is `None` if there are no lights, or if the light that was picked faces away.
    ///   No other light is picked instead.
    /// - Shapes and other lights that are in the way are ignored.
    pub fn sample(&self, from: Vec3, choice: f32, random: Vec2) -> Option<Vec3> {
        todo!("part two, lights: which way leads from {from:?} to {random:?} on light {choice}?")
    }

    /// Returns the probability density, per solid angle, with which [`Lights::sample`] chooses a
    /// direction from a point.
    ///
    /// - Every light in that direction adds its density, given by [`Light::pdf`], times the
    ///   probability that it is picked. A light adds its density even if another light is in front
    ///   of it.
    /// - The result is zero if there are no lights.
    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        todo!("part two, lights: with what density is {direction:?} sampled at {from:?}?")
    }
}

#[cfg(test)]
mod tests {
    use glam::{vec2, vec3};

    use super::*;

    /// A square with sides of length 2 that is parallel to the floor and emits downward.
    fn square(center: Vec3, radiance: f32) -> AreaLight {
        let corner = center - vec3(1.0, 0.0, 1.0);
        let edges = [2.0 * Vec3::X, 2.0 * Vec3::Z];
        AreaLight::parallelogram(corner, edges, Vec3::splat(radiance))
    }

    #[track_caller]
    fn assert_density(got: f32, expected: f32) {
        assert!(
            (got - expected).abs() <= 1e-4 * expected,
            "expected {expected}, got {got}"
        );
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn the_density_of_a_light_grows_with_distance_and_slant() {
        let light = square(3.0 * Vec3::Y, 1.0);
        assert_density(light.pdf(Vec3::ZERO, Vec3::Y), 9.0 / 4.0);
        // From 4 to the side, the distance is 5 and the cosine 3/5.
        let toward_center = vec3(-0.8, 0.6, 0.0);
        assert_density(light.pdf(4.0 * Vec3::X, toward_center), 25.0 / (0.6 * 4.0));
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn past_a_light_and_from_behind_there_is_no_density() {
        let light = square(3.0 * Vec3::Y, 1.0);
        assert_density(light.pdf(4.0 * Vec3::X, Vec3::Y), 0.0);
        assert_density(light.pdf(6.0 * Vec3::Y, Vec3::NEG_Y), 0.0);
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn a_light_is_picked_by_its_share_of_the_power() {
        let (dim, bright) = (square(3.0 * Vec3::Y, 1.0), square(vec3(4.0, 3.0, 0.0), 3.0));
        let lights = Lights::new(vec![Light::Area(dim), Light::Area(bright)]);
        let sample = |choice| lights.sample(Vec3::ZERO, choice, vec2(0.5, 0.5));
        for (choice, expected) in [(0.2, Vec3::Y), (0.3, vec3(0.8, 0.6, 0.0))] {
            let got = sample(choice).expect("expected a direction, got None");
            assert!(
                got.abs_diff_eq(expected, 1e-5),
                "expected {expected}, got {got}"
            );
        }
        assert_density(lights.pdf(Vec3::ZERO, Vec3::Y), 0.25 * 9.0 / 4.0);
    }

    #[ignore = "part two: run by `cargo examples`"]
    #[test]
    fn a_light_that_faces_away_gives_no_direction() {
        let lights = Lights::new(vec![Light::Area(square(3.0 * Vec3::Y, 1.0))]);
        let above = 6.0 * Vec3::Y;
        assert_eq!(lights.sample(above, 0.5, vec2(0.5, 0.5)), None);
    }
}
