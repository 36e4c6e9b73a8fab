//! Writes the files of a graded class, and prints the summary.

use grader::printing::{print, print_line};

use crate::cli::Lists;
use crate::drift::Changes;
use crate::error::Error;
use crate::final_grades::{self, GradeHistory};
use crate::gradebook::{FilledGradebook, fill_canvas, fill_gradescope, fill_moodle};
use crate::hand_back::{ARCHIVE, hand_back};
use crate::model::GradedClass;
use crate::report::{grades, page, text};
use crate::run::Run;
use crate::store::{Store, json};
use crate::summary::ClassSummary;
use crate::table::TableError;

/// Writes the files of the class, and prints a summary.
pub fn write_results(
    class: &GradedClass,
    store: &Store,
    lists: &Lists,
    run: &Run,
    changes: Changes,
) -> Result<(), Error> {
    // Written first: a run that is killed later is repeated, and lists the same changes again.
    let history = GradeHistory::after(store.read(final_grades::FILE)?, run, class);
    store.write(final_grades::FILE, json(&history))?;
    let changes = &Changes {
        grades: history.changes(),
        ..changes
    };
    let summary = ClassSummary::new(class);
    for row in &class.rows {
        let id = &row.result.id;
        let names = row.result.info.display_names();
        let names = (names != *id).then_some(names);
        let texts: Vec<String> = names.into_iter().chain(row.counted_texts()).collect();
        store.write_counted(id, &texts)?;
    }
    store.write("class.json", json(&summary))?;
    store.write("class.html", page::render_page(class, &summary, changes))?;
    store.write("grades.csv", grades::grades_table(class).to_csv())?;
    print(text::render_summary(&summary));

    if let Some(regrade) = &changes.regrade {
        store.write("drift.json", json(&regrade.drifts))?;
        print(text::render_regrade(regrade));
    }
    print(text::render_resubmitted(&changes.resubmitted));
    let grades = changes.grades.iter().map(text::render_grade_changes);
    print(grades.collect::<String>());
    print(text::render_removed(&changes.removed));
    for (name, filled) in fill_gradebooks(class, lists)? {
        // The changes are printed, so that the teacher can check them before uploading the file.
        print(text::render_gradebook(&filled));
        store.write(name, filled.table.to_csv())?;
        print_line(format_args!("  {}", store.folder().join(name).display()));
    }
    if lists.hand_back {
        let hand_back = hand_back(class, store)?;
        store.write(ARCHIVE, &hand_back.archive)?;
        print(text::render_hand_back(&hand_back));
        print_line(format_args!("  {}", store.folder().join(ARCHIVE).display()));
    }
    print_line("");
    for name in ["grades.csv", "class.html"] {
        print_line(format_args!("  {}", store.folder().join(name).display()));
    }
    print_line("");
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
