//! `cargo author handout`, and `cargo book`.

use std::path::{Path, PathBuf};

use super::{CommandResult, report};
use crate::authoring::Authoring;
use crate::cli::book_folder;
use crate::exams;
use crate::handout;

/// Checks the handout's pages. Builds the book if a folder is given.
#[allow(
    clippy::option_option,
    reason = "the option can be absent, have no value, or have a value"
)]
pub(super) fn handout(
    root: &Path,
    authoring: &Authoring,
    book: Option<Option<PathBuf>>,
    students: bool,
) -> CommandResult {
    let practice = exams::load_practice(root, authoring)?;
    let problems = handout::problems(root, authoring.handed_out.assignment, &practice)?;
    report(
        &problems,
        "handout: all links, names and commands are valid",
    )?;
    let Some(folder) = book else {
        return Ok(());
    };
    let folder = root.join(book_folder(folder, students));
    make_book(root, authoring, &folder, students)
}

#[cfg(feature = "book")]
fn make_book(root: &Path, authoring: &Authoring, folder: &Path, students: bool) -> CommandResult {
    if students {
        handout::book::build_for_students(
            &crate::bundle::Bundle::collect(
                root,
                authoring.handed_out,
                crate::bundle::BundleOptions::default(),
            )?,
            folder,
        )?;
    } else {
        handout::book::build(root, folder)?;
    }
    println!("{}", folder.join("index.html").display());
    Ok(())
}

#[cfg(not(feature = "book"))]
fn make_book(_: &Path, _: &Authoring, _: &Path, _: bool) -> CommandResult {
    anyhow::bail!("this program was built without mdBook: run `cargo book` instead")
}
