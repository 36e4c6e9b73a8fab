//! What is written of a class, and said on the terminal.

use crate::cli::Lists;
use crate::drift::Drift;
use crate::error::Error;
use crate::gradebook::{Filled, canvas, gradescope, moodle};
use crate::model::Class;
use crate::report::{grades, page, text};
use crate::store::{Store, json};
use crate::summary::Summary;
use crate::table::BadTable;

/// What a regrade has changed.
#[derive(Clone, Debug)]
pub struct Regraded {
    /// Whose points changed.
    pub drifts: Vec<Drift>,
    /// What is not as it was.
    pub because: Vec<&'static str>,
}

/// Writes the files of the class, and says what is in them.
pub fn write(
    class: &Class,
    store: &Store,
    lists: &Lists,
    regraded: Option<&Regraded>,
) -> Result<(), Error> {
    let summary = Summary::of(class);
    store.write("class.json", &json(&summary))?;
    store.write("class.html", &page::page(class, &summary))?;
    store.write("grades.csv", &grades::grades(class).text())?;
    anstream::print!("{}", text::summary(&summary));

    if let Some(regraded) = regraded {
        store.write("drift.json", &json(&regraded.drifts))?;
        anstream::print!("{}", text::drifts(&regraded.drifts, &regraded.because));
    }
    for (name, filled) in filled(class, lists)? {
        // What would change is read before anything can be loaded up.
        anstream::print!("{}", text::filled(&filled));
        store.write(name, &filled.table.text())?;
        anstream::println!("  {}", store.folder().join(name).display());
    }
    anstream::println!();
    for name in ["grades.csv", "class.html"] {
        anstream::println!("  {}", store.folder().join(name).display());
    }
    anstream::println!();
    Ok(())
}

/// Whether the lists can be filled: to be known before a class is graded, and not after.
pub fn check(lists: &Lists) -> Result<(), BadTable> {
    filled(&Class::default(), lists).map(drop)
}

/// The copies of the teacher's lists. What the teacher has given out is never changed itself.
fn filled(class: &Class, lists: &Lists) -> Result<Vec<(&'static str, Filled)>, BadTable> {
    let mut all = Vec::new();
    if let Some(path) = &lists.canvas {
        all.push(("canvas.csv", canvas(path, lists.column.as_deref(), class)?));
    }
    if let Some(path) = &lists.moodle {
        all.push(("moodle.csv", moodle(path, class)?));
    }
    if let Some(path) = &lists.gradescope {
        all.push(("gradescope.csv", gradescope(path, class)?));
    }
    Ok(all)
}
