//! The handout as a book: pages that need no network and no script but the book's own.

mod formulas;
mod pages;
mod pictures;

use std::path::Path;

use mdbook_driver::MDBook;
use mdbook_driver::book::{Book, BookItem};
use mdbook_driver::errors::Error;

use self::formulas::with_formulas;
use self::pages::problems;
use self::pictures::with_pictures;
use crate::proof::sources::Unreadable;

/// Why there is no book.
#[derive(Debug, thiserror::Error)]
pub enum NoBook {
    /// A formula is none.
    #[error("{0}; mend the formula in handout/src")]
    Formula(#[from] formulas::NoFormula),
    /// A page is not as the chapters mean it.
    #[error("the book is not whole:\n{}", .0.join("\n"))]
    NotWhole(Vec<String>),
    /// A page or chapter can not be read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// mdBook can not make it.
    #[error("mdBook: {0:#}")]
    Driver(Error),
}

/// Makes the book of the workspace at `root` into the folder `to`.
pub fn build(root: &Path, to: &Path) -> Result<(), NoBook> {
    let mut book = MDBook::load(root.join("handout")).map_err(NoBook::Driver)?;
    book.config.build.build_dir = to.to_owned();
    prepare(&mut book.book)?;
    book.build().map_err(NoBook::Driver)?;
    match problems(root, to)? {
        problems if problems.is_empty() => Ok(()),
        problems => Err(NoBook::NotWhole(problems)),
    }
}

/// Puts MathML in the place of formulas, and drawings in the place of pictures.
fn prepare(book: &mut Book) -> Result<(), NoBook> {
    let mut outcome = Ok(());
    book.for_each_mut(|item| {
        if let BookItem::Chapter(chapter) = item
            && outcome.is_ok()
        {
            let formed = with_formulas(&chapter.name, &chapter.content);
            outcome = formed.map(|content| chapter.content = with_pictures(&content));
        }
    });
    Ok(outcome?)
}
