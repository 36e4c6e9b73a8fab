//! Checks that every link in the handout leads to an existing page, heading or figure, and that
//! every figure is used.

use std::collections::{BTreeMap, BTreeSet};

use judging::exam::Exam;
use judging::section::Section;

use super::pages::{Page, anchor};

/// Returns the broken links in the chapters and the files that no chapter links to. `figures` are
/// the paths of the figures, relative to the chapters' folder.
pub fn broken_links(pages: &[Page], figures: &BTreeSet<String>) -> Vec<String> {
    let anchors = anchors(pages);
    let mut problems = Vec::new();
    for page in pages {
        let links = page.links.iter();
        for link in links.filter(|link| !link.text.contains("://")) {
            let (_, anchor) = link.text.split_once('#').unwrap_or_default();
            let file = page.linked_file(&link.text);
            let problem = match anchors.get(&*file) {
                None if figures.contains(&file) => None,
                None => Some(format!("{file} does not exist")),
                Some(anchors) if anchor.is_empty() || anchors.contains(anchor) => None,
                Some(_) => Some(format!("{file} has no heading for #{anchor}")),
            };
            problems.extend(problem.map(|problem| page.problem(link, &problem)));
        }
    }
    problems.extend(unlinked_files(pages, figures));
    problems
}

/// Returns a problem for each chapter or figure that no chapter links to.
fn unlinked_files(pages: &[Page], figures: &BTreeSet<String>) -> Vec<String> {
    let reached = pages.iter().flat_map(|page| {
        let links = page.links.iter().map(|link| link.text.as_str());
        let links = links.filter(|link| !link.starts_with('#'));
        links.map(|link| page.linked_file(link))
    });
    let reached: BTreeSet<String> = reached.collect();
    let chapters = pages.iter().map(|page| page.name.as_str());
    let all = chapters
        .filter(|name| *name != SUMMARY)
        .chain(figures.iter().map(String::as_str));
    all.filter(|file| !reached.contains(*file))
        .map(|file| format!("{file}: no chapter links to it"))
        .collect()
}

/// The file with the table of contents.
pub const SUMMARY: &str = "SUMMARY.md";

/// Returns a problem for each item without a section, and for each reference from the exam or
/// `others` to a section that doesn't exist. Each element of `others` consists of a description of
/// what refers to a section, followed by that section.
pub fn missing_sections(
    pages: &[Page],
    exam: &Exam,
    others: impl IntoIterator<Item = (String, Section)>,
) -> Vec<String> {
    let problem = |section: &Section| {
        let chapter = pages.iter().find(|page| page.name == section.chapter());
        let mut headings = chapter.into_iter().flat_map(|page| &page.headings);
        match headings.find(|heading| anchor(&heading.text) == section.anchor()) {
            None => Some(format!("the handout has no section {section}")),
            Some(heading) if heading.text != section.heading() => Some(format!(
                "{section} would be shown as \"{}\", but the heading is \"{}\"",
                section.heading(),
                heading.text
            )),
            Some(_) => None,
        }
    };
    let items = exam.items.iter().map(|item| {
        let none = "the item has no section: its declaration must name one".to_owned();
        let problem = item.section.as_ref().map_or(Some(none), problem);
        problem.map(|problem| format!("{}: {problem}", item.id))
    });
    let mistakes = exam.mistakes.iter().map(|mistake| {
        let problem = mistake.section.as_ref().and_then(problem);
        problem.map(|problem| format!("{}: {problem}", mistake.id))
    });
    let others = others.into_iter().map(|(whose, section)| {
        let problem = problem(&section);
        problem.map(|problem| format!("{whose}: {problem}"))
    });
    items.chain(mistakes).chain(others).flatten().collect()
}

fn anchors(pages: &[Page]) -> BTreeMap<&str, BTreeSet<String>> {
    let of = |page: &Page| page.anchors().collect();
    pages
        .iter()
        .map(|page| (page.name.as_str(), of(page)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::items;

    #[test]
    fn reports_missing_sections_and_differing_headings_with_their_item() {
        let mut exam = items::exam_of_boxes();
        exam.items.truncate(3);
        exam.items[1].section = Some(Section::new("boxes.md#flat-boxes"));
        exam.items[2].section = None;
        let other = [("the challenge".to_owned(), Section::new("boxes.md#more"))];
        let page = "# Boxes\n## From the last entry to the first exit\n## Flat, boxes\n";
        assert_eq!(
            missing_sections(&[Page::new("boxes.md", page)], &exam, other),
            [
                "bbox.slab_after_slab: boxes.md#flat-boxes would be shown as \"Flat boxes\", but \
                 the heading is \"Flat, boxes\"",
                "bbox.octants: the item has no section: its declaration must name one",
                "the challenge: the handout has no section boxes.md#more",
            ]
        );
        assert_eq!(
            missing_sections(&[], &exam, [])[0],
            "bbox.through: the handout has no section \
             boxes.md#from-the-last-entry-to-the-first-exit"
        );
    }

    fn figures(names: &[&str]) -> BTreeSet<String> {
        names.iter().map(|name| (*name).to_owned()).collect()
    }

    #[test]
    fn links_to_existing_headings_files_and_figures_pass() {
        let pages = [
            Page::new(
                "a.md",
                "# A\n[b](b.md#the-end) [here](#a) [web](https://example.org)",
            ),
            Page::new(
                "b.md",
                "# B\n[a](a.md)\n## The end\n![a picture](figures/a.svg) [c](c/c.md)",
            ),
            Page::new(
                "c/c.md",
                "# C\n[b](../b.md#the-end)\n![a picture](../figures/c.svg) [here](c.md#c)",
            ),
        ];
        let figures = figures(&["figures/a.svg", "figures/c.svg"]);
        assert_eq!(broken_links(&pages, &figures), [""; 0]);
    }

    #[test]
    fn reports_each_broken_link_with_its_line() {
        let pages = [
            Page::new("a.md", "# A\n\n[b](c.md)\n[here](#b) [a](a.md)"),
            Page::new("b.md", "# B\n![a picture](figures/b.svg)"),
            Page::new("c/c.md", "# C\n[a](a.md) [a](../../a.md) [c](#c)"),
        ];
        assert_eq!(
            broken_links(&pages, &figures(&["figures/a.svg"])),
            [
                "a.md:3: c.md does not exist",
                "a.md:4: a.md has no heading for #b",
                "b.md:2: figures/b.svg does not exist",
                "c/c.md:2: c/a.md does not exist",
                "c/c.md:2: ../a.md does not exist",
                "b.md: no chapter links to it",
                "c/c.md: no chapter links to it",
                "figures/a.svg: no chapter links to it",
            ]
        );
    }
}
