//! Pictures as files.

use std::path::Path;

use image::{ImageFormat, Rgb32FImage, RgbImage};

use super::failure::Failure;
use crate::film::{Film, Tone};

/// Writes linear floats to an EXR file, and bytes for a screen to any other.
pub(super) fn write(film: &Film, tone: Tone, path: &Path) -> Result<(), Failure> {
    let (width, height) = film.size.into();
    let written = match ImageFormat::from_path(path) {
        Ok(ImageFormat::OpenExr) => {
            let floats = film.from_the_top().flat_map(|pixel| pixel.to_array());
            let image = Rgb32FImage::from_raw(width, height, floats.collect());
            image.expect(FITS).save(path)
        }
        _ => {
            let bytes = film.from_the_top().flat_map(|pixel| tone.bytes(pixel));
            let image = RgbImage::from_raw(width, height, bytes.collect());
            image.expect(FITS).save(path)
        }
    };
    written.map_err(|source| Failure::Unwritable {
        path: path.to_owned(),
        source,
    })
}

const FITS: &str = "a film holds as many pixels as its size says";
