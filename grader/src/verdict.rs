//! From what became of an item to its line in the score: pure.

use crate::build::NotCompiled;
use crate::describe;
use crate::exam::{Exam, Item, Task};
use crate::exam_file::ExamName;
use crate::judge::{Credit, Failure, FailureKind, Judgement};
use crate::probe::Fault;
use crate::rerun_command::RerunCommand;
use crate::sandbox::Isolation;
use crate::sanitize::sanitize;
use crate::score::{
    BuildReport, CodeLocation, Evidence, Hint, ItemScore, SCHEMA_VERSION, Score, TaskScore,
    Timings, Verdict,
};
use crate::section::Section;
use crate::signatures::KnownMistake;

/// The most characters of a student's or compiler's text in a message.
const MAX_TEXT_CHARS: usize = 2_000;

/// What became of one item.
#[derive(Clone, Debug)]
pub enum ItemOutcome<'a> {
    /// Not asked yet.
    Pending,
    /// Its file is not part of the program.
    NotCompiled(&'a NotCompiled),
    /// No answer.
    Fault {
        /// Why.
        fault: Fault,
        /// The question and its element that bring it about alone, if any does.
        culprit: Option<(usize, usize)>,
    },
    /// Not asked, because other items of the task had run out of time.
    Skipped(Fault),
    /// An answer to each question, judged.
    Answered(Vec<Judgement>),
}

/// The score of a submission that nothing was asked yet.
pub fn pending_score(exam: &Exam, name: ExamName, submission: &str) -> Score {
    let task_score = |task: Task| {
        let items = exam.items.iter().filter(|item| item.task == task);
        let items: Vec<_> = items
            .map(|item| item_score(item, &ItemOutcome::Pending))
            .collect();
        TaskScore {
            id: task,
            title: task.title().to_owned(),
            points: 0,
            max_points: items.iter().map(|item| item.max_points).sum(),
            items,
            printed: None,
        }
    };
    let tasks: Vec<TaskScore> = Task::ALL
        .into_iter()
        .map(task_score)
        .filter(|task| !task.items.is_empty())
        .collect();
    Score {
        schema: SCHEMA_VERSION,
        submission: submission.to_owned(),
        exam: name,
        isolation: Isolation::None,
        complete: false,
        rerun_command: RerunCommand::default(),
        points: 0,
        max_points: tasks.iter().map(|task| task.max_points).sum(),
        tasks,
        build: BuildReport::default(),
        timings: Timings::default(),
    }
}

/// The item's line in the score.
pub fn item_score(item: &Item, outcome: &ItemOutcome) -> ItemScore {
    let mut score = ItemScore {
        id: item.id.clone(),
        title: item.title.clone(),
        points: 0,
        max_points: item.points,
        verdict: Verdict::Pending,
        message: String::new(),
        at: None,
        look: None,
        section: None,
        hints: Vec::new(),
        evidence: None,
        carried_forward: false,
        pictures: Vec::new(),
        staff: None,
    };
    match outcome {
        ItemOutcome::Pending => {}
        ItemOutcome::NotCompiled(why) => {
            score.verdict = Verdict::NotCompiled;
            score.message = not_compiled_message(item, why);
        }
        ItemOutcome::Fault {
            fault,
            culprit: place,
        } => {
            score.verdict = verdict_of(fault);
            score.message = fault.to_string();
            score.section = item.section.clone();
            score.evidence = place.map(|(question, element)| Evidence {
                number: item.number(question, element),
                asked: describe::element(&item.questions[question].question, element),
                got: "no answer".to_owned(),
                wanted: "an answer".to_owned(),
            });
        }
        ItemOutcome::Skipped(fault) => {
            score.verdict = verdict_of(fault);
            score.message = "not asked: other items of this task had run out of time".to_owned();
        }
        ItemOutcome::Answered(judgements) => score_answers(item, judgements, &mut score),
    }
    score
}

fn not_compiled_message(item: &Item, why: &NotCompiled) -> String {
    match why {
        NotCompiled::Unreadable(unreadable) => unreadable.to_string(),
        NotCompiled::MissingDeclaration(part) => {
            format!(
                "{} has no `{part}`, which other files call",
                item.task.file()
            )
        }
        NotCompiled::Error { .. } => format!("{} does not compile", item.task.file()),
        NotCompiled::Compiler(_) => "the submission does not compile".to_owned(),
    }
}

/// The line of what the compiler said of a file.
pub fn file_line(why: &NotCompiled) -> Option<u32> {
    match why {
        NotCompiled::Error { line, .. } => *line,
        NotCompiled::Unreadable(_)
        | NotCompiled::MissingDeclaration(_)
        | NotCompiled::Compiler(_) => None,
    }
}

/// What the compiler said, or why there was nothing to compile.
pub fn file_message(file: &str, why: &NotCompiled) -> String {
    match why {
        NotCompiled::Unreadable(unreadable) => unreadable.to_string(),
        NotCompiled::MissingDeclaration(part) => {
            format!("{file} has no `{part}`, which other files call")
        }
        NotCompiled::Error { text, .. } | NotCompiled::Compiler(text) => {
            sanitize(text, MAX_TEXT_CHARS)
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

fn score_answers(item: &Item, judgements: &[Judgement], score: &mut ItemScore) {
    let share = judgements.iter().map(|judgement| judgement.credit).min();
    let share = share.unwrap_or(Credit::NONE);
    score.points = share.apply(item.points);
    if share == Credit::FULL {
        score.verdict = Verdict::Pass;
        return;
    }
    score.look = Some(item.look.clone());
    score.section = item.section.clone();

    // Of the worst question: that is the one that the points are those of.
    let worst = judgements
        .iter()
        .enumerate()
        .find(|(_, j)| j.credit == share);
    let Some((question, failure)) = worst.and_then(|(i, j)| Some((i, j.failure.as_ref()?))) else {
        score.verdict = Verdict::Protocol;
        return;
    };
    let partial = |verdict| match score.points {
        0 => verdict,
        _ => Verdict::Partial,
    };
    let (verdict, got, wanted) = match &failure.kind {
        FailureKind::Wrong { what, got, wanted } => {
            score.message = wrong_answer_message(what, failure);
            (partial(Verdict::Wrong), got.clone(), wanted.clone())
        }
        FailureKind::Panicked(panic) if panic.is_unimplemented() => {
            score.verdict = Verdict::Unimplemented;
            score.message = format!(
                "{} still says `todo!`",
                sanitize(&panic.location, MAX_TEXT_CHARS)
            );
            score.at = CodeLocation::from_panic(&panic.location);
            score.look = None;
            score.section = item.section.as_ref().map(Section::whole_chapter);
            return;
        }
        FailureKind::Panicked(panic) => {
            let (place, words) = (&panic.location, &panic.message);
            score.message = sanitize(&format!("panicked at {place}: {words}"), MAX_TEXT_CHARS);
            score.at = CodeLocation::from_panic(&panic.location);
            let panicked = partial(Verdict::Panicked);
            (panicked, "a panic".to_owned(), "an answer".to_owned())
        }
        FailureKind::Protocol(why) => {
            score.verdict = Verdict::Protocol;
            score.message = format!("what came back is no answer: {why}");
            return;
        }
    };
    score.verdict = verdict;
    score.evidence = Some(Evidence {
        number: item.number(question, failure.element),
        asked: describe::element(&item.questions[question].question, failure.element),
        got,
        wanted,
    });
}

fn wrong_answer_message(what: &str, failure: &Failure) -> String {
    match failure.count {
        Some((wrong, of)) if of > 1 => format!("{wrong} of {of} are wrong; the first: {what}"),
        Some(_) | None => format!("first mistake: {what}"),
    }
}

/// The item of another task that this one needs, which earned nothing.
pub fn blocking_item<'a>(item: &'a Item, others: &Score) -> Option<&'a str> {
    let earned_nothing = |id: &&String| {
        let needed = others.items().find(|other| other.id == **id);
        needed.is_some_and(|needed| needed.points == 0)
    };
    item.needs.iter().find(earned_nothing).map(String::as_str)
}

/// Nobody can tell whose mistake it is, where there is no right part to try instead.
pub fn blocked_score(by: &str, line: ItemScore) -> ItemScore {
    if line.points > 0 || line.verdict == Verdict::Pending {
        return line;
    }
    ItemScore {
        verdict: Verdict::Blocked { by: by.to_owned() },
        message: format!("rests on {by}: mend that first"),
        at: None,
        look: None,
        section: None,
        evidence: None,
        ..line
    }
}

/// With what the known mistakes that explain the answers would do well to hear. Which ones they
/// are is for staff.
pub fn add_hints(line: &mut ItemScore, mistakes: &[&KnownMistake]) {
    if mistakes.is_empty() {
        return;
    }
    let hint = |mistake: &&KnownMistake| Hint {
        nudge: mistake.nudge.clone(),
        hint: mistake.hint.clone(),
    };
    line.hints = mistakes.iter().map(hint).collect();
    // The likeliest mistake comes first.
    if let Some(section) = mistakes.first().and_then(|mistake| mistake.section.clone()) {
        line.section = Some(section);
    }
    let ids: Vec<&str> = mistakes.iter().map(|mistake| mistake.id.as_str()).collect();
    line.staff = Some(format!("answers like {}", ids.join(" or ")));
}

/// What the submission earns with right parts in the place of its other files, which is what
/// counts: a mistake in those costs nothing here, and no mistake here is hidden by one in those.
pub fn substituted_score(by: &str, own: &ItemScore, carried: ItemScore) -> ItemScore {
    let message = match (own.verdict == Verdict::Pass, carried.message.as_str()) {
        (true, "") => String::new(),
        (false, "") => {
            format!("wrong only because of {by}: with right parts in its place, all is well")
        }
        (true, message) => {
            format!("{message}; two mistakes that cancel: it shows with right parts for {by}")
        }
        (false, message) => format!("{message}; asked with right parts, because of {by}"),
    };
    ItemScore {
        message,
        carried_forward: true,
        ..carried
    }
}
