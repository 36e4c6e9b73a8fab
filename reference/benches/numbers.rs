//! Random numbers that are the same on every machine.

use glam::{Vec3, vec3};

/// A random number generator. See Steele, Lea and Flood, "Fast Splittable Pseudorandom Number
/// Generators", 2014.
pub struct SplitMix64(pub u64);

impl SplitMix64 {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }

    /// Returns a point in the unit cube.
    pub fn point(&mut self) -> Vec3 {
        vec3(self.unit(), self.unit(), self.unit())
    }

    /// Returns a point in the ball of radius 1 around the origin, but not too close to the origin.
    pub fn in_ball(&mut self) -> Vec3 {
        loop {
            let point = 2.0 * self.point() - 1.0;
            if (0.01..1.0).contains(&point.length_squared()) {
                return point;
            }
        }
    }
}
