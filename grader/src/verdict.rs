//! From what became of an item to its line in the score: pure.

use crate::again::Again;
use crate::ask::Fault;
use crate::build::NotCompiled;
use crate::describe;
use crate::exam::{Exam, Item, Task};
use crate::exam_file::ExamName;
use crate::judge::{Failure, How, Judgement, Share};
use crate::sandbox::Isolation;
use crate::score::{
    BuildReport, CodePlace, Evidence, Hint, ItemScore, SCHEMA, Score, TaskScore, Timings, Verdict,
};
use crate::section::Section;
use crate::tame::tame;
use crate::tells::KnownMistake;

/// The most characters of a student's or compiler's text in a message.
const LONGEST: usize = 2_000;

/// What became of one item.
#[derive(Clone, Debug)]
pub enum Outcome<'a> {
    /// Not asked yet.
    Pending,
    /// Its file is not part of the program.
    NotCompiled(&'a NotCompiled),
    /// No answer.
    Fault {
        /// Why.
        fault: Fault,
        /// The question and its element that bring it about alone, if any does.
        place: Option<(usize, usize)>,
    },
    /// Not asked, because other items of the task had run out of time.
    GivenUp(Fault),
    /// An answer to each question, judged.
    Answered(Vec<Judgement>),
}

/// The score of a submission that nothing was asked yet.
pub fn unasked(exam: &Exam, name: ExamName, submission: &str) -> Score {
    let task_score = |task: Task| {
        let items = exam.items.iter().filter(|item| item.task == task);
        let items: Vec<_> = items
            .map(|item| item_score(item, &Outcome::Pending))
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
        schema: SCHEMA,
        submission: submission.to_owned(),
        exam: name,
        isolation: Isolation::None,
        complete: false,
        again: Again::default(),
        points: 0,
        max_points: tasks.iter().map(|task| task.max_points).sum(),
        tasks,
        build: BuildReport::default(),
        timings: Timings::default(),
    }
}

/// The item's line in the score.
pub fn item_score(item: &Item, outcome: &Outcome) -> ItemScore {
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
        Outcome::Pending => {}
        Outcome::NotCompiled(why) => {
            score.verdict = Verdict::NotCompiled;
            score.message = not_compiled(item, why);
        }
        Outcome::Fault { fault, place } => {
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
        Outcome::GivenUp(fault) => {
            score.verdict = verdict_of(fault);
            score.message = "not asked: other items of this task had run out of time".to_owned();
        }
        Outcome::Answered(judgements) => answered(item, judgements, &mut score),
    }
    score
}

fn not_compiled(item: &Item, why: &NotCompiled) -> String {
    match why {
        NotCompiled::Unreadable(unreadable) => unreadable.to_string(),
        NotCompiled::Lacks(part) => {
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
        NotCompiled::Unreadable(_) | NotCompiled::Lacks(_) | NotCompiled::Compiler(_) => None,
    }
}

/// What the compiler said, or why there was nothing to compile.
pub fn file_message(file: &str, why: &NotCompiled) -> String {
    match why {
        NotCompiled::Unreadable(unreadable) => unreadable.to_string(),
        NotCompiled::Lacks(part) => format!("{file} has no `{part}`, which other files call"),
        NotCompiled::Error { text, .. } | NotCompiled::Compiler(text) => tame(text, LONGEST),
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

fn answered(item: &Item, judgements: &[Judgement], score: &mut ItemScore) {
    let share = judgements.iter().map(|judgement| judgement.share).min();
    let share = share.unwrap_or(Share::NONE);
    score.points = share.of(item.points);
    if share == Share::ALL {
        score.verdict = Verdict::Pass;
        return;
    }
    score.look = Some(item.look.clone());
    score.section = item.section.clone();

    // Of the worst question: that is the one that the points are those of.
    let worst = judgements
        .iter()
        .enumerate()
        .find(|(_, j)| j.share == share);
    let Some((question, failure)) = worst.and_then(|(i, j)| Some((i, j.failure.as_ref()?))) else {
        score.verdict = Verdict::Protocol;
        return;
    };
    let partial = |verdict| match score.points {
        0 => verdict,
        _ => Verdict::Partial,
    };
    let (verdict, got, wanted) = match &failure.how {
        How::Wrong { what, got, wanted } => {
            score.message = message(what, failure);
            (partial(Verdict::Wrong), got.clone(), wanted.clone())
        }
        How::Panicked(panic) if panic.is_unimplemented() => {
            score.verdict = Verdict::Unimplemented;
            score.message = format!("{} still says `todo!`", tame(&panic.place, LONGEST));
            score.at = CodePlace::of_panic(&panic.place);
            score.look = None;
            score.section = item.section.as_ref().map(Section::whole_chapter);
            return;
        }
        How::Panicked(panic) => {
            let (place, words) = (&panic.place, &panic.message);
            score.message = tame(&format!("panicked at {place}: {words}"), LONGEST);
            score.at = CodePlace::of_panic(&panic.place);
            let panicked = partial(Verdict::Panicked);
            (panicked, "a panic".to_owned(), "an answer".to_owned())
        }
        How::Protocol(why) => {
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

fn message(what: &str, failure: &Failure) -> String {
    match failure.count {
        Some((wrong, of)) if of > 1 => format!("{wrong} of {of} are wrong; the first: {what}"),
        Some(_) | None => format!("first mistake: {what}"),
    }
}

/// The item of another task that this one needs, which earned nothing.
pub fn resting_on<'a>(item: &'a Item, others: &Score) -> Option<&'a str> {
    let earned_nothing = |id: &&String| {
        let needed = others.items().find(|other| other.id == **id);
        needed.is_some_and(|needed| needed.points == 0)
    };
    item.needs.iter().find(earned_nothing).map(String::as_str)
}

/// Nobody can tell whose mistake it is, where there is no right part to try instead.
pub fn blocked(by: &str, line: ItemScore) -> ItemScore {
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
pub fn hinted(line: &mut ItemScore, mistakes: &[&KnownMistake]) {
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
pub fn carried_forward(by: &str, own: &ItemScore, carried: ItemScore) -> ItemScore {
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
