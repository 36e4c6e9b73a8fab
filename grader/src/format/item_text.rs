//! Plain text about an item, for platforms that show only text.

use crate::format::{FormatContext, StudentView};
use crate::inputs::exam_source::PRACTICE_ID;
use crate::report::text::joined_hints;
use crate::score::{Hint, ItemScore, Verdict};

/// Returns the rows of an item, such as `what: …` and `asked: …`, one per line. The text is empty
/// if there is nothing to report.
pub fn item_text(view: &StudentView, item: &ItemScore, context: &FormatContext) -> String {
    let is_passed = item.verdict == Verdict::Pass;
    let can_rerun = view.visible.exam.id == PRACTICE_ID && !is_passed && !item.message.is_empty();
    let again = can_rerun.then(|| ("again", item.rerun_command(&view.visible.rerun_command)));
    let rows = item.rows(item_message(item), hint_text(&item.hints, context));
    let rows = rows.into_iter().chain(again);
    let lines = rows.map(|(label, text)| format!("{label}: {text}"));
    lines.collect::<Vec<_>>().join("\n")
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
    (!hints.is_empty()).then(|| joined_hints(hints, context.hints))
}

/// Returns the compiler's messages and the grader's notes about the files.
pub fn build_report(view: &StudentView) -> String {
    let build = &view.visible.build;
    let files = build.not_compiled.iter().map(|file| file.message.clone());
    let notes = build.all_notes().map(|note| format!("note: {note}"));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::tests::sample;
    use crate::report::text::HintDetail;

    /// Returns the text about the item with this id.
    fn text(view: &StudentView, id: &str) -> String {
        let mut items = view.visible.items();
        let item = items.find(|item| item.id == id).unwrap();
        item_text(view, item, &sample::context())
    }

    #[test]
    fn each_fact_about_an_item_has_a_row() {
        insta::assert_snapshot!(text(&sample::open(), "camera.unit_length"));
    }

    #[test]
    fn nothing_is_said_about_an_item_that_passed() {
        assert_eq!(text(&sample::open(), "camera.corners"), "");
        // Nor about one of which students see only the points.
        assert_eq!(text(&sample::restricted(), "sphere.far_root"), "");
    }

    #[test]
    fn a_passed_item_with_a_message_need_not_be_run_again() {
        let text = text(&sample::open(), "traverse.any_hit");
        assert!(text.starts_with("what: wrong only because"), "{text}");
        assert!(!text.contains("again:"), "{text}");
    }

    #[test]
    fn only_an_exam_that_students_have_can_be_run_again() {
        let all = "[visibility]\nfinal = 'all'";
        let of_final = sample::view(&sample::of_final_exam(sample::score()), all, 0);
        let (practice, of_final) = (
            text(&sample::open(), "triangle.inside"),
            text(&of_final, "triangle.inside"),
        );
        let again = "\nagain: cargo grade --replay triangle.inside#1";
        assert_eq!(practice, format!("{of_final}{again}"));
    }

    #[test]
    fn an_item_that_is_not_graded_says_so_and_cannot_be_run_again() {
        let unfinished = sample::view(&sample::unfinished_score(), "", 0);
        assert_eq!(
            text(&unfinished, "traverse.any_hit"),
            "what: not graded yet"
        );
    }

    #[test]
    fn hints_are_as_detailed_as_requested() {
        let mut context = sample::context();
        let view = sample::open();
        let (_, item) = view.visible_items().nth(1).unwrap();
        let nudges = hint_text(&item.hints, &context);
        assert_eq!(nudges.as_deref(), Some("How long is it? Or: Which camera?"));
        context.hints = HintDetail::Full;
        let full = "It is not normalised. Or: The camera is another one.";
        assert_eq!(hint_text(&item.hints, &context).as_deref(), Some(full));
        assert_eq!(hint_text(&[], &context), None);
    }

    #[test]
    fn files_and_notes_are_listed() {
        let report = "error: expected `;`\n --> bbox.rs:7:1\\u{1b}[0m\n\nnote: old/bvh.rs differs \
                      from bvh.rs, and is ignored";
        assert_eq!(build_report(&sample::open()), report);
        let perfect = sample::view(&sample::perfect_score(), "", 0);
        assert_eq!(build_report(&perfect), "");
    }

    #[test]
    fn the_headline_has_other_points_only_if_they_count() {
        let earned = "9 of 28 points, practice exam";
        assert_eq!(headline_with_counted(&sample::open()), earned);
        let late = headline_with_counted(&sample::late());
        assert!(
            late.starts_with(&format!("{earned}. 16 of 56 points count")),
            "{late}"
        );
    }
}
