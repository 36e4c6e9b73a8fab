//! The sections of the handout that explain a failure.

use judging::assignment::TaskInfo;
use judging::exam::Item;
use judging::section::Section;
use judging::signatures::PanicKind;

use crate::handed_out::HandedOut;

/// Returns the chapter about the item's task, if the item refers to the handout. The section that
/// the item itself refers to may be in another chapter.
pub(super) fn chapter(item: &Item, handed_out: &HandedOut) -> Option<Section> {
    item.section.as_ref()?;
    Some(Section::new(handed_out.assignment.info(item.task).chapter))
}

/// Returns whether the item's section explains a panic or a stack overflow, and not only wrong
/// answers.
pub(super) fn explains_crashes(item: &Item, info: &TaskInfo) -> bool {
    let sections = info.clues.sections_on_crashes.iter();
    let mut sections = sections.map(|section| Section::new(*section));
    sections.any(|section| item.section.as_ref() == Some(&section))
}

/// Returns the section about panics with this message in the task's code, if there is one.
pub(super) fn section_on_panic(message: &str, info: &TaskInfo) -> Option<Section> {
    let kind = PanicKind::of(message)?;
    let mut sections = info.clues.sections_on_panics.iter();
    let (_, section) = sections.find(|(about, _)| *about == kind)?;
    Some(Section::new(*section))
}
