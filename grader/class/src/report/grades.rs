//! `grades.csv`: a line for each student, to be opened anywhere.

use crate::entry::Person;
use crate::model::{ClassRow, GradedClass};
use crate::table::{Table, escape_formula};

const COLUMNS_BEFORE_TASKS: [&str; 9] = [
    "submission",
    "name",
    "email",
    "sid",
    "username",
    "status",
    "counts",
    "points",
    "max_points",
];
const COLUMNS_AFTER_TASKS: [&str; 5] = ["late_days", "submitted", "from", "why", "report"];

/// The table of the class. Whoever has no score has no number in it: that is for a person to
/// decide.
pub fn grades_table(class: &GradedClass) -> Table {
    let first = class.scores().next();
    let tasks: Vec<&str> = first.map_or(Vec::new(), |(_, score)| {
        score.tasks.iter().map(|task| task.id.as_str()).collect()
    });
    let header: Vec<&str> = [&COLUMNS_BEFORE_TASKS[..], &tasks, &COLUMNS_AFTER_TASKS].concat();
    let mut table = Table::new(&header);
    for line in &class.rows {
        for person in &line.result.info.people {
            table.rows.push(row(line, person, tasks.len()));
        }
    }
    for person in &class.missing {
        let mut row = person_cells("", person, "nothing handed in");
        row.resize(header.len(), String::new());
        table.rows.push(row);
    }
    table
}

fn row(line: &ClassRow, person: &Person, tasks: usize) -> Vec<String> {
    let mut row = person_cells(&line.result.id, person, line.status());
    let counted = line.counted.map(|counted| counted.points.to_string());
    row.push(counted.unwrap_or_default());
    match line.result.score() {
        Some(score) => {
            row.extend([score.points, score.max_points].map(|points| points.to_string()));
            row.extend(score.tasks.iter().map(|task| task.points.to_string()));
        }
        None => row.extend(vec![String::new(); 2 + tasks]),
    }
    let late = match (line.counted, line.result.info.late) {
        (Some(counted), _) => counted.late_days.to_string(),
        (None, true) => "late".to_owned(),
        (None, false) => String::new(),
    };
    let about = &line.result.info;
    let report = line
        .result
        .score()
        .map(|_| format!("students/{}/report.html", line.result.id));
    row.extend([
        late,
        escape_formula(about.submitted.as_deref().unwrap_or_default()),
        escape_formula(&about.from),
        escape_formula(line.why()),
        report.unwrap_or_default(),
    ]);
    row
}

fn person_cells(id: &str, person: &Person, status: &str) -> Vec<String> {
    [
        id,
        &person.name,
        &person.email,
        &person.sid,
        &person.login,
        status,
    ]
    .map(escape_formula)
    .to_vec()
}
