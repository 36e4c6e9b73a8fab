//! Encodes small pictures, to embed them in the page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::UVec2;

use judging::picture::Colour;

/// Encodes a picture as a data URI. The first row of `pixels` is the bottom row.
pub(super) fn data_uri(film: UVec2, pixels: &[Colour]) -> String {
    let mut bytes = Vec::with_capacity(pixels.as_flattened().len());
    for row in pixels.rchunks(film.x as usize) {
        bytes.extend_from_slice(row.as_flattened());
    }
    let png =
        encode(film, &bytes).expect("the pixels match the film, and writing to memory cannot fail");
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

fn encode(film: UVec2, bytes: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, film.x, film.y);
    encoder.set_color(png::ColorType::Rgb);
    // Speed matters more than size: every run encodes pictures, and few pages are ever opened.
    encoder.set_compression(png::Compression::Fastest);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    writer.finish()?;
    Ok(out)
}
