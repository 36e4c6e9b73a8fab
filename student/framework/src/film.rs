//! The picture: linear radiance as it is gathered, and what becomes of it on a screen.

use glam::{UVec2, Vec3};

use crate::math::pow;

/// A picture in linear red, green and blue.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// The number of pixels, across and up.
    pub size: UVec2,
    /// Row by row **from the bottom**, as the camera counts: pixel (0, 0) comes first.
    pub pixels: Vec<Vec3>,
}

/// How a picture's numbers become a screen's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tone {
    /// Radiance: times two to the power of `stops`, then sRGB.
    Light {
        /// Each one doubles the brightness.
        stops: f32,
    },
    /// Directions, distances and the like: as they are.
    Data,
}

impl Film {
    /// The pixels row by row **from the top**, as files of pictures count.
    pub fn pixels_top_down(&self) -> impl Iterator<Item = Vec3> {
        let width = self.size.x.max(1) as usize;
        self.pixels.chunks(width).rev().flatten().copied()
    }
}

impl Tone {
    /// Three bytes for the screen. What is out of `[0, 1]` is clamped.
    pub fn to_bytes(self, pixel: Vec3) -> [u8; 3] {
        let shown = match self {
            Tone::Light { stops } => (pixel * pow(2.0, stops)).to_array().map(srgb),
            Tone::Data => pixel.to_array(),
        };
        shown.map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8)
    }
}

/// The transfer curve of sRGB, IEC 61966-2-1, from linear light to the screen's numbers.
fn srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * pow(linear, 1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use glam::uvec2;

    use super::*;

    #[test]
    fn top_down_order_starts_with_the_upper_row() {
        let film = Film {
            size: uvec2(2, 2),
            pixels: (0..4).map(|n| Vec3::splat(n as f32)).collect(),
        };
        let reds: Vec<f32> = film.pixels_top_down().map(|pixel| pixel.x).collect();
        assert_eq!(reds, [2.0, 3.0, 0.0, 1.0]);
    }

    #[test]
    fn tones_follow_the_srgb_curve() {
        let tone = Tone::Light { stops: 0.0 };
        // 18 % grey is byte 118; the ends are the ends, and nothing wraps beyond them.
        let pixel = Vec3::new(0.18, 0.0, 1.0);
        assert_eq!(tone.to_bytes(pixel), [118, 0, 255]);
        assert_eq!(tone.to_bytes(Vec3::new(17.0, -1.0, 0.5)), [255, 0, 188]);
        assert_eq!(Tone::Data.to_bytes(Vec3::splat(0.5)), [128; 3]);
    }

    #[test]
    fn a_stop_doubles_the_light() {
        let dark = Tone::Light { stops: 1.0 }.to_bytes(Vec3::splat(0.09));
        assert_eq!(dark, Tone::Light { stops: 0.0 }.to_bytes(Vec3::splat(0.18)));
    }
}
