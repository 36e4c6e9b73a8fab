//! The command-line options.

use std::path::PathBuf;

use clap::Parser;
use glam::UVec2;

use crate::harness::view::ViewMode;
use crate::scene::MAX_FILM_SIDE;

/// Renders a scene with your code
#[derive(Debug, Parser)]
#[command(
    name = "cargo render",
    bin_name = "cargo render",
    version,
    max_term_width = 100
)]
pub(super) struct Options {
    /// A scene file, or the name of one in the `scenes` folder
    pub(super) scene: PathBuf,

    /// The picture to write: .png for screens, .exr for linear floats [default: the scene's name
    /// with .png, in the current folder]
    pub(super) out: Option<PathBuf>,

    /// Same as OUT
    #[arg(long = "out", value_name = "OUT", conflicts_with = "out")]
    pub(super) out_option: Option<PathBuf>,

    /// Width and height in pixels [default: as in the scene]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(super) size: Option<UVec2>,

    /// Number of paths per pixel
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) samples: u32,

    /// Maximum number of bounces per path
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(..=10_000))]
    pub(super) bounces: u32,

    /// Seed for all random numbers
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(super) seed: u64,

    /// Number of threads, which doesn't affect the picture [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,

    /// Quantity to show in the picture [default: shaded, or clay until your path tracer is written]
    #[arg(long, value_enum)]
    pub(super) view: Option<ViewMode>,

    /// Let the framework find the hits, so that the camera is all you need from part one. The scene
    /// must consist of rectangles
    #[arg(long, conflicts_with = "bench")]
    pub(super) rectangles: bool,

    /// Exposure: each stop doubles the brightness (PNG only)
    #[arg(
        long,
        value_name = "STOPS",
        default_value_t = 0.0,
        allow_negative_numbers = true,
        value_parser = stops
    )]
    pub(super) exposure: f32,

    /// Instead of writing an image, print the hit and the radiance for this pixel (coordinates
    /// start at the bottom left)
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub(super) pixel: Option<UVec2>,

    /// Instead of writing an image, measure rays per second with one path per pixel and compare
    /// them with the last run
    #[arg(long, conflicts_with_all = ["out", "out_option", "pixel", "view", "samples"])]
    pub(super) bench: bool,
}

fn size(text: &str) -> Result<UVec2, String> {
    let size = pair(text, 'x').ok_or("expected a size such as 640x480")?;
    let sides = size.to_array();
    if sides.iter().all(|side| (1..=MAX_FILM_SIDE).contains(side)) {
        Ok(size)
    } else {
        Err(format!(
            "the width and height must be from 1 to {MAX_FILM_SIDE}"
        ))
    }
}

fn stops(text: &str) -> Result<f32, String> {
    let stops = text.parse().ok().filter(|stops: &f32| stops.abs() <= 100.0);
    stops.ok_or_else(|| "expected an exposure from -100 to 100 stops, such as 1.5".to_owned())
}

fn pixel(text: &str) -> Result<UVec2, String> {
    pair(text, ',').ok_or_else(|| "expected a pixel such as 12,34".to_owned())
}

/// Parses two numbers with a separator between them.
fn pair(text: &str, separator: char) -> Option<UVec2> {
    let (x, y) = text.split_once(separator)?;
    Some(UVec2::new(x.trim().parse().ok()?, y.trim().parse().ok()?))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use glam::uvec2;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Options::command().debug_assert();
    }

    #[test]
    fn an_exposure_is_a_number_of_stops() {
        assert_eq!(stops("-1.5"), Ok(-1.5));
        for text in ["nan", "inf", "-inf", "1e9", "bright"] {
            assert!(stops(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_size_is_two_sides_within_bounds() {
        assert_eq!(size("640x480"), Ok(uvec2(640, 480)));
        assert!(size("640").is_err() && size("0x3").is_err() && size("axb").is_err());
        assert!(size("16384x1").is_ok() && size("16385x1").is_err());
    }
}
