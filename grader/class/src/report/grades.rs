//! `grades.csv`: a line for each student, to be opened anywhere.

use crate::entry::Person;
use crate::model::{Class, Line};
use crate::table::{Table, guarded};

const BEFORE: [&str; 9] = [
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
const AFTER: [&str; 5] = ["late_days", "submitted", "from", "why", "report"];

/// The table of the class. Whoever has no score has no number in it: that is for a person to
/// decide.
pub fn grades(class: &Class) -> Table {
    let first = class.scores().next();
    let tasks: Vec<&str> = first.map_or(Vec::new(), |(_, score)| {
        score.tasks.iter().map(|task| task.id.as_str()).collect()
    });
    let header: Vec<&str> = [&BEFORE[..], &tasks, &AFTER].concat();
    let mut table = Table::new(&header);
    for line in &class.lines {
        for person in &line.row.about.people {
            table.rows.push(row(line, person, tasks.len()));
        }
    }
    for person in &class.missing {
        let mut row = who("", person, "nothing handed in");
        row.resize(header.len(), String::new());
        table.rows.push(row);
    }
    table
}

fn row(line: &Line, person: &Person, tasks: usize) -> Vec<String> {
    let mut row = who(&line.row.id, person, line.status());
    let counted = line.counted.map(|counted| counted.points.to_string());
    row.push(counted.unwrap_or_default());
    match line.row.score() {
        Some(score) => {
            row.extend([score.points, score.max_points].map(|points| points.to_string()));
            row.extend(score.tasks.iter().map(|task| task.points.to_string()));
        }
        None => row.extend(vec![String::new(); 2 + tasks]),
    }
    let late = match (line.counted, line.row.about.late) {
        (Some(counted), _) => counted.late_days.to_string(),
        (None, true) => "late".to_owned(),
        (None, false) => String::new(),
    };
    let about = &line.row.about;
    let report = line
        .row
        .score()
        .map(|_| format!("students/{}/report.html", line.row.id));
    row.extend([
        late,
        guarded(about.submitted.as_deref().unwrap_or_default()),
        guarded(&about.from),
        guarded(line.why()),
        report.unwrap_or_default(),
    ]);
    row
}

fn who(id: &str, person: &Person, status: &str) -> Vec<String> {
    [
        id,
        &person.name,
        &person.email,
        &person.sid,
        &person.login,
        status,
    ]
    .map(guarded)
    .to_vec()
}
