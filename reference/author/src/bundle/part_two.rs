//! Part two in a bundle whose students only get it solved. Its viewer and renderer are compiled as
//! for other bundles, but there is nothing to grade.

use std::path::Path;

use anyhow::{Context, Result};
use grader::files;

use super::Bundle;
use crate::authoring;
use crate::light::LightFiles;

/// The file that lists the assignments.
const LIST: &str = "grader/src/handed_out/mod.rs";
/// The list, with and without part two.
const BOTH: &str = "[&HandedOut; 2] = [&RAYS, &LIGHT];";
const PART_ONE: &str = "[&HandedOut; 1] = [&RAYS];";

/// Adds the practice exam if students write part two. Otherwise, adds an empty file in its place
/// and removes part two from the list of assignments that can be graded.
pub(super) fn add_exam(root: &Path, light: LightFiles, bundle: &mut Bundle) -> Result<()> {
    let path = authoring::LIGHT.practice_exam;
    match light {
        LightFiles::Stubs => bundle.insert(path, files::read(root.join(path))?),
        LightFiles::Solved => {
            bundle.insert(path, "");
            let text = bundle.text(LIST).unwrap_or_default();
            let (before, after) = text
                .split_once(BOTH)
                .with_context(|| format!("{LIST} has no {BOTH:?}: update bundle/part_two.rs"))?;
            let text = format!("{before}{PART_ONE}{after}");
            bundle.insert(LIST, text);
        }
    }
    Ok(())
}
