//! Writes pictures to image files.

use std::path::Path;

use image::{ImageFormat, Rgb32FImage, RgbImage};

use super::error::RenderError;
use crate::film::{Film, Tone};

/// Writes a picture to a file. An EXR file stores linear floats. Other formats store bytes, whose
/// values are converted for a screen.
pub(super) fn write(film: &Film, tone: Tone, path: &Path) -> Result<(), RenderError> {
    let (width, height) = film.size.into();
    let written = match ImageFormat::from_path(path) {
        Ok(ImageFormat::OpenExr) => {
            let floats = film.pixels_top_down().flat_map(|pixel| pixel.to_array());
            let image = Rgb32FImage::from_raw(width, height, floats.collect());
            image.expect(FITS).save(path)
        }
        _ => {
            let bytes = film
                .pixels_top_down()
                .flat_map(|pixel| tone.to_bytes(pixel));
            let image = RgbImage::from_raw(width, height, bytes.collect());
            image.expect(FITS).save(path)
        }
    };
    written.map_err(|source| RenderError::Unwritable {
        path: path.to_owned(),
        source,
    })
}

const FITS: &str = "a film has as many pixels as its size says";
