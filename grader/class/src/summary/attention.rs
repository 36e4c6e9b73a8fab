//! The submissions that need attention, and why.

use std::collections::{BTreeMap, BTreeSet};

use indexmap::IndexMap;
use serde::Serialize;

use crate::distribution::Distribution;
use crate::graded_class::{ClassRow, GradedClass};
use crate::names::with_detail;
use crate::outcome::{EntryOutcome, ItemScore, ScoreSummary, id_and_names};

/// The advice if a file is missing and there is a message to the student.
const ASK_FOR_FILE: &str = "; ask for it, using the message in hand-in-again, or correct its name";

/// A submission that needs attention.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outlier {
    /// The entry's id.
    pub id: String,
    /// The names of its people.
    pub names: String,
    /// The reasons that the submission needs attention, as text.
    pub why: String,
    /// Whether the submission has a report.
    #[serde(skip)]
    pub has_report: bool,
    /// The reasons in `why`, separately.
    #[serde(skip)]
    pub reasons: Vec<Reason>,
}

/// A reason that submissions need attention, with advice.
#[derive(Clone, Debug, PartialEq)]
pub struct Reason {
    /// The cause, which several submissions can share.
    pub cause: &'static str,
    /// The facts about one submission, or an empty string.
    pub detail: String,
    /// The advice, which starts with a semicolon, or an empty string.
    pub remedy: &'static str,
}

/// A sentence about submissions that need attention for the same reason, and a map of these
/// submissions, keyed by detail. If all submissions share a detail, it is part of the sentence
/// instead, and the key is empty.
pub type AttentionGroup<'a> = (String, BTreeMap<&'a str, Vec<&'a Outlier>>);

/// Groups the submissions that need attention by cause and remedy.
pub fn attention_groups(outliers: &[Outlier]) -> Vec<AttentionGroup<'_>> {
    let mut groups: IndexMap<_, BTreeMap<&str, Vec<&Outlier>>> = IndexMap::new();
    for outlier in outliers {
        for reason in &outlier.reasons {
            let details = groups.entry((reason.cause, reason.remedy)).or_default();
            details.entry(&*reason.detail).or_default().push(outlier);
        }
    }
    let described = groups.into_iter().map(|((cause, remedy), details)| {
        if details.len() > 1 {
            return (format!("{cause}{remedy}"), details);
        }
        let detail: String = details.keys().copied().collect();
        let all = details.into_values().flatten().collect();
        (
            with_detail(cause, &detail) + remedy,
            BTreeMap::from([("", all)]),
        )
    });
    described.collect()
}

impl Reason {
    fn text(&self) -> String {
        with_detail(self.cause, &self.detail) + self.remedy
    }
}

impl Outlier {
    /// Returns the id and, if they differ from it, the names of the people.
    pub fn title(&self) -> String {
        id_and_names(&self.id, &self.names)
    }
}

/// Returns the submissions that have no score or no points, are far below the others (by Tukey's
/// fence), lack a file, or contain files that look like task files but were not graded.
pub(super) fn outliers(
    class: &GradedClass,
    points: Option<&Distribution>,
    with_message: &BTreeSet<usize>,
) -> Vec<Outlier> {
    let fence = points.map_or(0.0, |points| {
        let [lower, upper] = [points.lower_quartile, points.upper_quartile].map(f64::from);
        lower - 1.5 * (upper - lower)
    });
    let outlier = |(index, row): (usize, &ClassRow)| {
        let has_message = with_message.contains(&index);
        let copies = row.result.ignored_copies().iter().map(|note| Reason {
            cause: "some files are copies or have unexpected names",
            detail: note.clone(),
            remedy: "; check which of them should be graded",
        });
        let problem = match row.result.score().filter(|_| row.problem().is_none()) {
            Some(score) => low_score(score, fence),
            None => missing_grade(row),
        };
        let unlisted = row.result.info.is_unlisted.then(|| Reason {
            cause: "nobody on the lists has this name or identifier",
            detail: String::new(),
            remedy: "; correct the name or the list, unless these people aren't in the course",
        });
        let missing = row.result.missing_files().map(|file| Reason {
            cause: "a file is missing",
            detail: file.to_owned(),
            // Without a message, staff have decided, or this is the graders' copy.
            remedy: if has_message { ASK_FOR_FILE } else { "" },
        });
        let problem = problem.into_iter().chain(unlisted).chain(missing);
        let problem: Vec<Reason> = problem.collect();
        let why = problem.iter().map(Reason::text);
        let why: Vec<String> = why.chain(copies.clone().map(|copy| copy.detail)).collect();
        (!row.is_superseded() && !why.is_empty()).then(|| Outlier {
            id: row.result.id.clone(),
            names: row.result.info.display_names(),
            why: why.join("; "),
            has_report: row.result.score().is_some(),
            reasons: problem.into_iter().chain(copies).collect(),
        })
    };
    let rows = class.rows.iter().enumerate();
    rows.filter_map(outlier).collect()
}

/// If one of the people has no final points, returns the reason.
fn missing_grade(row: &ClassRow) -> Option<Reason> {
    let grade = row.grades.iter().find(|grade| grade.counted.is_none())?;
    let remedy = match (&row.result.outcome, &grade.problem) {
        (EntryOutcome::NothingToGrade(_), None) if row.result.info.needs_staff => {
            "; correct this in the input, or give manual points"
        }
        (EntryOutcome::NothingToGrade(_), None) => {
            "; ask for the files, using the message in hand-in-again, or give manual points"
        }
        (EntryOutcome::Fault(_), _) => "; run this command again",
        (_, _) => "",
    };
    Some(Reason {
        cause: row.status(grade),
        detail: row.why(grade),
        remedy,
    })
}

/// If a score is 0 points or below the fence, returns the reason that the submission needs
/// attention.
fn low_score(score: &ScoreSummary, fence: f64) -> Option<Reason> {
    let is_uncompiled = |item: &ItemScore| item.verdict == "not_compiled";
    let is_unwritten = |item: &ItemScore| item.verdict == "unimplemented";
    let mut detail = String::new();
    let (cause, remedy) = match score.points {
        _ if score.items().all(is_uncompiled) => (
            "0 points: nothing compiles",
            "; the report shows the errors",
        ),
        // Not every item has this verdict, because the code that students are given for building
        // and traversing a BVH already runs.
        0 if score.items().any(is_unwritten) => (
            "0 points: some code is not written yet",
            "; ask for the right files",
        ),
        0 => ("0 points", "; read the report"),
        points if f64::from(points) < fence => {
            detail = format!("{points} points");
            ("far below the others", "; read the report")
        }
        _ => return None,
    };
    Some(Reason {
        cause,
        detail,
        remedy,
    })
}
