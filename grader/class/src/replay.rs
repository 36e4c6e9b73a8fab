//! Runs a question for a graded submission again, in case a student asks about the grade.

use std::path::Path;

use grader::options::GradeOptions;
use grader::question_ref::QuestionRef;
use grader::replay::replay;
use judging::sanitize::sanitize;

use crate::entry::Person;
use crate::error::Error;
use crate::final_grades::{self, GradeHistory};
use crate::identity::find_submission;
use crate::outcome::{EntryResult, id_and_names};
use crate::store::Store;

/// The maximum length of an item's message, in characters.
const MAX_CHARS: usize = 1_000;

/// Runs a question on the graded files and returns the text for the terminal. `question` names the
/// submission or person, and the item.
pub fn replay_question(
    out: &Path,
    question: &[String],
    options: &GradeOptions,
) -> Result<String, Error> {
    let [who, question] = question else {
        return Err(Error::user("--replay needs a submission and an item"));
    };
    let question: QuestionRef = question.parse().map_err(|why: String| Error::user(why))?;
    let store = Store::new(out);
    let Some(run) = store.read_run()? else {
        let out = out.display();
        return Err(Error::user(format!(
            "{out} contains no scores: grade the class first"
        )));
    };
    if options.exam.hash(options.handed_out)? != run.settings.exam_hash {
        return Err(Error::user(format!(
            "{} was graded with a different exam, {:?}: pass that exam's file with --exam",
            out.display(),
            run.settings.exam
        )));
    }
    let result = find_result(&store, who)?;
    let title = id_and_names(&result.id, &result.info.display_names());
    let Some(score) = result.score() else {
        return Err(Error::user(format!(
            "{title} has no score, so none of its questions can be rerun: see grades.csv for the \
             reason"
        )));
    };
    let options = GradeOptions {
        submission: Some(store.submission_path(&result.id)),
        ..options.clone()
    };
    let replayed = replay(&options, &question)?;
    let mut text = format!("{title}\n");
    if let Some(item) = score.items().find(|item| item.id == question.item) {
        let (points, of) = (item.points, item.max_points);
        let why = format!("{}: {}", item.verdict, item.message);
        let why = why.trim_end_matches(": ");
        text += &format!("graded   {points} of {of} points, {why}\n");
    }
    Ok(sanitize(&text, MAX_CHARS) + &replayed)
}

/// Returns the result of the submission that `who` names.
fn find_result(store: &Store, who: &str) -> Result<EntryResult, Error> {
    let mut results = store.results()?;
    let all = results.iter();
    let all = all.map(|result| (result.id.as_str(), &result.info));
    let history: Option<GradeHistory> = store.read(final_grades::FILE)?;
    let counts = |id: &str, own: &Person| history.iter().any(|history| history.counts(id, own));
    let index = find_submission(who, &all.collect::<Vec<_>>(), counts).map_err(Error::user)?;
    Ok(results.swap_remove(index))
}
