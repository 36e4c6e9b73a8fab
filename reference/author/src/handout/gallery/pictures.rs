//! Draws the pictures of the gallery, with the program that students use.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use grader::files::AtPath;
use image::{RgbImage, imageops};
use judging::section::CHAPTERS;

use super::{Chapter, gallery};
use crate::authoring::Authoring;
use crate::bundle::{Bundle, BundleOptions, archive};
use crate::generated_file::Mode;
use crate::light::part_one;
use crate::solutions::catalogue::mistakes;
use crate::solutions::sources::Sources;

/// The folder where the pictures are drawn, relative to the workspace's root.
const FOLDER: &str = "target/gallery";
/// The size of a picture in pixels.
const SIZE: (u32, u32) = (240, 180);
/// The number of pictures in a row of a sheet.
const COLUMNS: u32 = 3;
/// The number of pixels between pictures.
const GAP: u32 = 6;
/// The colour of the gaps between pictures, which suits both light and dark pages.
const BACKGROUND: image::Rgb<u8> = image::Rgb([128, 128, 128]);
/// The maximum mean difference per byte between two sheets that are considered the same. It isn't 0
/// because different machines round differently.
const TOLERANCE: f64 = 0.5;

/// Draws the sheet of each chapter. Writes it, or compares it with the one in the handout.
pub fn write_or_check(root: &Path, authoring: &'static Authoring, mode: Mode) -> Result<()> {
    let workspace = Workspace::create(root, authoring)?;
    let mut outdated = Vec::new();
    for chapter in gallery(root, authoring)?.chapter {
        let sheet = workspace.sheet(root, authoring, &chapter)?;
        let path = root.join(CHAPTERS).join(chapter.sheet());
        match mode {
            Mode::Write => sheet
                .save(&path)
                .with_context(|| path.display().to_string())?,
            Mode::Check if is_same(&path, &sheet) => {}
            Mode::Check => outdated.push(chapter.sheet()),
        }
    }
    ensure!(
        outdated.is_empty(),
        "out of date: {}; run `cargo author gallery`",
        outdated.join(", ")
    );
    Ok(())
}

/// Returns whether a file contains almost the same picture.
fn is_same(path: &Path, picture: &RgbImage) -> bool {
    let Ok(found) = image::open(path) else {
        return false;
    };
    let found = found.to_rgb8();
    let pairs = found.as_raw().iter().zip(picture.as_raw());
    let difference: u64 = pairs.map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    let mean = difference as f64 / picture.as_raw().len() as f64;
    found.dimensions() == picture.dimensions() && mean <= TOLERANCE
}

/// A workspace like a student's, for rendering pictures with the code of solutions.
struct Workspace {
    folder: PathBuf,
    reference: Sources,
}

impl Workspace {
    /// Unpacks part one's bundle, which contains part two's solution, and adds the solution of part one.
    /// Compiled files stay in the folder and are reused the next time.
    fn create(root: &Path, authoring: &'static Authoring) -> Result<Self> {
        let folder = root.join(FOLDER);
        let part_one = part_one(authoring.handed_out);
        let bundle = Bundle::collect(root, part_one, BundleOptions::default())?;
        archive::write_files(&bundle, &folder)?;
        let reference = Sources::reference(root, authoring.handed_out)?;
        let workspace = Workspace { folder, reference };
        workspace.write(&Sources::reference(root, part_one)?)?;
        Ok(workspace)
    }

    /// Writes a solution to the folder of its assignment.
    fn write(&self, sources: &Sources) -> Result<()> {
        let folder = self.folder.join(sources.handed_out().student).join("src");
        Ok(sources.write(&folder).at("write", &folder)?)
    }

    /// Draws a chapter's pictures side by side: the reference's picture, then the mistakes'
    /// pictures.
    fn sheet(
        &self,
        root: &Path,
        authoring: &'static Authoring,
        chapter: &Chapter,
    ) -> Result<RgbImage> {
        let catalogue = mistakes(root, authoring.handed_out)?;
        let mut pictures = vec![self.picture(&self.reference, chapter)?];
        for id in &chapter.mistakes {
            let mistake = catalogue.iter().find(|mistake| mistake.id == *id);
            let mistake = mistake.with_context(|| format!("unknown mistake `{id}`"))?;
            let sources = mistake.solution(&self.reference)?.sources;
            pictures.push(self.picture(&sources, chapter)?);
        }
        let (width, height) = SIZE;
        let rows = (pictures.len() as u32).div_ceil(COLUMNS);
        let size = |count: u32, side: u32| count * (side + GAP) - GAP;
        let mut sheet = RgbImage::from_pixel(size(COLUMNS, width), size(rows, height), BACKGROUND);
        for (index, picture) in (0..).zip(&pictures) {
            let (column, row) = (index % COLUMNS, index / COLUMNS);
            let (x, y) = (column * (width + GAP), row * (height + GAP));
            imageops::replace(&mut sheet, picture, x.into(), y.into());
        }
        Ok(sheet)
    }

    /// Draws a chapter's picture with the code of a solution.
    fn picture(&self, sources: &Sources, chapter: &Chapter) -> Result<RgbImage> {
        self.write(sources)?;
        let (out, size) = ("target/picture.png", format!("{}x{}", SIZE.0, SIZE.1));
        let output = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
            .current_dir(&self.folder)
            .args(chapter.command().split_whitespace().skip(1))
            .args(["--size", &size, "--out", out])
            .env("CARGO_TARGET_DIR", self.folder.join("target"))
            .output()?;
        if !output.status.success() {
            bail!(
                "`{}` failed: {}",
                chapter.command(),
                String::from_utf8_lossy(&output.stderr)
            );
        }
        let path = self.folder.join(out);
        let picture = image::open(&path).with_context(|| path.display().to_string())?;
        Ok(picture.to_rgb8())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_may_differ_by_rounding_only() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("sheet.png");
        let picture = |byte| RgbImage::from_pixel(4, 3, image::Rgb([byte; 3]));
        assert!(!is_same(&path, &picture(100)), "there is no file");
        picture(100).save(&path).expect("the folder can be written");
        let mut rounded = picture(100);
        rounded.put_pixel(1, 1, image::Rgb([101; 3]));
        assert!(is_same(&path, &rounded));
        assert!(!is_same(&path, &picture(102)));
        assert!(!is_same(&path, &RgbImage::new(3, 4)));
    }
}
