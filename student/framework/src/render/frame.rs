//! Coordinate frames around a direction, and direction sampling. The functions are small and called
//! on every path, so they are inlined into part two's crate.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::math::sin_cos;

/// An orthonormal frame: three perpendicular unit vectors.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    x: Vec3,
    y: Vec3,
    z: Vec3,
}

impl Frame {
    /// Creates a frame with the given z-axis, which must be a unit vector.
    ///
    /// See Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
    #[inline]
    pub fn from_z(z: Vec3) -> Self {
        let sign = 1.0_f32.copysign(z.z);
        let a = -1.0 / (sign + z.z);
        let b = z.x * z.y * a;
        Frame {
            x: Vec3::new(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x),
            y: Vec3::new(b, sign + z.y * z.y * a, -z.y),
            z,
        }
    }

    /// Converts a direction from this frame to world space.
    #[inline]
    pub fn to_world(self, v: Vec3) -> Vec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    /// Converts a direction from world space to this frame.
    #[inline]
    pub fn to_local(self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.z))
    }
}

/// Samples a direction in the hemisphere around +z with the density cosine / π, from two random
/// numbers.
///
/// Malley's method: samples a disc uniformly and projects the point up to the hemisphere.
#[inline]
pub fn sample_cosine_hemisphere(random: Vec2) -> Vec3 {
    let radius = random.x.sqrt();
    let (sin, cos) = sin_cos(TAU * random.y);
    Vec3::new(radius * cos, radius * sin, (1.0 - random.x).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_right_handed_around_any_direction() {
        let slanted = Vec3::new(1.0, -2.0, -3.0).normalize();
        for z in [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::NEG_Y, slanted] {
            let frame = Frame::from_z(z);
            assert!((frame.x.cross(frame.y) - z).length() < 1e-6, "{frame:?}");
            assert!(frame.x.dot(frame.y).abs() < 1e-6 && frame.x.is_normalized());
        }
    }

    #[test]
    fn cosine_directions_have_length_one_and_the_right_mean() {
        let side = 100_u16;
        let midpoint = |n: u16| (f32::from(n) + 0.5) / f32::from(side);
        let mut mean = 0.0;
        for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
            let direction = sample_cosine_hemisphere(Vec2::new(midpoint(i), midpoint(j)));
            assert!(direction.is_normalized());
            mean += direction.z / f32::from(side * side);
        }
        // The expected mean is ∫ cos² / π over the hemisphere.
        assert!((mean - 2.0 / 3.0).abs() < 1e-3, "{mean}");
    }
}
