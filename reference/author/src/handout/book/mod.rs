//! The handout as a book: pages that need no network and no script but the book's own.

mod formulas;
mod pages;
mod pictures;

use std::path::Path;

use mdbook_driver::MDBook;
use mdbook_driver::book::{Book, BookItem};
use mdbook_driver::errors::Error;

use self::formulas::render_formulas;
use self::pages::problems;
use self::pictures::inline_figures;
use crate::proof::sources::ReadError;

/// Why there is no book.
#[derive(Debug, thiserror::Error)]
pub enum BookError {
    /// A formula is none.
    #[error("{0}; mend the formula in handout/src")]
    Formula(#[from] formulas::FormulaError),
    /// A page is not as the chapters mean it.
    #[error("the book is not whole:\n{}", .0.join("\n"))]
    Pages(Vec<String>),
    /// A page or chapter can not be read.
    #[error(transparent)]
    Unreadable(#[from] ReadError),
    /// mdBook can not make it.
    #[error("mdBook: {0:#}")]
    Driver(Error),
}

/// Makes the book of the workspace at `root` into the folder `to`.
pub fn build(root: &Path, to: &Path) -> Result<(), BookError> {
    let mut book = MDBook::load(root.join("handout")).map_err(BookError::Driver)?;
    book.config.build.build_dir = to.to_owned();
    render_chapters(&mut book.book)?;
    book.build().map_err(BookError::Driver)?;
    match problems(root, to)? {
        problems if problems.is_empty() => Ok(()),
        problems => Err(BookError::Pages(problems)),
    }
}

/// Puts MathML in the place of formulas, and drawings in the place of pictures.
fn render_chapters(book: &mut Book) -> Result<(), BookError> {
    let mut outcome = Ok(());
    book.for_each_mut(|item| {
        if let BookItem::Chapter(chapter) = item
            && outcome.is_ok()
        {
            let formed = render_formulas(&chapter.name, &chapter.content);
            outcome = formed.map(|content| chapter.content = inline_figures(&content));
        }
    });
    Ok(outcome?)
}
