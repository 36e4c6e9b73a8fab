//! `cargo author handout`, and `cargo book`.

use std::path::{Path, PathBuf};

use super::{CommandResult, report};
use crate::cli::book_folder;
use crate::exams;
use crate::handout;

/// Checks the handout's pages, and builds the book if a folder is given.
#[allow(
    clippy::option_option,
    reason = "absent, without a value, with a value"
)]
pub(super) fn handout(root: &Path, book: Option<Option<PathBuf>>, students: bool) -> CommandResult {
    let problems = handout::problems(root, &exams::load_practice(root)?)?;
    report(
        &problems,
        "handout: every link, name and command was checked",
    )?;
    let Some(folder) = book else {
        return Ok(());
    };
    make_book(root, &root.join(book_folder(folder, students)), students)
}

#[cfg(feature = "book")]
fn make_book(root: &Path, folder: &Path, students: bool) -> CommandResult {
    if students {
        handout::book::build_for_students(
            &crate::bundle::Bundle::collect(root, super::HANDED_OUT, None)?,
            folder,
        )?;
    } else {
        handout::book::build(root, folder)?;
    }
    println!("{}", folder.join("index.html").display());
    Ok(())
}

#[cfg(not(feature = "book"))]
fn make_book(_: &Path, _: &Path, _: bool) -> CommandResult {
    anyhow::bail!("this program was built without mdBook: run `cargo book` instead")
}
