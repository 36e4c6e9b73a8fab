//! Writes the files of a graded class, and prints the summary.

use crate::cli::Lists;
use crate::drift::Drift;
use crate::error::Error;
use crate::gradebook::{FilledGradebook, fill_canvas, fill_gradescope, fill_moodle};
use crate::model::GradedClass;
use crate::report::{grades, page, text};
use crate::store::{Store, json};
use crate::summary::ClassSummary;
use crate::table::TableError;

/// The changes of a regrade.
#[derive(Clone, Debug)]
pub struct RegradeChanges {
    /// The scores that changed.
    pub drifts: Vec<Drift>,
    /// The settings that changed.
    pub causes: Vec<&'static str>,
}

/// Writes the files of the class, and prints a summary.
pub fn write_results(
    class: &GradedClass,
    store: &Store,
    lists: &Lists,
    changes: Option<&RegradeChanges>,
) -> Result<(), Error> {
    let summary = ClassSummary::new(class);
    for row in &class.rows {
        store.write_counted(&row.result.id, row.counted_text().as_deref())?;
    }
    store.write("class.json", &json(&summary))?;
    store.write("class.html", &page::render_page(class, &summary))?;
    store.write("grades.csv", &grades::grades_table(class).to_csv())?;
    anstream::print!("{}", text::render_summary(&summary));

    if let Some(changes) = changes {
        store.write("drift.json", &json(&changes.drifts))?;
        anstream::print!("{}", text::render_drifts(&changes.drifts, &changes.causes));
    }
    for (name, filled) in fill_gradebooks(class, lists)? {
        // The changes are printed, so that the teacher can check them before uploading the file.
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

/// Checks that the gradebooks can be filled in, before the class is graded.
pub fn check_lists(lists: &Lists) -> Result<(), TableError> {
    fill_gradebooks(&GradedClass::default(), lists).map(drop)
}

/// Returns the filled-in copies of the teacher's gradebooks. The originals are never changed.
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
