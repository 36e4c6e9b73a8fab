//! Runs a question of a graded submission again, for a student who asks about the grade.

use std::path::Path;

use grader::nearest_name::suggestion;
use grader::options::GradeOptions;
use grader::question_ref::QuestionRef;
use grader::replay::replay;
use judging::sanitize::sanitize;

use crate::error::Error;
use crate::names::are_equal;
use crate::outcome::{EntryOutcome, EntryResult, id_and_names};
use crate::store::Store;

/// The maximum length of an item's message, in characters.
const MAX_CHARS: usize = 1_000;

/// Runs a question on the files that were graded, and returns the text for the terminal. `question`
/// is the submission or person, and the item.
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
        return Err(Error::user(format!("{out} holds no scores: grade first")));
    };
    if options.exam.hash(options.handed_out)? != run.settings.exam_hash {
        return Err(Error::user(format!(
            "{} was graded with another exam, {:?}: pass its file with --exam",
            out.display(),
            run.settings.exam
        )));
    }
    let result = find_result(&store, who)?;
    let title = id_and_names(&result.id, &result.info.display_names());
    let score = match &result.outcome {
        EntryOutcome::Graded(score) => score,
        EntryOutcome::NothingToGrade(why) | EntryOutcome::Fault(why) => {
            return Err(Error::user(format!("{title} was not graded: {why}")));
        }
    };
    let item = score.items().find(|item| item.id == question.item);
    let graded = item.map(|item| {
        let (points, of) = (item.points, item.max_points);
        let separator = if item.message.is_empty() { "" } else { ": " };
        let verdict = format!("{}{separator}{}", item.verdict, item.message);
        format!("graded   {points} of {of} points, {verdict}\n")
    });
    let options = GradeOptions {
        submission: Some(store.submission_path(&result.id)),
        ..options.clone()
    };
    let replayed = replay(&options, &question)?;
    let head = format!("{title}\n{}", graded.unwrap_or_default());
    Ok(sanitize(&head, MAX_CHARS) + &replayed)
}

/// Returns the result of the submission with this id, or of the only person with this name or
/// identifier.
fn find_result(store: &Store, who: &str) -> Result<EntryResult, Error> {
    let results = store.results()?;
    let is_theirs = |result: &&EntryResult| {
        let mut names = result.info.people.iter().flat_map(|own| own.identifiers());
        names.any(|name| are_equal(name, who))
    };
    let ids = || results.iter().map(|result| result.id.as_str());
    let by_id = results.iter().find(|result| result.id == who);
    let mut theirs = results.iter().filter(is_theirs);
    match (by_id, theirs.next(), theirs.next()) {
        (Some(result), ..) | (None, Some(result), None) => Ok(result.clone()),
        (None, Some(one), Some(other)) => Err(Error::user(format!(
            "{who:?} could be {} or {}: write the name of the submission's folder",
            one.id, other.id
        ))),
        (None, None, _) => Err(Error::user(format!(
            "nobody with the name or identifier {who:?} was graded{}; the folder students has the \
             submissions",
            suggestion(who, ids())
        ))),
    }
}
