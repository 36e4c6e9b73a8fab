//! The command line of `cargo view`.

use std::path::PathBuf;

use clap::{Parser, value_parser};
use glam::UVec2;
use grader::handed_out::HandedOut;
use grader::question_ref::QuestionRef;

use crate::session::View;

/// The default port, used if it is free.
pub const DEFAULT_PORT: u16 = 8420;

/// Shows in the browser how your code draws a picture
#[derive(Clone, Debug, Parser)]
#[command(
    name = "cargo view",
    bin_name = "cargo view",
    version,
    max_term_width = 100
)]
pub struct Arguments {
    /// A scene in the `scenes` folder, or a scene file
    #[arg(default_value = "cornell-box", conflicts_with = "item")]
    pub scene: String,

    /// Show a question from the practice exam, such as traverse.prunes#3; without a number, show
    /// the item's first question
    #[arg(long, value_name = "ITEM#N")]
    pub item: Option<QuestionRef>,

    /// Quantity to show first [default: shaded; for a question, normals]
    #[arg(long, value_name = "VIEW", value_enum)]
    pub view: Option<View>,

    /// The assignment that --item and --submission refer to (course staff) [default: rays]
    #[arg(long, value_name = "ID", value_parser = HandedOut::find)]
    pub assignment: Option<&'static HandedOut>,

    /// Width and height in pixels [default: as in the scene]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,

    /// Number of paths per pixel
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = value_parser!(u32).range(1..=4096))]
    pub samples: u32,

    /// Maximum number of bounces per path
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = value_parser!(u32).range(..=10_000))]
    pub bounces: u32,

    /// Seed for all random numbers
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u64,

    /// Local port to serve the page on [default: 8420, or any free port]
    #[arg(long, value_name = "N")]
    pub port: Option<u16>,

    /// Do not open the page in a browser
    #[arg(long)]
    pub no_open: bool,

    /// Also accept this host name, such as a tunnel's; can be repeated
    #[arg(long, value_name = "NAME")]
    pub allow_host: Vec<String>,

    /// Number of programs that draw in parallel [default: one per core]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,

    /// Show the reference instead of your code (course staff)
    #[arg(long, conflicts_with = "submission")]
    pub reference: bool,

    /// Draw the shaded view with the reference's code for part two (course staff)
    #[arg(long)]
    pub reference_light: bool,

    /// Show this submission, a folder or an archive (course staff)
    #[arg(long, value_name = "PATH")]
    pub submission: Option<PathBuf>,

    /// Run the submission in a sandbox; use this for code that someone else wrote
    #[arg(long, requires = "submission")]
    pub untrusted: bool,
}

fn size(text: &str) -> Result<UVec2, String> {
    let side = |text: &str| {
        text.trim()
            .parse()
            .ok()
            .filter(|side| (1..=2048).contains(side))
    };
    let sides = text
        .split_once('x')
        .and_then(|(x, y)| Some(UVec2::new(side(x)?, side(y)?)));
    sides.ok_or_else(|| "expected a size such as 640x480, with sides from 1 to 2048".to_owned())
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn a_size_is_two_sides_within_bounds() {
        assert_eq!(size("640x480"), Ok(UVec2::new(640, 480)));
        assert!(size("640").is_err() && size("0x3").is_err() && size("2049x1").is_err());
    }
}
