//! Builds the handout as a book. Its pages need neither the network nor any scripts except the
//! book's own.

mod formulas;
mod pages;
mod pictures;

use std::path::Path;

use grader::files::PathError;
use mdbook_driver::MDBook;
use mdbook_driver::book::{Book, BookItem};
use mdbook_driver::errors::Error;

use self::formulas::render_formulas;
use self::pages::problems;
use self::pictures::inline_figures;

/// The reason why the book cannot be built.
#[derive(Debug, thiserror::Error)]
pub enum BookError {
    /// A formula is invalid.
    #[error("{0}; correct the formula in handout/src")]
    Formula(#[from] formulas::FormulaError),
    /// A page lacks a heading, or loads something from the network.
    #[error("the pages of the book have problems:\n{}", .0.join("\n"))]
    Pages(Vec<String>),
    /// A page or chapter cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// mdBook failed.
    #[error("mdBook: {0:#}")]
    Driver(Error),
}

/// Builds the book of the workspace at `root` into the folder `to`.
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

/// Replaces formulas with MathML, and figures with inline SVG.
fn render_chapters(book: &mut Book) -> Result<(), BookError> {
    let mut result = Ok(());
    book.for_each_mut(|item| {
        if let BookItem::Chapter(chapter) = item
            && result.is_ok()
        {
            let rendered = render_formulas(&chapter.name, &chapter.content);
            result = rendered.map(|content| chapter.content = inline_figures(&content));
        }
    });
    Ok(result?)
}
