//! Writes the files of a graded class, and prints the summary.

use grader::policy::Policy;
use grader::printing::{print, print_line};

use crate::cli::Lists;
use crate::counting::count_points;
use crate::error::Error;
use crate::final_grades::{self, GradeHistory};
use crate::gradebook::{FilledGradebook, fill_canvas, fill_gradescope, fill_moodle};
use crate::graded_class::GradedClass;
use crate::hand_back::{ARCHIVE, hand_back};
use crate::list_kind::ListKind;
use crate::lists::ListFindings;
use crate::outcome::EntryResult;
use crate::regrade_diff::Changes;
use crate::report::{grades, page, text};
use crate::run::Run;
use crate::store::{Store, json};
use crate::summary::ClassSummary;

/// Whether every submission of a class was graded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Completion {
    /// Every submission was graded or had nothing to grade.
    Complete,
    /// Some submissions were not graded because of a fault in the grader or the machine.
    Incomplete,
}

/// The inputs of a class's files, apart from the results of its submissions.
pub struct ClassContext<'a> {
    /// The output folder.
    pub store: &'a Store,
    /// The run, or what the runs of all parts have in common.
    pub run: &'a Run,
    /// The lists.
    pub lists: &'a Lists,
    /// The course's policy.
    pub policy: &'a Policy,
    /// The facts in the lists.
    pub findings: ListFindings,
}

impl ClassContext<'_> {
    /// Counts the points, writes the files of the class and prints a summary.
    pub fn finish(self, results: Vec<EntryResult>, changes: Changes) -> Result<Completion, Error> {
        let settings = &self.run.settings;
        let class = GradedClass {
            exam: settings.exam.clone(),
            exam_hash: settings.exam_hash.clone(),
            isolation: settings.isolation.clone(),
            rows: count_points(results, self.policy, &self.findings.manual, &self.run.tasks)?,
            missing: self.findings.missing,
        };
        write_results(&class, self.store, self.lists, self.run, changes)?;
        Ok(match class.fault_count() {
            0 => Completion::Complete,
            _ => Completion::Incomplete,
        })
    }
}

fn write_results(
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
    for kind in &lists.drop_list {
        // The copy of a gradebook that is dropped would have outdated points.
        if let ListKind::Canvas | ListKind::Moodle | ListKind::Gradescope = kind {
            store.remove(&format!("{}.csv", kind.name()))?;
        }
    }
    // An archive that an earlier run was asked for would be outdated.
    if lists.hand_back || store.folder().join(ARCHIVE).exists() {
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
pub fn check_lists(lists: &Lists) -> Result<(), Error> {
    fill_gradebooks(&GradedClass::default(), lists).map(drop)
}

/// Returns the filled-in copies of the teacher's gradebooks. The originals are never changed.
fn fill_gradebooks(
    class: &GradedClass,
    lists: &Lists,
) -> Result<Vec<(&'static str, FilledGradebook)>, Error> {
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
