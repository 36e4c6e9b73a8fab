//! A picture of linear radiance, and its conversion to the colours of a screen.

use glam::{UVec2, Vec3};

use crate::math::pow;

/// A picture in linear red, green and blue.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// The width and height in pixels.
    pub size: UVec2,
    /// The pixels, row by row **from the bottom**, as for the camera: pixel (0, 0) comes first.
    pub pixels: Vec<Vec3>,
}

/// The conversion of a picture's values to the colours of a screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tone {
    /// For radiance: multiplies by two to the power of `stops`, then encodes as sRGB.
    Light {
        /// The exposure. Each stop doubles the brightness.
        stops: f32,
    },
    /// For data, such as directions and distances: leaves the values unchanged.
    Data,
}

impl Film {
    /// Returns the pixels row by row **from the top**, which is the order in image files.
    pub fn pixels_top_down(&self) -> impl Iterator<Item = Vec3> {
        let width = self.size.x.max(1) as usize;
        self.pixels.chunks(width).rev().flatten().copied()
    }
}

impl Tone {
    /// Converts a pixel to three bytes for the screen. Values outside `[0, 1]` are clamped.
    pub fn to_bytes(self, pixel: Vec3) -> [u8; 3] {
        let shown = match self {
            Tone::Light { stops } => (pixel * pow(2.0, stops)).to_array().map(srgb),
            Tone::Data => pixel.to_array(),
        };
        shown.map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8)
    }
}

/// Returns the luminance of a colour in linear red, green and blue. See ITU-R Recommendation BT.709.
#[inline]
pub fn luminance(colour: Vec3) -> f32 {
    colour.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// Applies the sRGB transfer function (IEC 61966-2-1), which encodes linear light for a screen.
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
        // 18% grey is byte 118. 0 and 1 become 0 and 255, and values outside this range don't wrap
        // around.
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
