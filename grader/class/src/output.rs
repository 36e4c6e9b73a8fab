//! Writes the files of a graded class and prints the summary.

use std::collections::BTreeSet;
use std::path::Path;

use grader::handed_out::HandedOut;
use grader::policy::Policy;
use grader::printing::{counted, print, print_line};

use crate::anonymous::{Pseudonyms, is_shown};
use crate::attempts::{check_manual_points, count_points};
use crate::cli::Lists;
use crate::entry_completion::ListFindings;
use crate::error::Error;
use crate::final_grades::{self, GradeHistory};
use crate::gradebook::{FilledGradebook, fill_canvas, fill_gradescope, fill_moodle};
use crate::graded_class::GradedClass;
use crate::hand_back::{ARCHIVE, hand_back};
use crate::hand_in_again::{FOLDER, write_messages};
use crate::list_kind::{ListCopies, ListKind};
use crate::outcome::{EntryResult, exam_tasks};
use crate::regrade_diff::{Changes, find_regrade_changes, find_score_changes};
use crate::report::{grades, page, text};
use crate::run::Run;
use crate::similar_pairs::{SimilarPair, read_similar_pairs};
use crate::store::{REPLACED, Store, json};
use crate::summary::ClassSummary;

/// Whether every submission in a class was graded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Completion {
    /// Every submission was graded or had nothing to grade.
    Complete,
    /// Some submissions were not graded because of a problem with the grader or the machine.
    Incomplete,
}

/// Everything that is needed to write a class's files, other than the results of its submissions.
pub struct ClassContext<'a> {
    /// The output folder.
    pub store: &'a Store,
    /// The run, or the common settings of all merged shards.
    pub run: &'a Run,
    /// The lists.
    pub lists: &'a Lists,
    /// The course's policy.
    pub policy: &'a Policy,
    /// The assignment.
    pub handed_out: &'a HandedOut,
    /// The facts found in the lists.
    pub findings: ListFindings,
}

impl ClassContext<'_> {
    /// Computes the final points, writes the class's files and prints a summary. `removed` contains
    /// sentences about entries that are no longer in the input.
    pub fn finish(
        self,
        results: Vec<EntryResult>,
        removed: Vec<String>,
    ) -> Result<Completion, Error> {
        let ClassContext {
            store, run, lists, ..
        } = self;
        let similar = read_similar_pairs(lists)?;
        let regrade = find_regrade_changes(store, run, &results)?;
        let mut resubmitted = find_score_changes(store, &results, REPLACED)?;
        let (manual, tasks) = (&self.findings.manual, exam_tasks(&run.items));
        let rows = count_points(results, self.policy, manual, &tasks);
        check_manual_points(&rows, manual, &tasks)?;
        let class = &GradedClass {
            settings: run.settings.clone(),
            rows,
            missing: self.findings.missing,
        };
        // Update the history first, so that if the run is killed later, repeating it lists the same
        // changes.
        let policy = lists.policy.as_deref().map(Policy::read_text).transpose()?;
        let earlier = store.read(final_grades::FILE)?;
        let history = GradeHistory::after(earlier, run, class, policy.unwrap_or_default());
        store.write(final_grades::FILE, json(&history))?;
        // List each change only until the next one.
        resubmitted.retain(|change| history.is_since(&change.id, change.was));
        if let Some(regrade) = &regrade {
            store.write("drift.json", json(&regrade.scores))?;
        }
        let changes = Changes {
            regrade: regrade.filter(|_| history.is_of_regrade()),
            resubmitted,
            removed,
            grades: history.changes(|policy| {
                let results = class.rows.iter().map(|row| row.result.clone());
                count_points(results.collect(), policy, manual, &tasks)
            }),
        };
        let messages = write_messages(class, store, self.handed_out)?;
        let with_message = messages.iter().flatten().copied().collect();
        let summary = write_results(class, self.policy, store, &changes, &similar, &with_message)?;
        print(text::render_summary(&summary));
        print(text::render_changes(&changes));
        write_for_platforms(class, store, lists)?;
        if let Some(folder) = &lists.anonymous {
            write_for_graders(class, self.policy, store, run, folder)?;
        }
        print_line("");
        for name in ["grades.csv", "class.html"] {
            print_path(store, name);
        }
        if !messages.is_empty() {
            print_path(store, FOLDER);
            let messages = counted(messages.len(), "message");
            print_line(format!("    {messages} for students who need to resubmit"));
        }
        print_line("");
        Ok(match class.fault_count() {
            0 => Completion::Complete,
            _ => Completion::Incomplete,
        })
    }
}

/// Writes the files with the class's results. `with_message` contains the indices of the
/// submissions that there are messages about.
fn write_results(
    class: &GradedClass,
    policy: &Policy,
    store: &Store,
    changes: &Changes,
    similar: &[SimilarPair],
    with_message: &BTreeSet<usize>,
) -> Result<ClassSummary, Error> {
    let summary = ClassSummary::new(class, policy, with_message);
    for row in &class.rows {
        let id = &row.result.id;
        let names = row.result.info.display_names();
        let names = (names != *id).then_some(names);
        let texts = [row.counted_texts(), row.texts_for_everyone()];
        let texts = texts.map(|texts| names.iter().cloned().chain(texts).collect());
        let failing = row.result.score().map(|score| {
            let tasks = score.for_policy();
            policy.points.failing_items(&tasks)
        });
        store.write_counted(id, &texts, &failing.unwrap_or_default())?;
    }
    store.write("class.json", json(&summary))?;
    let page = page::render_page(class, &summary, changes, similar);
    store.write("class.html", page)?;
    store.write("grades.csv", grades::grades_table(class).to_csv())?;
    Ok(summary)
}

/// Writes a copy of the class with pseudonyms, which graders can use like the output folder.
fn write_for_graders(
    class: &GradedClass,
    policy: &Policy,
    store: &Store,
    run: &Run,
    folder: &Path,
) -> Result<(), Error> {
    let copy = Store::new(folder);
    let mut pseudonyms = Pseudonyms::read(store)?;
    let hidden = pseudonyms.hide(class, store)?;
    for row in class.rows.iter().filter(|row| is_shown(row)) {
        let id = &row.result.id;
        copy.copy_files(&pseudonyms.of(id), store, id)?;
    }
    for row in &hidden.rows {
        copy.save_result(&row.result, "", run.round)?;
    }
    let ids = hidden.rows.iter().map(|row| row.result.id.clone());
    copy.write_run(&Run {
        lists: ListCopies::new(),
        entries: ids.collect(),
        ..run.clone()
    })?;
    // Graders don't send messages.
    let changes = Changes::default();
    write_results(&hidden, policy, &copy, &changes, &[], &BTreeSet::new())?;
    print_path(&copy, "class.html");
    Ok(())
}

/// Writes the filled-in copies of the gradebooks, and the archive to hand back.
fn write_for_platforms(class: &GradedClass, store: &Store, lists: &Lists) -> Result<(), Error> {
    for (name, filled) in fill_gradebooks(class, lists)? {
        // The changes are printed, so that the teacher can check them before uploading the file.
        print(text::render_gradebook(&filled));
        store.write(name, filled.table.to_csv())?;
        print_path(store, name);
    }
    for kind in &lists.drop_list {
        // The copy of a dropped gradebook would contain outdated points.
        if ListKind::GRADEBOOKS.contains(kind) {
            store.remove(&format!("{}.csv", kind.name()))?;
        }
    }
    // An archive from an earlier run would be outdated.
    if lists.hand_back || store.folder().join(ARCHIVE).exists() {
        let hand_back = hand_back(class, store)?;
        store.write(ARCHIVE, &hand_back.archive)?;
        print(text::render_hand_back(&hand_back));
        print_path(store, ARCHIVE);
    }
    Ok(())
}

fn print_path(store: &Store, name: &str) {
    print_line(format_args!("  {}", store.folder().join(name).display()));
}

/// Checks, before the class is graded, that the gradebooks and a similarity checker's results can
/// be used.
pub fn check_lists(lists: &Lists) -> Result<(), Error> {
    read_similar_pairs(lists)?;
    fill_gradebooks(&GradedClass::default(), lists).map(drop)
}

/// Returns the filled-in copies of the teacher's gradebooks. The originals are never changed.
fn fill_gradebooks(
    class: &GradedClass,
    lists: &Lists,
) -> Result<Vec<(&'static str, FilledGradebook)>, Error> {
    let column = lists.column.as_deref();
    let canvas = lists.canvas.iter();
    let canvas = canvas.map(|path| ("canvas.csv", fill_canvas(path, column, class)));
    let moodle = lists.moodle.iter();
    let moodle = moodle.map(|path| ("moodle.csv", fill_moodle(path, class)));
    let gradescope = lists.gradescope.iter();
    let gradescope = gradescope.map(|path| ("gradescope.csv", fill_gradescope(path, class)));
    let all = canvas.chain(moodle).chain(gradescope);
    all.map(|(name, filled)| Ok((name, filled?))).collect()
}
