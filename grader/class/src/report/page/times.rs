//! The section about submission times: how many submissions were late, and which times are unknown.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::sanitized;
use crate::entry::Person;
use crate::graded_class::{ClassRow, GradeProblem, GradedClass, PersonGrade};
use grader::printing::counted;

/// Renders the section, if anything is known about times.
pub(super) fn section(class: &GradedClass) -> Markup {
    let grades = || class.rows.iter().flat_map(ClassRow::people);
    let mut days: BTreeMap<u32, usize> = BTreeMap::new();
    for counted in grades().filter_map(|(_, grade)| grade.counted.as_ref()) {
        *days.entry(counted.late_days).or_default() += 1;
    }
    let undated = names(grades().filter(|(_, grade)| grade.is_undated));
    let is_unclear =
        |grade: &PersonGrade| matches!(grade.problem, Some(GradeProblem::UnclearTime(_)));
    let unclear: Vec<_> = grades().filter(|(_, grade)| is_unclear(grade)).collect();
    let has_late = days.keys().any(|days| *days > 0);
    if !has_late && undated.is_empty() && unclear.is_empty() {
        return html! {};
    }
    html! {
        section aria-labelledby="times" {
            h2 #times { "Submission times" }
            table {
                thead {
                    tr { th scope="col" { "Handed in" } th scope="col" .number { "Students" } }
                }
                tbody {
                    @for (days, count) in &days {
                        tr {
                            th scope="row" { (lateness(*days)) }
                            td .number { (count) }
                        }
                    }
                }
            }
            @if !undated.is_empty() {
                p { "Counted as on time, since the time is unknown: " (sanitized(&undated)) "." }
            }
            @if !unclear.is_empty() {
                p { "Without final points until somebody has cleared up the following:" }
                ul {
                    @for (person, grade) in &unclear {
                        li {
                            strong { (sanitized(person.display_name())) }
                            @if let Some(problem) = &grade.problem {
                                ": " (sanitized(&problem.to_string()))
                            }
                        }
                    }
                }
            }
        }
    }
}

fn names<'a>(people: impl Iterator<Item = (&'a Person, &'a PersonGrade)>) -> String {
    let names: Vec<&str> = people.map(|(person, _)| person.display_name()).collect();
    names.join(", ")
}

fn lateness(days: u32) -> String {
    match days {
        0 => "on time".to_owned(),
        days => format!("{} late", counted(days as usize, "day")),
    }
}
