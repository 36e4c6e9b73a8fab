//! Writes pictures to image files.

use std::path::Path;

use image::{ImageFormat, Rgb32FImage, RgbImage};

use super::error::RenderError;
use crate::render::film::{Film, Tone};

/// Writes a picture to a file atomically, so that a reader never sees an incomplete file. An EXR
/// file stores linear floats. Other formats store bytes, converted for display on a screen.
pub(super) fn write(film: &Film, tone: Tone, path: &Path) -> Result<(), RenderError> {
    let (width, height) = film.size.into();
    let part = path.with_added_extension("part");
    let format = ImageFormat::from_path(path).unwrap_or(ImageFormat::Png);
    let written = match format {
        ImageFormat::OpenExr => {
            let floats = film.pixels_top_down().flat_map(|pixel| pixel.to_array());
            let image = Rgb32FImage::from_raw(width, height, floats.collect());
            image.expect(FITS).save_with_format(&part, format)
        }
        _ => {
            let bytes = film
                .pixels_top_down()
                .flat_map(|pixel| tone.to_bytes(pixel));
            let image = RgbImage::from_raw(width, height, bytes.collect());
            image.expect(FITS).save_with_format(&part, format)
        }
    };
    let written = written.and_then(|()| Ok(std::fs::rename(&part, path)?));
    written.map_err(|error| RenderError::Other(format!("cannot write {}: {error}", path.display())))
}

/// Returns whether a file's format stores arbitrary numbers, rather than colours for a screen.
pub(super) fn holds_numbers(path: &Path) -> bool {
    matches!(ImageFormat::from_path(path), Ok(ImageFormat::OpenExr))
}

const FITS: &str = "a film has as many pixels as its size specifies";
