//! The light that arrives from far away in directions where no shape is in the way.

#[cfg(feature = "cli")]
use std::path::Path;
use std::sync::Arc;

use glam::{UVec2, Vec3};
#[cfg(feature = "cli")]
use image::{ImageFormat, ImageReader};
use serde::{Deserialize, Serialize};

use super::MAX_FILM_SIDE;

/// The light of the environment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Environment {
    /// The same radiance from all directions.
    Constant(Vec3),
    /// A picture of all directions.
    Map(EnvironmentMap),
}

/// A picture of all directions, as an equirectangular projection. The rows are evenly spaced in
/// angle from +y, at the top, down to −y. The columns are evenly spaced in angle around the y-axis:
/// the first begins at +x, and +z is a quarter of the way across.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(UVec2, Vec<Vec3>)", into = "(UVec2, Vec<Vec3>)")]
pub struct EnvironmentMap {
    size: UVec2,
    radiance: Arc<[Vec3]>,
}

impl TryFrom<(UVec2, Vec<Vec3>)> for EnvironmentMap {
    type Error = String;

    fn try_from((size, radiance): (UVec2, Vec<Vec3>)) -> Result<Self, String> {
        EnvironmentMap::new(size, radiance)
    }
}

impl From<EnvironmentMap> for (UVec2, Vec<Vec3>) {
    fn from(map: EnvironmentMap) -> Self {
        (map.size, map.radiance.to_vec())
    }
}

impl EnvironmentMap {
    /// Creates a map from its pixels, row by row from the top.
    ///
    /// # Errors
    /// Fails with a description if a map can't have this size or these pixels.
    pub fn new(size: UVec2, radiance: Vec<Vec3>) -> Result<Self, String> {
        let UVec2 {
            x: width,
            y: height,
        } = size;
        if width != 2 * height || width > MAX_FILM_SIDE || height == 0 {
            return Err(format!(
                "the map has {width} × {height} pixels, but a map of all directions must be twice \
                 as wide as it is high, and at most {MAX_FILM_SIDE} pixels wide"
            ));
        }
        if radiance.len() != (width * height) as usize {
            return Err(format!(
                "the map's size is {width} × {height}, but it has {} pixels",
                radiance.len()
            ));
        }
        let unusable = |pixel: &Vec3| match *pixel {
            pixel if pixel.is_nan() => Some("isn't a number"),
            pixel if !pixel.is_finite() => Some("is infinite"),
            pixel if pixel.min_element() < 0.0 => Some("is negative"),
            pixel if pixel.max_element() > LARGEST => Some("is larger than 1e9"),
            _ => None,
        };
        let mut pixels = radiance.iter().enumerate();
        if let Some((index, why)) =
            pixels.find_map(|(index, pixel)| Some((index, unusable(pixel)?)))
        {
            let (x, y) = (index % width as usize, index / width as usize);
            return Err(format!(
                "pixel {x},{y} of the map (coordinates start at the top left) {why}"
            ));
        }
        Ok(EnvironmentMap {
            size,
            radiance: radiance.into(),
        })
    }

    /// Loads a map from an HDR or EXR file. Its pixels are multiplied by `scale`.
    ///
    /// # Errors
    /// Fails with the reason the map can't be loaded.
    #[cfg(feature = "cli")]
    pub(super) fn load(path: &Path, scale: f32) -> Result<Self, String> {
        let in_file = |message: String| format!("{}: {message}", path.display());
        let reader = ImageReader::open(path)
            .and_then(ImageReader::with_guessed_format)
            .map_err(|error| in_file(format!("cannot read the file: {error}")))?;
        let format = reader.format();
        if !matches!(format, Some(ImageFormat::Hdr | ImageFormat::OpenExr)) {
            let message = "a map must be an HDR or EXR file, because other image formats don't store \
                radiance";
            return Err(in_file(message.to_owned()));
        }
        let decoded = reader.decode();
        let picture = decoded.map_err(|error| in_file(format!("the file is damaged: {error}")))?;
        let picture = picture.into_rgb32f();
        let size = UVec2::new(picture.width(), picture.height());
        let pixels = picture.pixels().map(|pixel| scale * Vec3::from(pixel.0));
        if pixels.clone().all(|pixel| pixel == Vec3::ZERO) {
            let message = "the map is completely black: leave out the environment";
            return Err(in_file(message.to_owned()));
        }
        EnvironmentMap::new(size, pixels.collect()).map_err(in_file)
    }

    /// Returns the number of columns and rows.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// Returns the pixels, row by row from the top.
    pub fn pixels(&self) -> &[Vec3] {
        &self.radiance
    }
}

/// The largest radiance that a pixel may have. Sums of larger values could overflow.
const LARGEST: f32 = 1e9;

#[cfg(test)]
mod tests {
    use glam::uvec2;

    use super::*;

    fn error(size: UVec2, pixels: &[Vec3]) -> String {
        EnvironmentMap::new(size, pixels.to_vec()).expect_err("the map is unusable")
    }

    #[test]
    fn unusable_maps_are_named_with_the_pixel() {
        let size = uvec2(4, 2);
        let with = |pixel: Vec3| {
            let mut pixels = [Vec3::ONE; 8];
            pixels[6] = pixel;
            error(size, &pixels)
        };
        for (pixel, why) in [
            (Vec3::new(0.0, -1.0, 0.0), "is negative"),
            (Vec3::new(f32::NAN, 0.0, 0.0), "isn't a number"),
            (Vec3::splat(f32::INFINITY), "is infinite"),
            (Vec3::splat(2e9), "is larger than 1e9"),
        ] {
            let expected =
                format!("pixel 2,1 of the map (coordinates start at the top left) {why}");
            assert_eq!(with(pixel), expected);
        }
        assert!(error(uvec2(3, 2), &[Vec3::ONE; 6]).contains("3 × 2 pixels"));
    }
}
