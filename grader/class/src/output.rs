//! What is written of a class, and said on the terminal.

use crate::cli::Lists;
use crate::drift::Drift;
use crate::error::Error;
use crate::gradebook::{FilledGradebook, fill_canvas, fill_gradescope, fill_moodle};
use crate::model::GradedClass;
use crate::report::{grades, page, text};
use crate::store::{Store, json};
use crate::summary::ClassSummary;
use crate::table::TableError;

/// What a regrade has changed.
#[derive(Clone, Debug)]
pub struct RegradeChanges {
    /// Whose points changed.
    pub drifts: Vec<Drift>,
    /// What is not as it was.
    pub causes: Vec<&'static str>,
}

/// Writes the files of the class, and says what is in them.
pub fn write_results(
    class: &GradedClass,
    store: &Store,
    lists: &Lists,
    regraded: Option<&RegradeChanges>,
) -> Result<(), Error> {
    let summary = ClassSummary::new(class);
    store.write("class.json", &json(&summary))?;
    store.write("class.html", &page::render_page(class, &summary))?;
    store.write("grades.csv", &grades::grades_table(class).to_csv())?;
    anstream::print!("{}", text::render_summary(&summary));

    if let Some(regraded) = regraded {
        store.write("drift.json", &json(&regraded.drifts))?;
        anstream::print!(
            "{}",
            text::render_drifts(&regraded.drifts, &regraded.causes)
        );
    }
    for (name, filled) in fill_gradebooks(class, lists)? {
        // What would change is read before anything can be loaded up.
        anstream::print!("{}", text::render_gradebook(&filled));
        store.write(name, &filled.table.to_csv())?;
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
pub fn check_lists(lists: &Lists) -> Result<(), TableError> {
    fill_gradebooks(&GradedClass::default(), lists).map(drop)
}

/// The copies of the teacher's lists. What the teacher has given out is never changed itself.
fn fill_gradebooks(
    class: &GradedClass,
    lists: &Lists,
) -> Result<Vec<(&'static str, FilledGradebook)>, TableError> {
    let mut all = Vec::new();
    if let Some(path) = &lists.canvas {
        all.push((
            "canvas.csv",
            fill_canvas(path, lists.column.as_deref(), class)?,
        ));
    }
    if let Some(path) = &lists.moodle {
        all.push(("moodle.csv", fill_moodle(path, class)?));
    }
    if let Some(path) = &lists.gradescope {
        all.push(("gradescope.csv", fill_gradescope(path, class)?));
    }
    Ok(all)
}
