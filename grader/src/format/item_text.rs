//! Plain text about an item, for platforms that show only text.

use judging::section::Section;

use crate::format::{FormatContext, StudentView};
use crate::report::text::HintDetail;
use crate::score::{Hint, ItemScore, Verdict};

/// The id of the exam that students can run themselves.
const PRACTICE: &str = "practice";

/// Returns the rows of an item, such as `what: …` and `asked: …`, one per line. The text is empty
/// if there is nothing to report.
pub fn item_text(view: &StudentView, item: &ItemScore, context: &FormatContext) -> String {
    let evidence = item.evidence.as_ref();
    let is_passed = item.verdict == Verdict::Pass;
    let can_rerun = view.visible.exam.id == PRACTICE && !is_passed && !item.message.is_empty();
    let rows = [
        ("what", Some(item_message(item))),
        ("asked", evidence.map(|evidence| evidence.asked.clone())),
        ("got", evidence.map(|evidence| evidence.got.clone())),
        ("wanted", evidence.map(|evidence| evidence.wanted.clone())),
        ("look", item.where_to_look().cloned()),
        ("hint", hint_text(&item.hints, context)),
        ("read", item.section.as_ref().map(Section::location)),
        (
            "again",
            can_rerun.then(|| item.rerun_command(&view.visible.rerun_command)),
        ),
    ];
    let rows = rows.into_iter().filter_map(|(label, text)| {
        let text = text.filter(|text| !text.is_empty())?;
        Some(format!("{label}: {text}"))
    });
    rows.collect::<Vec<_>>().join("\n")
}

/// Returns what happened, in one sentence. The text is empty if the item has no message or if the
/// message is hidden.
pub fn item_message(item: &ItemScore) -> String {
    match (item.verdict == Verdict::Pending, item.message.is_empty()) {
        (true, _) => item.verdict.label().to_owned(),
        (false, true) => String::new(),
        (false, false) => item.message.clone(),
    }
}

fn hint_text(hints: &[Hint], context: &FormatContext) -> Option<String> {
    let text = |hint: &Hint| {
        if context.hints == HintDetail::Full {
            hint.hint.clone()
        } else {
            hint.nudge.clone()
        }
    };
    let all: Vec<String> = hints.iter().map(text).collect();
    (!all.is_empty()).then(|| all.join(" Or: "))
}

/// Returns the compiler's messages and the grader's notes about the files.
pub fn build_report(view: &StudentView) -> String {
    let build = &view.visible.build;
    let files = build.not_compiled.iter().map(|file| file.message.clone());
    let notes = build.notes.iter().map(|note| format!("note: {note}"));
    files.chain(notes).collect::<Vec<_>>().join("\n\n")
}

/// Returns one line with the points that were earned.
pub fn headline(view: &StudentView) -> String {
    let score = &view.visible;
    format!(
        "{} of {} points, {} exam",
        score.points, score.max_points, score.exam.id
    )
}

/// Returns one line with the points that were earned and, if they are others, those that count.
pub fn headline_with_counted(view: &StudentView) -> String {
    match view.counted_text() {
        Some(counted) => format!("{}. {counted}", headline(view)),
        None => headline(view),
    }
}
