//! Builds the handout as a book. Its pages work without a network and need no scripts other than
//! the book's own.

mod formulas;
mod pages;

use std::path::Path;

use anyhow::{Result, anyhow, ensure};
use grader::files::AtPath;
use mdbook_driver::MDBook;
use mdbook_driver::book::{Book, BookItem, Chapter};
use mdbook_driver::errors::Error;

use crate::bundle::{Bundle, archive};

use self::formulas::render_formulas;
use self::pages::{inline_figures, problems};

/// Builds the book of the workspace at `root` into the folder `to`.
pub fn build(root: &Path, to: &Path) -> Result<()> {
    let mut book = MDBook::load(root.join("handout")).map_err(driver_error)?;
    book.config.build.build_dir = to.to_owned();
    let chapters = book.source_dir();
    render_chapters(&mut book.book, &chapters)?;
    book.build().map_err(driver_error)?;
    let problems = problems(root, to)?;
    ensure!(
        problems.is_empty(),
        "the pages of the book have problems:\n{}",
        problems.join("\n")
    );
    Ok(())
}

fn driver_error(error: Error) -> anyhow::Error {
    anyhow!("mdBook: {error:#}")
}

/// Builds the book into the folder `to` from a bundle's chapters, which don't include the chapters
/// for instructors.
pub fn build_for_students(bundle: &Bundle, to: &Path) -> Result<()> {
    let mut chapters = Bundle::default();
    let of_handout = bundle
        .files
        .iter()
        .filter(|(path, _)| path.starts_with("handout/"));
    chapters
        .files
        .extend(of_handout.map(|(path, contents)| (path.clone(), contents.clone())));
    let sources = tempfile::tempdir().at("create", std::env::temp_dir())?;
    archive::write_files(&chapters, sources.path())?;
    build(sources.path(), to)
}

/// Replaces formulas with MathML, and figures with inline SVG. `chapters` is the chapters' folder.
fn render_chapters(book: &mut Book, chapters: &Path) -> Result<()> {
    let mut result = Ok(());
    book.for_each_mut(|item| {
        if let BookItem::Chapter(chapter) = item
            && result.is_ok()
        {
            result = render(chapter, chapters).map(|content| chapter.content = content);
        }
    });
    result
}

fn render(chapter: &Chapter, chapters: &Path) -> Result<String> {
    let content = render_formulas(&chapter.name, &chapter.content)?;
    // A chapter without a file has no content.
    let file = chapters.join(chapter.path.as_deref().unwrap_or(Path::new("")));
    Ok(inline_figures(&content, &file)?)
}

#[cfg(test)]
mod tests {
    use grader::files;
    use grader::handed_out::RAYS;

    use super::*;
    use crate::bundle::BundleOptions;

    /// Returns the names of the book's files that mention the chapter about Gradescope.
    fn mentions(book: &Path) -> Vec<String> {
        let files = files::read_dir(book).unwrap().into_iter();
        let files = files.filter(|path| path.is_file());
        let mentioning = files.filter(|path| {
            let text = String::from_utf8_lossy(&files::read(path).unwrap()).into_owned();
            text.contains("gradescope.html")
        });
        mentioning
            .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
            .collect()
    }

    #[test]
    fn the_students_book_has_no_chapters_for_instructors_and_they_cannot_be_found_in_it() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let (whole, students) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        build(&root, whole.path()).unwrap();
        let found = mentions(whole.path());
        assert!(
            found.iter().any(|file| file.starts_with("searchindex")),
            "{found:?}"
        );

        let bundle = Bundle::collect(&root, &RAYS, BundleOptions::default()).unwrap();
        build_for_students(&bundle, students.path()).unwrap();
        assert_eq!(mentions(students.path()), [""; 0]);
        assert!(students.path().join("sphere.html").is_file());
        assert!(!students.path().join("gradescope.html").exists());
        // The bundle accepts this book, because it has no chapters for instructors.
        Bundle::collect(
            &root,
            &RAYS,
            BundleOptions {
                book: Some(students.path()),
                ..BundleOptions::default()
            },
        )
        .unwrap();
    }
}
