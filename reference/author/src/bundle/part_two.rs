//! Removes part two from the sources of a bundle whose students only get it solved. Its assignment
//! embeds the stubs and an exam, and students of part one need neither.

use anyhow::{Context, Result};

use super::Bundle;

/// The files and folders that only part two needs.
const OWN: [&str; 2] = [
    "grader/judging/src/assignment/light/",
    "grader/src/handed_out/light.rs",
];
/// The lines that register the assignment: the file, the lines, and their replacement.
const REGISTERED: [(&str, &str, &str); 5] = [
    ("grader/judging/src/assignment/mod.rs", "mod light;\n", ""),
    (
        "grader/judging/src/assignment/mod.rs",
        "pub use light::{LIGHT, LIGHT_FILES};\n",
        "",
    ),
    ("grader/src/handed_out/mod.rs", "mod light;\n", ""),
    (
        "grader/src/handed_out/mod.rs",
        "pub use light::LIGHT;\n",
        "",
    ),
    (
        "grader/src/handed_out/mod.rs",
        "[&HandedOut; 2] = [&RAYS, &LIGHT];",
        "[&HandedOut; 1] = [&RAYS];",
    ),
];

/// Removes the assignment.
pub(super) fn remove(bundle: &mut Bundle) -> Result<()> {
    let is_own = |path: &str| OWN.iter().any(|own| path.starts_with(own));
    bundle.files.retain(|path, _| !is_own(path));
    for (path, lines, replacement) in REGISTERED {
        let text = bundle
            .text(path)
            .with_context(|| format!("{path} is missing"))?;
        let (before, after) = text
            .split_once(lines)
            .with_context(|| format!("{path} has no line {lines:?}: update bundle/part_two.rs"))?;
        let text = format!("{before}{replacement}{after}");
        bundle.insert(path, text);
    }
    Ok(())
}
