//! Turns the outcome of an item into its score. The functions here are pure.

mod answers;
pub mod clue;
pub(crate) mod explain;
pub mod item_outcome;
pub mod messages;
mod sections;

use judging::assignment::{Task, TaskInfo};
use judging::describe;
use judging::exam::{Exam, ExamQuestion, Item};
use judging::exam_file::ExamName;
use judging::section::Section;
use judging::signatures::KnownMistake;

use self::answers::{evidence, score_answers};
use self::item_outcome::{ItemOutcome, NotRunReason};
use self::messages::{not_compiled_message, not_run_message};
use self::sections::{chapter, explains_crashes};
use crate::handed_out::HandedOut;
use crate::probe::{Crash, Fault};
use crate::sandbox::Isolation;
use crate::score::rerun_command::RerunCommand;
use crate::score::{
    BuildReport, CodeLocation, Hint, ItemScore, SCHEMA_VERSION, Score, TaskScore, Timings, Verdict,
};
use crate::workspace::bundle_version::bundle_version;

/// Returns the score of a submission before any item is graded.
pub fn pending_score(
    exam: &Exam,
    name: ExamName,
    submission: &str,
    handed_out: &HandedOut,
) -> Score {
    let task_score = |task: Task| {
        let of_task = || exam.items.iter().filter(|item| item.task == task);
        let items: Vec<_> = of_task()
            .map(|item| item_score(item, &ItemOutcome::Pending, handed_out))
            .collect();
        TaskScore {
            id: task,
            title: handed_out.assignment.info(task).title.to_owned(),
            chapter: of_task().find_map(|item| chapter(item, handed_out)),
            points: 0,
            max_points: items.iter().map(|item| item.max_points).sum(),
            items,
            method: handed_out.assignment.info(task).file.to_owned(),
            methods: Vec::new(),
            warnings: Vec::new(),
            printed: None,
        }
    };
    let tasks: Vec<TaskScore> = handed_out
        .assignment
        .tasks()
        .map(task_score)
        .filter(|task| !task.items.is_empty())
        .collect();
    Score {
        schema: SCHEMA_VERSION,
        submission: submission.to_owned(),
        bundle: bundle_version().map(str::to_owned),
        assignment_title: handed_out.assignment.title,
        exam: name,
        isolation: Isolation::None,
        complete: false,
        rerun_command: RerunCommand::default(),
        book: None,
        points: 0,
        max_points: tasks.iter().map(|task| task.max_points).sum(),
        tasks,
        build: BuildReport::default(),
        timings: Timings::default(),
    }
}

/// Returns the score of an item with this outcome.
pub fn item_score(item: &Item, outcome: &ItemOutcome, handed_out: &HandedOut) -> ItemScore {
    let mut score = ItemScore::pending(&item.id, &item.title, item.points);
    match outcome {
        ItemOutcome::Pending => {}
        ItemOutcome::NotCompiled(why) => {
            score.verdict = Verdict::NotCompiled;
            score.message = not_compiled_message(handed_out.assignment.info(item.task).file, why);
        }
        ItemOutcome::Fault { fault, culprit } => {
            score.verdict = verdict_of(fault);
            score.message = fault.to_string();
            let info = handed_out.assignment.info(item.task);
            score.called = called_by_all(item, *culprit, info);
            score.clue = Some(clue::of_fault(fault, score.called, info));
            // The item's advice is about wrong answers.
            score.section = if explains_crashes(item, info) {
                item.section.clone()
            } else {
                chapter(item, handed_out)
            };
            if matches!(fault, Fault::Crashed(Crash::StackOverflow)) {
                let section = info.clues.section_if_stack_overflows.map(Section::new);
                score.clue_section = section.filter(|_| !explains_crashes(item, info));
            }
            score.evidence = culprit.map(|culprit| {
                let (question, element) = culprit;
                let wanted = describe::answer::judged(&item.questions[question], element);
                evidence(item, culprit, ["no answer".to_owned(), wanted])
            });
        }
        ItemOutcome::NotRun(why) => {
            score.verdict = match why {
                NotRunReason::TaskStopped(fault) => verdict_of(fault),
                NotRunReason::NeedsStoppedTask | NotRunReason::BudgetUsedUp => Verdict::TimedOut,
            };
            score.message = not_run_message(why);
            score.section = item.section.clone();
        }
        ItemOutcome::Answered {
            judgements,
            right_alone,
        } => {
            score_answers(item, judgements, &mut score, handed_out);
            if *right_alone {
                score.clue = Some(clue::KEPT_STATE.to_owned());
                let clues = &handed_out.assignment.info(item.task).clues;
                score.clue_section = match clues.section_on_kept_state {
                    Some(section) => Some(Section::new(section)),
                    None => chapter(item, handed_out),
                };
            }
        }
    }
    score
}

fn verdict_of(fault: &Fault) -> Verdict {
    match fault {
        Fault::TimedOut(_) => Verdict::TimedOut,
        Fault::OutOfMemory => Verdict::OutOfMemory,
        Fault::Crashed(_) => Verdict::Crashed,
        Fault::Protocol(_) => Verdict::Protocol,
    }
}

/// Returns the method that the culprit calls or, if there is none, the one that all questions of the
/// item call.
fn called_by_all(
    item: &Item,
    culprit: Option<(usize, usize)>,
    info: &TaskInfo,
) -> Option<&'static str> {
    let called = |question: &ExamQuestion| info.called_by(&question.question);
    if let Some((question, _)) = culprit {
        return called(item.questions.get(question)?);
    }
    let first = called(item.questions.first()?)?;
    let mut questions = item.questions.iter();
    questions
        .all(|question| called(question) == Some(first))
        .then_some(first)
}

/// Returns the score of an item whose task's method is still the one that was handed out. `method`
/// is its line number in the file. The answers don't matter, because nobody has written the method
/// yet.
pub fn unwritten_score(item: &Item, file: &str, method: u32, handed_out: &HandedOut) -> ItemScore {
    ItemScore {
        verdict: Verdict::Unimplemented,
        message: format!(
            "{file}:{method}: this method is unchanged from the version that was handed out"
        ),
        at: Some(CodeLocation {
            file: file.to_owned(),
            line: method,
        }),
        section: chapter(item, handed_out),
        ..ItemScore::pending(&item.id, &item.title, item.points)
    }
}

/// Returns the score of an item that depends on the failed item `by`. If the item earned nothing,
/// it is reported as blocked, because without substituted parts it is impossible to tell which of
/// the two tasks contains the mistake. An item that was not run may not even use the code that `by`
/// tests.
pub fn blocked_score(by: &str, line: ItemScore, is_run: bool) -> ItemScore {
    if line.points > 0 || line.verdict == Verdict::Pending {
        return line;
    }
    ItemScore {
        verdict: Verdict::Blocked { by: by.to_owned() },
        message: if is_run {
            format!("depends on {by}: fix that first")
        } else {
            format!("waits for {by}: fix that first")
        },
        at: None,
        look: None,
        clue: None,
        symptom: None,
        wrong_answers: None,
        called: None,
        symptom_clue: None,
        section: None,
        clue_section: None,
        evidence: None,
        ..line
    }
}

/// Adds the hints for the mistakes that explain the answers and, for staff, the ids of those
/// mistakes.
pub fn add_hints(line: &mut ItemScore, mistakes: &[&KnownMistake]) {
    if mistakes.is_empty() {
        return;
    }
    let hint = |mistake: &&KnownMistake| Hint {
        nudge: mistake.nudge.clone(),
        hint: mistake.hint.clone(),
    };
    line.hints = mistakes.iter().map(hint).collect();
    // If several mistakes are possible, students see the section of the first one.
    if let Some(section) = mistakes.first().and_then(|mistake| mistake.section.clone()) {
        line.section = Some(section);
    }
    let ids: Vec<&str> = mistakes.iter().map(|mistake| mistake.id.as_str()).collect();
    line.staff = Some(format!("the answers match those of {}", ids.join(" or ")));
}

/// Returns the score of an item that was graded with substituted parts. This is the score that
/// counts: in it, mistakes in other files don't cost points or hide a mistake in this file.
pub fn substituted_score(by: &str, own: &ItemScore, substituted: ItemScore) -> ItemScore {
    let message = match (own.verdict == Verdict::Pass, substituted.message.as_str()) {
        (true, "") => String::new(),
        (false, "") => {
            format!("wrong only because {by} failed; passes with the reference's other files")
        }
        (true, message) => format!(
            "{message}; passes only because the mistake in {by} cancels this one out, so it is \
             graded with the reference's other files"
        ),
        (false, message) => {
            format!("{message}; graded with the reference's other files because {by} failed")
        }
    };
    ItemScore {
        message,
        carried_forward: true,
        ..substituted
    }
}

#[cfg(test)]
mod tests;
