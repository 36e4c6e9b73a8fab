//! Encodes pictures as PNG.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::UVec2;
use judging::picture::Colour;

/// Encodes a picture as a data URI. The first row of `pixels` is the bottom row.
pub fn data_uri(film: UVec2, pixels: &[Colour]) -> String {
    let rows = pixels.rchunks(film.x as usize);
    let bytes: Vec<u8> = rows.flat_map(|row| row.as_flattened()).copied().collect();
    let png = STANDARD.encode(encode(film, &bytes));
    format!("data:image/png;base64,{png}")
}

/// Encodes the bytes of an RGB picture, row by row from the top. Speed matters more than size:
/// every run of the grader encodes pictures, but few of the reports are ever opened, and the
/// viewer's pictures rarely leave the machine.
///
/// # Panics
///
/// If the number of bytes doesn't match the size.
pub fn encode(film: UVec2, bytes: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, film.x, film.y);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::Fastest);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(bytes)?;
        writer.finish()
    });
    written.expect("the bytes match the size, and writing to memory cannot fail");
    file
}
