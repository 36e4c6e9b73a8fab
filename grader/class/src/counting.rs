//! Counts the points of all submissions, by the policy, with the points by hand.

use std::collections::BTreeMap;

use grader::policy::Policy;

use crate::attempts::apply_rule;
use crate::error::Error;
use crate::graded_class::ClassRow;
use crate::manual_points::{ManualPoints, ManualPointsList};
use crate::outcome::EntryResult;

/// Applies the policy and the manual points to all results.
pub fn count_points(
    results: Vec<EntryResult>,
    policy: &Policy,
    manual: &ManualPointsList,
    tasks: &BTreeMap<String, u32>,
) -> Result<Vec<ClassRow>, Error> {
    let mut rows = Vec::new();
    for result in results {
        let people = result.info.people.iter();
        let own: Vec<Vec<ManualPoints>> = people.map(|person| manual.of(person)).collect();
        rows.push(ClassRow::new(result, policy, own, tasks.values().sum()));
    }
    apply_rule(policy, &mut rows);
    for row in &rows {
        for grade in row.grades.iter().filter(|grade| !grade.is_set_aside()) {
            manual.check_range(&grade.manual, &row.result.outcome, tasks)?;
        }
    }
    Ok(rows)
}
