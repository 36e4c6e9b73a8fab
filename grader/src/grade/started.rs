//! The assignments that a submission has started.

use std::path::Path;

use crate::error::Error;
use crate::grade::options::GradeOptions;
use crate::handed_out::{ASSIGNMENTS, HandedOut};
use crate::submission::Submission;
use crate::workspace::Workspace;

/// Returns the assignments to grade if nothing selects one: the default assignment and every other
/// one that the submission has started. An assignment isn't started if its files are unchanged. If
/// only another assignment's files are in the submission, the default assignment is left out.
pub fn started_assignments(submission: Option<&Path>) -> Result<Vec<&'static HandedOut>, Error> {
    let [default, others @ ..] = ASSIGNMENTS;
    if others.is_empty() {
        return Ok(vec![default]);
    }
    let workspace = Workspace::find()?;
    let collect = |handed_out: &'static HandedOut| {
        let own = || workspace.resolve(Path::new(handed_out.student));
        match submission {
            Some(path) => Submission::collect(&workspace.resolve(path), handed_out),
            None => Submission::collect_package(&own(), handed_out),
        }
    };
    // A submission without the assignment's files cannot be collected.
    let started = others.into_iter().filter(|handed_out| {
        collect(handed_out).is_ok_and(|submission| !submission.is_as_handed_out())
    });
    let started: Vec<&HandedOut> = started.collect();
    if !started.is_empty() && submission.is_some() && collect(default).is_err() {
        return Ok(started);
    }
    Ok([&[default], &started[..]].concat())
}

/// Returns the options for each of these assignments.
///
/// # Errors
///
/// Fails if there are several, but an option is meant for one.
pub fn options_of_each(
    options: &GradeOptions,
    require: u32,
    assignments: &[&'static HandedOut],
) -> Result<Vec<GradeOptions>, Error> {
    let single = [
        ("--format", !options.formats.is_empty()),
        ("--require", require > 0),
        ("--out", options.out.is_some()),
        ("--policy", options.policy.is_some()),
    ];
    let single = single.into_iter().find(|(_, is_used)| *is_used);
    if let (Some((option, _)), [_, _, ..]) = (single, assignments) {
        let ids: Vec<&str> = assignments.iter().map(|it| it.assignment.id).collect();
        return Err(Error::User(format!(
            "{option} works with only one assignment, but several have been started: add \
             --assignment {}",
            ids.join(" or --assignment ")
        )));
    }
    let with = |handed_out: &&'static HandedOut| GradeOptions {
        handed_out,
        ..options.clone()
    };
    Ok(assignments.iter().map(with).collect())
}
