//! Correct answers for part two in double precision.
//!
//! Lengths have no unit, angles are in radians, and colours are linear red, green and blue.
//! Radiance is per unit of projected area and per solid angle, and densities are per solid angle.
//! Directions have length one and lead away from the surface.
//!
//! Some answers depend on a decision, such as whether a ray passes an edge or whether glass
//! reflects. If a decision is close, a correct answer in single precision can differ completely
//! from the one computed here. So each function that decides something also returns the margin: how
//! far the numbers are from changing the decision. Questions with a small margin must be avoided.

pub mod environment;
pub mod flat_shape;
pub mod frame;
pub mod lambertian;
pub mod light_sources;
pub mod lights;
pub mod path_steps;
pub mod quad;
pub mod room;
mod scene_text;
pub mod specular;
pub mod spherical_light;
pub mod transport;

#[cfg(test)]
mod tests;

use glam::{DVec2, DVec3, UVec2};
use protocol::light::transport::{DirectSample, PathStart};
use protocol::sampler::{RandomNumbers, Sampler};

/// A sampled continuation of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered64 {
    /// The direction of the rest of the path, in the surface's frame.
    pub direction: DVec3,
    /// The factor, for each colour channel, applied to the light from this direction.
    pub attenuation: DVec3,
    /// The probability density of the direction, per solid angle, or `None` for mirrors and glass.
    pub pdf: Option<f64>,
}

/// A result and its margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithMargin<T> {
    /// The result.
    pub value: T,
    /// The smallest relative distance to any decision that the result depends on, or infinity if
    /// nothing was decided. Rounding to single precision moves a decision by about 1e-6.
    pub margin: f64,
}

impl<T> WithMargin<T> {
    /// Replaces the result and lowers the margin if `margin` is smaller.
    fn and<U>(self, value: U, margin: f64) -> WithMargin<U> {
        WithMargin {
            value,
            margin: self.margin.min(margin),
        }
    }
}

/// The random numbers for one bounce, each in `[0, 1)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers64 {
    /// The light to sample.
    pub light: f64,
    /// The point on that light.
    pub on_light: DVec2,
    /// The scattered direction in which a matte surface looks for direct light.
    pub direct: DVec2,
    /// The direction in which a matte surface scatters the path.
    pub scatter: DVec2,
    /// Whether glass reflects or refracts.
    pub reflect: f64,
    /// Whether the path goes on.
    pub survive: f64,
}

impl From<&RandomNumbers> for Numbers64 {
    /// Converts the numbers to double precision. This is exact.
    fn from(numbers: &RandomNumbers) -> Numbers64 {
        Numbers64 {
            light: numbers.light.into(),
            on_light: numbers.on_light.as_dvec2(),
            direct: numbers.direct.as_dvec2(),
            scatter: numbers.scatter.as_dvec2(),
            reflect: numbers.reflect.into(),
            survive: numbers.survive.into(),
        }
    }
}

impl From<&DirectSample> for Numbers64 {
    /// Returns the random numbers of a call of `direct`. The call doesn't use the other numbers.
    fn from(call: &DirectSample) -> Numbers64 {
        Numbers64::from(&RandomNumbers {
            light: call.light,
            on_light: call.on_light,
            direct: call.direct,
            scatter: call.direct,
            reflect: 0.0,
            survive: 0.0,
        })
    }
}

/// Returns the random numbers of a call of `radiance`, one set for each bounce.
pub fn numbers_of_path(call: &PathStart) -> Vec<Numbers64> {
    let sampler = Sampler::new(call.seed.into(), UVec2::ZERO, 0);
    let bounces = 0..call.bounces;
    bounces
        .map(|bounce| Numbers64::from(&sampler.numbers(bounce)))
        .collect()
}

/// Returns the luminance of a colour. See ITU-R Recommendation BT.709.
pub fn luminance(DVec3 { x, y, z }: DVec3) -> f64 {
    0.2126 * x + 0.7152 * y + 0.0722 * z
}

/// Returns the distance from a random number to the nearest border.
pub fn nearest_border(number: f64, borders: impl IntoIterator<Item = f64>) -> f64 {
    let distances = borders.into_iter().map(|border| (number - border).abs());
    distances.fold(f64::INFINITY, f64::min)
}

/// Returns the middles of `side` × `side` equal cells of the unit square.
#[cfg(test)]
fn grid(side: u32) -> impl Iterator<Item = DVec2> {
    let middle = move |n: u32| (f64::from(n) + 0.5) / f64::from(side);
    (0..side * side).map(move |n| DVec2::new(middle(n % side), middle(n / side)))
}

/// Returns a uniformly distributed direction for two uniformly distributed numbers in `[0, 1)`, by
/// Archimedes' theorem: projecting a sphere to the cylinder around it preserves areas.
#[cfg(test)]
fn uniform_sphere(random: DVec2) -> DVec3 {
    let y = 2.0 * random.y - 1.0;
    let radius = libm::sqrt((1.0 - y) * (1.0 + y));
    let (sine, cosine) = libm::sincos(std::f64::consts::TAU * random.x);
    DVec3::new(radius * cosine, y, radius * sine)
}
