//! Plain text about an item, for platforms that only show text.

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

/// Returns one sentence that says what happened. It is empty if the item's message is missing or
/// hidden.
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

/// Returns one line with the points earned.
pub fn headline(view: &StudentView) -> String {
    let score = &view.visible;
    format!(
        "{} of {} points, {} exam",
        score.points, score.max_points, score.exam.id
    )
}

/// Returns one line with the points earned and, if they differ, the final points.
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
    fn nothing_is_said_about_an_item_of_which_students_see_only_the_points() {
        assert_eq!(text(&sample::restricted(), "sphere.far_root"), "");
    }

    #[test]
    fn only_an_exam_that_students_have_can_be_run_again() {
        let all = "[visibility]\nfinal = 'all'";
        let of_final = sample::view(&sample::of_final_exam(sample::score()), all, 0);
        let [practice, of_final] =
            [sample::open(), of_final].map(|view| text(&view, "triangle.inside"));
        let again = "\nagain: cargo grade --replay triangle.inside#1";
        assert_eq!(practice, format!("{of_final}{again}"));
    }

    #[test]
    fn an_item_that_is_not_graded_says_so_and_cannot_be_run_again() {
        let unfinished = sample::view(&sample::unfinished_score(), "", 0);
        let text = text(&unfinished, "traverse.any_hit");
        assert_eq!(text, "what: not graded yet");
    }

    #[test]
    fn hints_are_as_detailed_as_requested() {
        let context = FormatContext {
            hints: HintDetail::Full,
            ..sample::context()
        };
        let view = sample::open();
        let (_, item) = view.visible_items().nth(1).unwrap();
        let full = "It is not normalised. Or: The camera is another one.";
        assert_eq!(hint_text(&item.hints, &context).as_deref(), Some(full));
        assert_eq!(hint_text(&[], &context), None);
    }

    #[test]
    fn the_headline_has_other_points_only_if_they_count() {
        let earned = "9 of 28 points, practice exam";
        assert_eq!(headline_with_counted(&sample::open()), earned);
    }
}
