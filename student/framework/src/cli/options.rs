//! The command line, as data.

use std::path::PathBuf;

use clap::Parser;
use glam::UVec2;

use crate::integrator::RenderSettings;
use crate::scene::MAX_FILM_SIDE;
use crate::view::ViewMode;

/// Draws a scene with the code of a submission.
#[derive(Debug, Parser)]
#[command(
    name = "cargo render",
    bin_name = "cargo render",
    version,
    max_term_width = 100
)]
pub(super) struct Options {
    /// A scene file, or the name of one in the folder `scenes`
    pub(super) scene: PathBuf,

    /// The picture: .png for screens, .exr for linear floats [default: <scene's name>.png here]
    pub(super) out: Option<PathBuf>,

    /// The same as OUT
    #[arg(long = "out", value_name = "OUT", conflicts_with = "out")]
    pub(super) out_option: Option<PathBuf>,

    /// Pixels across and up [default: the scene's own]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(super) size: Option<UVec2>,

    /// Paths for each pixel
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) samples: u32,

    /// The most times that a path is scattered
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(..=10_000))]
    pub(super) bounces: u32,

    /// What all random numbers follow from
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(super) seed: u64,

    /// Threads to draw with; the picture is the same for any number [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,

    /// What the picture shows
    #[arg(long, value_enum, default_value_t = ViewMode::Shaded)]
    pub(super) view: ViewMode,

    /// Brighter or darker: each stop doubles the light (PNG only)
    #[arg(
        long,
        value_name = "STOPS",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub(super) exposure: f32,

    /// Only this pixel, counted from the bottom left, in words and without a picture
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub(super) pixel: Option<UVec2>,
}

impl Options {
    /// How much work to put into a picture of this size.
    pub(super) fn sampling(&self, film: UVec2) -> RenderSettings {
        RenderSettings {
            film,
            samples: self.samples,
            bounces: self.bounces,
            seed: self.seed,
        }
    }
}

fn size(text: &str) -> Result<UVec2, String> {
    let size = pair(text, 'x').ok_or("not a size, such as 640x480")?;
    let sides = size.to_array();
    if sides.iter().all(|side| (1..=MAX_FILM_SIDE).contains(side)) {
        Ok(size)
    } else {
        Err(format!("each side must be from 1 to {MAX_FILM_SIDE}"))
    }
}

fn pixel(text: &str) -> Result<UVec2, String> {
    pair(text, ',').ok_or_else(|| "not a pixel, such as 12,34".to_owned())
}

fn pair(text: &str, between: char) -> Option<UVec2> {
    let (x, y) = text.split_once(between)?;
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
    fn a_size_is_two_sides_within_bounds() {
        assert_eq!(size("640x480"), Ok(uvec2(640, 480)));
        assert!(size("640").is_err() && size("0x3").is_err() && size("axb").is_err());
        assert!(size("16384x1").is_ok() && size("16385x1").is_err());
    }
}
