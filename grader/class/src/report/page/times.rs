//! The section about submission times: how many submissions were late, and which times are unknown.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::{header, sanitized, section};
use crate::graded_class::{GradeProblem, GradedClass, PersonGrade};
use crate::outcome::id_and_names;
use grader::printing::counted;

/// The maximum number of people whose names are listed in a sentence.
const MAX_NAMES: usize = 20;

/// Renders the section, if anything is known about times.
pub(super) fn times(class: &GradedClass) -> Markup {
    // Add the id, since names may be equal or look alike.
    let grades = || {
        let rows = class.rows.iter();
        let rows = rows.filter(|row| !row.is_of_test_student());
        let people = rows.flat_map(|row| row.people().map(move |person| (row, person)));
        people.map(|(row, (person, grade))| {
            let who = id_and_names(&row.result.id, person.display_name());
            (who, grade)
        })
    };
    let mut days: BTreeMap<u32, usize> = BTreeMap::new();
    for counted in grades().filter_map(|(_, grade)| grade.counted.as_ref()) {
        *days.entry(counted.late_days).or_default() += 1;
    }
    let undated = grades().filter(|(_, grade)| grade.is_undated());
    let undated: Vec<String> = undated.map(|(who, _)| who).collect();
    let undated = match undated.len() {
        0..=MAX_NAMES => undated.join(", "),
        count => format!("{count} people (those without a time in grades.csv)"),
    };
    let is_unclear =
        |grade: &PersonGrade| matches!(grade.problem, Some(GradeProblem::UnclearTime(_)));
    let unclear: Vec<_> = grades().filter(|(_, grade)| is_unclear(grade)).collect();
    let has_late = days.keys().any(|days| *days > 0);
    if !has_late && undated.is_empty() && unclear.is_empty() {
        return html! {};
    }
    let contents = html! {
        table {
            (header(&["Handed in"], ["Students"].iter(), ""))
            tbody { @for (days, count) in &days { tr {
                th scope="row" { (lateness(*days)) }
                td .number { (count) }
            } } }
        }
        @if !undated.is_empty() { p {
            "The submission time of these people is unknown. They count as on time, or as 1 day \
             late if the platform marks them as late: "
            (sanitized(&undated)) "."
        } }
        @if !unclear.is_empty() {
            p { "These people have no final points until the problems are resolved:" }
            ul { @for (who, grade) in &unclear { li {
                strong { (sanitized(who)) }
                @if let Some(problem) = &grade.problem { ": " (sanitized(&problem.to_string())) }
            } } }
        }
    };
    section("times", "Submission times", &contents)
}

fn lateness(days: u32) -> String {
    match days {
        0 => "on time".to_owned(),
        days => format!("{} late", counted(days as usize, "day")),
    }
}
