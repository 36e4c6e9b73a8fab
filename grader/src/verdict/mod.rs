//! Turns the outcome of an item into its score. The functions here are pure.

pub mod clue;
pub(crate) mod explain;
pub mod item_outcome;

use judging::assignment::{Task, TaskInfo};
use judging::describe;
use judging::exam::{Exam, ExamQuestion, Item};
use judging::exam_file::ExamName;
use judging::judge::{Credit, Failure, FailureKind, Judgement};
use judging::sanitize::sanitize;
use judging::scene;
use judging::section::Section;
use judging::signatures::{KnownMistake, PanicKind};
use judging::symptom::{SPREAD, Symptom};

use crate::build::NotCompiled;
use crate::handed_out::HandedOut;
use crate::probe::{Crash, Fault};
use crate::sandbox::Isolation;
use crate::score::rerun_command::RerunCommand;
use crate::score::{
    BuildReport, CodeLocation, Evidence, Hint, ItemScore, SCHEMA_VERSION, Score, TaskScore,
    Timings, Verdict,
};
use crate::verdict::item_outcome::{ItemOutcome, NotRunReason, worst_failure};
use crate::workspace::bundle_version::bundle_version;

/// Maximum length of a student's or the compiler's text in a message, in characters.
const MAX_TEXT_CHARS: usize = 2_000;
/// The folder of the test harness, as in the locations of panics. The harness refuses answers that
/// are too large to send.
const HARNESS: &str = "framework/src/harness/";
/// Maximum length of a file's compiler errors, in characters.
const MAX_COMPILER_CHARS: usize = 10_000;

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

/// Returns the chapter about the item's task, if the item refers to the handout. The section that
/// the item itself refers to may be in another chapter.
pub(crate) fn chapter(item: &Item, handed_out: &HandedOut) -> Option<Section> {
    item.section.as_ref()?;
    Some(Section::new(handed_out.assignment.info(item.task).chapter))
}

/// Returns whether the item's section explains a panic or a stack overflow, and not only wrong
/// answers.
fn explains_crashes(item: &Item, info: &TaskInfo) -> bool {
    let sections = info.clues.sections_on_crashes.iter();
    let mut sections = sections.map(|section| Section::new(*section));
    sections.any(|section| item.section.as_ref() == Some(&section))
}

/// Returns the section about panics with this message in the task's code, if there is one.
fn section_on_panic(message: &str, info: &TaskInfo) -> Option<Section> {
    let kind = PanicKind::of(message)?;
    let mut sections = info.clues.sections_on_panics.iter();
    let (_, section) = sections.find(|(about, _)| *about == kind)?;
    Some(Section::new(*section))
}

fn not_run_message(why: &NotRunReason) -> String {
    let why = match why {
        NotRunReason::TaskStopped(fault @ Fault::Crashed(Crash::NotStarted)) => {
            return fault.to_string();
        }
        NotRunReason::TaskStopped(Fault::TimedOut(_)) => {
            "not run because another item in this task took too long"
        }
        NotRunReason::TaskStopped(Fault::OutOfMemory | Fault::Crashed(_) | Fault::Protocol(_)) => {
            "not run because two other items in this task crashed"
        }
        NotRunReason::NeedsStoppedTask => {
            "not run because a task that this item depends on was stopped early"
        }
        NotRunReason::BudgetUsedUp => "not run because earlier items used up the submission's time",
    };
    why.to_owned()
}

fn not_compiled_message(file: &str, why: &NotCompiled) -> String {
    match why {
        NotCompiled::Unreadable(_) | NotCompiled::MissingDeclaration(_) => file_message(file, why),
        NotCompiled::Error { .. } => format!("{file} does not compile"),
        NotCompiled::Compiler(_) => "the submission does not compile".to_owned(),
    }
}

/// Returns the line number of the compiler's error, if it has one.
pub fn file_line(why: &NotCompiled) -> Option<u32> {
    let NotCompiled::Error { line, .. } = why else {
        return None;
    };
    *line
}

/// Returns the compiler's error, or the reason nothing was compiled.
pub fn file_message(file: &str, why: &NotCompiled) -> String {
    match why {
        NotCompiled::Unreadable(unreadable) => unreadable.message(file),
        NotCompiled::MissingDeclaration(part) => {
            format!(
                "{file} has no `{part}`, which other files use: put it back, or restore the original \
                 file with `cargo grade --reset {file}`"
            )
        }
        NotCompiled::Error { text, .. } | NotCompiled::Compiler(text) => {
            sanitize(text, MAX_COMPILER_CHARS)
        }
    }
}

fn verdict_of(fault: &Fault) -> Verdict {
    match fault {
        Fault::TimedOut(_) => Verdict::TimedOut,
        Fault::OutOfMemory => Verdict::OutOfMemory,
        Fault::Crashed(_) => Verdict::Crashed,
        Fault::Protocol(_) => Verdict::Protocol,
    }
}

fn score_answers(
    item: &Item,
    judgements: &[Judgement],
    score: &mut ItemScore,
    handed_out: &HandedOut,
) {
    let credit = judgements.iter().map(|judgement| judgement.credit).min();
    let credit = credit.unwrap_or(Credit::NONE);
    score.points = credit.apply(item.points);
    if credit == Credit::FULL {
        score.verdict = Verdict::Pass;
        return;
    }
    score.look = Some(item.look.clone());
    score.section = item.section.clone();

    let Some((question, failure)) = worst_failure(judgements) else {
        score.verdict = Verdict::Protocol;
        return;
    };
    let info = handed_out.assignment.info(item.task);
    score.called = info.called_by(&item.questions[question].question);
    let partial = |verdict| match score.points {
        0 => verdict,
        _ => Verdict::Partial,
    };
    let (verdict, got, wanted) = match &failure.kind {
        FailureKind::Wrong {
            what,
            side,
            got,
            wanted,
        } => {
            score.symptom = Some(Symptom {
                what: what.clone().into(),
                side: *side,
            });
            score.wrong_answers = wrong_answers(item, judgements, (question, failure));
            score.message = wrong_answer_message(
                what,
                score.wrong_answers,
                item.number(question, failure.element),
            );
            (partial(Verdict::Wrong), got.clone(), wanted.clone())
        }
        FailureKind::Uneven { got, wanted } => {
            score.symptom = Some(Symptom::of(SPREAD));
            score.message = "wrong: the directions aren't spread evenly".to_owned();
            (partial(Verdict::Wrong), got.clone(), wanted.clone())
        }
        FailureKind::Panicked(panic) if panic.is_unimplemented() => {
            score.verdict = Verdict::Unimplemented;
            let location = sanitize(&panic.location, MAX_TEXT_CHARS);
            let stub = if panic.message.starts_with("not yet") {
                "todo!"
            } else {
                "unimplemented!"
            };
            score.message = format!("{location} still contains `{stub}`");
            score.at = CodeLocation::from_panic(&panic.location, handed_out);
            score.look = None;
            score.section = chapter(item, handed_out);
            return;
        }
        FailureKind::Panicked(panic) => {
            let (location, message) = (&panic.location, &panic.message);
            let text = if location.replace('\\', "/").contains(HARNESS) {
                // The location would look like a mistake in the given code.
                message.clone()
            } else if let Some(library) = library_of(location) {
                // The path differs between machines, and isn't in the student's code.
                format!("a call to {library} panicked: {message}")
            } else {
                format!("panicked at {location}: {message}")
            };
            score.message = sanitize(&text, MAX_TEXT_CHARS);
            score.at = CodeLocation::from_panic(&panic.location, handed_out);
            let unknown = score.at.is_some().then_some(clue::UNKNOWN_PANIC);
            score.clue = clue::of_panic(message).or(unknown).map(str::to_owned);
            if score.clue.is_some() && !explains_crashes(item, info) {
                // The item's advice is about wrong answers.
                score.section =
                    section_on_panic(message, info).or_else(|| chapter(item, handed_out));
            }
            let wanted = describe::answer::judged(&item.questions[question], failure.element);
            (partial(Verdict::Panicked), "a panic".to_owned(), wanted)
        }
        FailureKind::Protocol(why) => {
            score.verdict = Verdict::Protocol;
            score.message = format!("the program sent an invalid answer: {why}");
            return;
        }
    };
    score.verdict = verdict;
    let mut evidence = evidence(item, (question, failure.element), [got, wanted]);
    if matches!(failure.kind, FailureKind::Uneven { .. }) {
        evidence.asked = describe::all_elements(&item.questions[question].question);
    }
    score.evidence = Some(evidence);
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

/// Returns the name of the library that a panic's location is in, or `None` if it is in the
/// submission or the given code.
fn library_of(location: &str) -> Option<String> {
    let location = location.replace('\\', "/");
    if location.starts_with("/rustc/") {
        return Some("the standard library".to_owned());
    }
    // The path of a crate's sources is `registry/src/INDEX/NAME-VERSION`.
    let (_, source) = location.split_once("/registry/src/")?;
    let (name, _version) = source.split('/').nth(1)?.rsplit_once('-')?;
    Some(format!("the crate {name}"))
}

/// Returns the evidence for an element of a question, with the submitted and the expected answer.
fn evidence(item: &Item, (question, element): (usize, usize), answers: [String; 2]) -> Evidence {
    let asked = &item.questions[question].question;
    let [got, wanted] = answers;
    Evidence {
        number: item.number(question, element),
        asked: describe::element(asked, element),
        got,
        wanted,
        can_be_shown: scene::can_be_shown(asked),
    }
}

/// Returns a message that gives the number of wrong answers and says `what` is wrong with the
/// answer shown, which is the one with this number.
fn wrong_answer_message(what: &str, wrong: Option<(usize, usize)>, number: usize) -> String {
    match wrong {
        Some((1, of)) if of > 1 => format!("1 of {of} answers is wrong: {what}"),
        Some((wrong, of)) if of > 1 => {
            format!("{wrong} of {of} answers are wrong; in #{number}: {what}")
        }
        Some(_) | None => format!("wrong: {what}"),
    }
}

/// Returns the number of wrong answers and the total, counted across all questions of the item. The
/// pixels of a rendered picture are counted individually.
fn wrong_answers(
    item: &Item,
    judgements: &[Judgement],
    (question, failure): (usize, &Failure),
) -> Option<(usize, usize)> {
    let (_, of) = failure.count?;
    if of != item.questions[question].question.count() {
        return failure.count;
    }
    let failures = judgements
        .iter()
        .filter_map(|judgement| judgement.failure.as_ref());
    let wrong = failures.map(|failure| failure.count.map_or(1, |(wrong, _)| wrong));
    Some((wrong.sum(), item.count()))
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
