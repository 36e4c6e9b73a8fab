//! Chooses the next step that a page shows. A course's policy can change after grading, so the
//! finished page contains a step for each failing item, and all but one of them are hidden.

use std::collections::BTreeSet;

use maud::{Markup, html};

/// The beginning of each step, up to its item's id. No text from a submission can contain it, since
/// `<` is escaped.
const STEP: &str = "<div data-step=\"";
/// The attribute that hides a step. It follows the id.
const HIDDEN: &str = " hidden";
/// The end of the id that stands for the items of a task that students may not see.
const NOT_SHOWN: &str = ".not_shown";

/// Renders the step for an item. The last step of a page has an empty id and says that nothing is
/// left to do.
pub(super) fn step(id: &str, is_shown: bool, contents: &Markup) -> Markup {
    html! { div data-step=(id) hidden[!is_shown] { (contents) } }
}

/// Returns a page that shows the step for the first of its items that costs final points. `failing`
/// contains the ids of these items, including those that students may not see. A page without steps
/// is returned unchanged.
pub fn with_next_step(page: &str, failing: &BTreeSet<String>) -> String {
    let mut steps = page.split(STEP);
    let mut text = steps.next().unwrap_or_default().to_owned();
    let steps: Vec<(&str, &str)> = steps.filter_map(|step| step.split_once('"')).collect();
    let is_visible = |item: &str| steps.iter().any(|(id, _)| *id == item);
    let counts = |id: &str| match id.strip_suffix(NOT_SHOWN) {
        Some(task) => {
            let is_of_task = |item: &&String| item.split('.').next() == Some(task);
            let mut items = failing.iter().filter(is_of_task);
            items.any(|item| !is_visible(item))
        }
        None => id.is_empty() || failing.contains(id),
    };
    let shown = steps.iter().position(|(id, _)| counts(id));
    for (index, (id, rest)) in steps.iter().enumerate() {
        let hidden = if shown == Some(index) { "" } else { HIDDEN };
        let rest = rest.strip_prefix(HIDDEN).unwrap_or(rest);
        text += &format!("{STEP}{id}\"{hidden}{rest}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_step_that_counts_is_shown() {
        let ids = ["sphere.uv", "bbox.not_shown", "bbox.flat", "build.cost", ""];
        let step = |(index, id): (usize, &&str)| {
            step(id, index == 0, &html! { "fix " (id) }).into_string()
        };
        let page: String = ids.iter().enumerate().map(step).collect();
        let shown = |failing: &[&str]| {
            let failing = failing.iter().map(|id| (*id).to_owned()).collect();
            let page = with_next_step(&page, &failing);
            assert_eq!(with_next_step(&page, &failing), page);
            let (_, shown) = page.split_once("\">fix ").unwrap();
            assert!(!shown.contains("\">fix "), "{page}");
            shown.split_once('<').unwrap().0.to_owned()
        };
        assert_eq!(shown(&ids), "sphere.uv");
        assert_eq!(shown(&["bbox.flat", "build.cost"]), "bbox.flat");
        assert_eq!(shown(&["bbox.flat", "bbox.hidden"]), "bbox.not_shown");
        assert_eq!(shown(&["sphere.hidden", "build.cost"]), "build.cost");
        assert_eq!(shown(&[]), "");
        assert_eq!(with_next_step("no steps", &BTreeSet::new()), "no steps");
    }
}
