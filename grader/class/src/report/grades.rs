//! Writes `grades.csv`, with a row for each student.

use crate::entry::Person;
use crate::graded_class::{ClassRow, GradedClass, PersonGrade};
use crate::names::joined;
use crate::outcome::EntryResult;
use crate::table::{Table, safe_cell};

const COLUMNS_BEFORE_TASKS: &str =
    "submission,name,email,sid,username,status,counts,points,max_points";
const COLUMNS_AFTER_TASKS: &str =
    "manual,late_days,submitted,from,why,comments,report,late_flag,ignored_copies,counts_max";

/// The text for a submission that the platform marks as late.
pub const LATE: &str = "LATE";

/// Returns the table of the class. If a submission doesn't have a score, the cells for its points
/// are left empty: the teacher decides how many points it gets.
pub fn grades_table(class: &GradedClass) -> Table {
    let tasks = class.tasks().iter().map(|task| task.id.as_str());
    let header = COLUMNS_BEFORE_TASKS.split(',').chain(tasks.clone());
    let header: Vec<&str> = header.chain(COLUMNS_AFTER_TASKS.split(',')).collect();
    let mut rows = Vec::new();
    for class_row in &class.rows {
        let people = class_row.people();
        rows.extend(people.map(|(person, grade)| row(class_row, person, grade, tasks.len())));
    }
    for person in &class.missing {
        let mut row = person_cells("", person, "nothing submitted");
        row.resize(header.len(), String::new());
        rows.push(row);
    }
    Table::new(&header, rows)
}

fn row(class_row: &ClassRow, person: &Person, grade: &PersonGrade, tasks: usize) -> Vec<String> {
    let EntryResult { id, info, .. } = &class_row.result;
    let mut row = person_cells(id, person, class_row.status(grade));
    let counted = grade.counted.as_ref();
    let counts = counted.map(|counted| counted.points.to_string());
    row.push(counts.unwrap_or_default());
    let score = class_row.result.score();
    match score {
        Some(score) => {
            row.extend([score.points, score.max_points].map(|points| points.to_string()));
            row.extend(score.tasks.iter().map(|task| task.points.to_string()));
        }
        None => row.extend(vec![String::new(); 2 + tasks]),
    }
    let late = match counted {
        Some(counted) => counted.late_days.to_string(),
        None => if info.is_late() { "late" } else { "" }.to_owned(),
    };
    let report = score.map(|_| format!("students/{id}/report.html"));
    let manual = counted.filter(|counted| counted.manual != 0);
    let manual = manual.map(|counted| counted.manual.to_string());
    let comments = grade.manual.iter().map(ToString::to_string);
    row.extend([
        manual.unwrap_or_default(),
        late,
        safe_cell(info.submitted().unwrap_or_default()),
        safe_cell(&info.from),
        safe_cell(&class_row.why(grade)),
        safe_cell(&joined(comments, "; ")),
        safe_cell(&report.unwrap_or_default()),
        if info.is_late() { LATE } else { "" }.to_owned(),
        safe_cell(&class_row.result.ignored_copies().join("; ")),
        counted.map_or(String::new(), |counted| counted.max_points.to_string()),
    ]);
    row
}

fn person_cells(id: &str, person: &Person, status: &str) -> Vec<String> {
    let [email, sid, login] = person.own_identifiers();
    let cells = [id, &person.name, email, sid, login, status];
    cells.map(safe_cell).to_vec()
}
