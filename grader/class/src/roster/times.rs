//! The submission times in lists.

use grader::policy::{are_far_apart, read_time};
use jiff::Timestamp;
use jiff::tz::TimeZone;

use super::Member;
use crate::entry::{EntryInfo, ListedTime};
use crate::list_kind::ListKind;

/// Copies submission times from the roster, Gradescope's list or Moodle's worksheet to entries that
/// have none in the platform's export.
pub fn set_submission_times(rows: &[Member], entries: &mut [&mut EntryInfo]) {
    for info in entries.iter_mut().filter(|info| info.submitted.is_none()) {
        let team = info.team_record();
        let theirs = rows.iter().filter(|row| {
            let mut people = info.people.iter().chain(&team);
            let has_time = row.list != ListKind::Canvas && !row.submitted.is_empty();
            has_time && people.any(|person| row.matches(person))
        });
        let mut theirs: Vec<&Member> = theirs.collect();
        // The roster takes precedence over the list in the download.
        if theirs.iter().any(|row| row.list == ListKind::Roster) {
            theirs.retain(|row| row.list != ListKind::Downloaded);
        }
        // If there are several submissions, the last one was cloned. If a time is unreadable, it is
        // unclear which submission is the last, so the unreadable time takes precedence and is
        // reported.
        let Some(last) = theirs.iter().max_by_key(|member| {
            let time = time(member);
            (time.is_none(), time)
        }) else {
            continue;
        };
        let is_far = |other: &&&Member| {
            let both = time(last).zip(time(other));
            both.is_some_and(|(last, other)| are_far_apart(last, other))
        };
        let submitted = match theirs.iter().find(is_far) {
            // One of the two times must be wrong, so neither is used.
            Some(other) => format!("{} or {}", other.submitted, last.submitted),
            None => last.submitted.clone(),
        };
        info.listed = Some(ListedTime {
            submitted,
            late: last.late,
        });
    }
}

/// Returns the submission time, for comparison with other times in the same list. All local times
/// in a list are in the same time zone, so any zone will do.
fn time(member: &Member) -> Option<Timestamp> {
    read_time(&member.submitted, Some(&TimeZone::UTC)).ok()
}
