//! Writes `grades.csv`, which has a row for each student.

use crate::entry::Person;
use crate::graded_class::{ClassRow, GradedClass, PersonGrade};
use crate::table::{Table, safe_cell};

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
const COLUMNS_AFTER_TASKS: [&str; 9] = [
    "manual",
    "late_days",
    "submitted",
    "from",
    "why",
    "comments",
    "report",
    "late_flag",
    "ignored_copies",
];

/// The mark of a submission that the platform marks as late.
pub const LATE: &str = "LATE";

/// Returns the table of the class. If a submission has no score, its points are left empty: the
/// teacher decides how many it gets.
pub fn grades_table(class: &GradedClass) -> Table {
    let tasks = class.tasks().iter();
    let tasks: Vec<&str> = tasks.map(|task| task.id.as_str()).collect();
    let header: Vec<&str> = [&COLUMNS_BEFORE_TASKS[..], &tasks, &COLUMNS_AFTER_TASKS].concat();
    let mut table = Table::new(&header);
    for class_row in &class.rows {
        for (person, grade) in class_row.people() {
            table.rows.push(row(class_row, person, grade, tasks.len()));
        }
    }
    for person in &class.missing {
        let mut row = person_cells("", person, "nothing submitted");
        row.resize(header.len(), String::new());
        table.rows.push(row);
    }
    table
}

fn row(class_row: &ClassRow, person: &Person, grade: &PersonGrade, tasks: usize) -> Vec<String> {
    let mut row = person_cells(&class_row.result.id, person, class_row.status(grade));
    let counted = grade.counted.as_ref();
    let counted = counted.map(|counted| counted.points.to_string());
    row.push(counted.unwrap_or_default());
    match class_row.result.score() {
        Some(score) => {
            row.extend([score.points, score.max_points].map(|points| points.to_string()));
            row.extend(score.tasks.iter().map(|task| task.points.to_string()));
        }
        None => row.extend(vec![String::new(); 2 + tasks]),
    }
    let late = match (&grade.counted, class_row.result.info.is_late()) {
        (Some(counted), _) => counted.late_days.to_string(),
        (None, true) => "late".to_owned(),
        (None, false) => String::new(),
    };
    let info = &class_row.result.info;
    let id = &class_row.result.id;
    let report = class_row.result.score();
    let report = report.map(|_| format!("students/{id}/report.html"));
    let manual = grade.counted.as_ref().map_or(0, |counted| counted.manual);
    let comments: Vec<String> = grade.manual.iter().map(ToString::to_string).collect();
    row.extend([
        match manual {
            0 => String::new(),
            points => points.to_string(),
        },
        late,
        safe_cell(info.submitted().unwrap_or_default()),
        safe_cell(&info.from),
        safe_cell(&class_row.why(grade)),
        safe_cell(&comments.join("; ")),
        safe_cell(&report.unwrap_or_default()),
        if info.is_late() { LATE } else { "" }.to_owned(),
        safe_cell(&class_row.result.ignored_copies().join("; ")),
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
    .map(safe_cell)
    .to_vec()
}
