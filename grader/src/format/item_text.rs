//! What is told of an item beside its points, in lines that every platform can show.

use crate::format::{FormatContext, StudentView};
use crate::policy::CountedPoints;
use crate::score::{Hint, ItemScore, Verdict};
use crate::section::Section;

/// The exam that students can ask by themselves.
const PRACTICE: &str = "practice";

/// One line a row: `what: …`, `asked: …`. Empty if there is nothing to say.
pub fn item_text(seen: &StudentView, item: &ItemScore, around: &FormatContext) -> String {
    let evidence = item.evidence.as_ref();
    let is_passed = item.verdict == Verdict::Pass;
    let again = seen.visible.exam.id == PRACTICE && !is_passed && !item.message.is_empty();
    let rows = [
        ("what", Some(item_message(item))),
        ("asked", evidence.map(|evidence| evidence.asked.clone())),
        ("got", evidence.map(|evidence| evidence.got.clone())),
        ("wanted", evidence.map(|evidence| evidence.wanted.clone())),
        ("look", item.look.clone()),
        ("hint", hint_text(&item.hints, around)),
        ("read", item.section.as_ref().map(Section::location)),
        (
            "again",
            again.then(|| item.rerun_command(&seen.visible.rerun_command)),
        ),
    ];
    let rows = rows.into_iter().filter_map(|(label, text)| {
        let text = text.filter(|text| !text.is_empty())?;
        Some(format!("{label}: {text}"))
    });
    rows.collect::<Vec<_>>().join("\n")
}

/// What happened, in a sentence. Empty if all is well, or nothing may be said.
pub fn item_message(item: &ItemScore) -> String {
    match (item.verdict == Verdict::Pending, item.message.is_empty()) {
        (true, _) => "not asked yet".to_owned(),
        (false, true) => String::new(),
        (false, false) => item.message.clone(),
    }
}

fn hint_text(hints: &[Hint], around: &FormatContext) -> Option<String> {
    let one = |hint: &Hint| match around.full_hints {
        true => hint.hint.clone(),
        false => hint.nudge.clone(),
    };
    let all: Vec<String> = hints.iter().map(one).collect();
    (!all.is_empty()).then(|| all.join(" Or: "))
}

/// What the compiler and the grader had to say of the files.
pub fn build_report(seen: &StudentView) -> String {
    let build = &seen.visible.build;
    let files = build.not_compiled.iter().map(|file| file.message.clone());
    let notes = build.notes.iter().map(|note| format!("note: {note}"));
    files.chain(notes).collect::<Vec<_>>().join("\n\n")
}

fn lateness_text(counted: CountedPoints) -> String {
    match (counted.late_days, counted.is_closed) {
        (0, _) => String::new(),
        (_, true) => ", because it came after the last day".to_owned(),
        (1, false) => ", a day late".to_owned(),
        (days, false) => format!(", {days} days late"),
    }
}

/// The points, in words.
pub fn headline(seen: &StudentView) -> String {
    let (score, counted) = (&seen.visible, seen.counted);
    let points = format!(
        "{} of {} points, {} exam",
        score.points, score.max_points, score.exam.id
    );
    match (counted.points, counted.max_points) == (score.points, score.max_points) {
        true => points,
        false => format!("{points}; counts for {counted}{}", lateness_text(counted)),
    }
}
