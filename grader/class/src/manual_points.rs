//! Manual points: points that staff add or deduct, and comments, from a CSV file with a row for
//! each student and task. They are kept separate from the graded points.

use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::mem;
use std::path::{Path, PathBuf};

use grader::handed_out::HandedOut;
use serde::Serialize;

use crate::entry::{EntryInfo, Person};
use crate::error::Error;
use crate::identity::person_ids;
use crate::names::are_equal;
use crate::outcome::{EntryOutcome, TaskScore};
use crate::table::Table;

/// The required columns. A column `date` is optional.
const COLUMNS: [&str; 5] = ["student", "task", "delta", "comment", "author"];
const REMEDY: &str = "manual points need the columns student, task, delta, comment and author";

/// Points that staff gave somebody for a task, and the reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ManualPoints {
    /// The row in the file, as spreadsheets number it.
    pub row: usize,
    /// The student's identifier or name, as written in the file.
    pub student: String,
    /// The task's id.
    pub task: String,
    /// The points to add, or to deduct if negative.
    pub delta: i32,
    /// The reason, for the student.
    pub comment: String,
    /// The person who gave the points.
    pub author: String,
    /// The date of the decision, as written in the file. May be empty.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub date: String,
}

/// The manual points of a class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ManualPointsList {
    path: PathBuf,
    all: Vec<ManualPoints>,
}

impl ManualPointsList {
    /// Reads a file and checks each row on its own.
    pub fn read(path: &Path, handed_out: &HandedOut) -> Result<Self, Error> {
        let table = Table::read(path)?;
        let mut columns = [0; 5];
        for (index, name) in columns.iter_mut().zip(COLUMNS) {
            *index = table.require_column(path, name, REMEDY)?;
        }
        let date = table.column("date");
        let mut list = ManualPointsList {
            path: path.to_owned(),
            all: Vec::new(),
        };
        for (row, cells) in table.numbered_rows() {
            let date = date.map_or("", |index| cells[index].trim());
            let cells = columns.map(|index| cells[index].trim().to_owned());
            let points = ManualPoints::parse(row, cells, handed_out);
            let points = points.map_err(|problem| list.error(row, problem))?;
            list.all.push(ManualPoints {
                date: date.to_owned(),
                ..points
            });
        }
        Ok(list)
    }

    /// Replaces each row for a pseudonym by a row for each person of the submission.
    pub fn resolve_pseudonyms(&mut self, entries: &[&mut EntryInfo]) {
        let resolve = |points: ManualPoints| {
            let is_meant = |info: &&&mut EntryInfo| info.pseudonym == points.student;
            let Some(info) = entries.iter().find(is_meant) else {
                return vec![points];
            };
            let names = info
                .people
                .iter()
                .filter_map(|own| own.identifiers().next());
            let of_person = |name: &str| ManualPoints {
                student: name.to_owned(),
                ..points.clone()
            };
            names.map(of_person).collect()
        };
        self.all = mem::take(&mut self.all)
            .into_iter()
            .flat_map(resolve)
            .collect();
    }

    /// Checks that each row belongs to exactly one of these people, and that no two rows belong to
    /// the same person and task. A person with several submissions is in the list once for each.
    pub fn check_students(&self, people: &[&Person]) -> Result<(), Error> {
        let ids = person_ids(people);
        let mut rows: BTreeMap<(usize, &str), usize> = BTreeMap::new();
        for points in &self.all {
            let found = (0..people.len()).filter(|index| points.is_for(people[*index]));
            let found: Vec<usize> = found.collect();
            let Some(first) = found.first().copied() else {
                let problem = format!(
                    "nobody with the name or identifier {:?} handed something in: write the email \
                     address, the student number, the account name or the full name",
                    points.student
                );
                return Err(self.error(points.row, problem));
            };
            if let Some(other) = found.iter().find(|other| ids[**other] != ids[first]) {
                let problem = format!(
                    "{:?} could be {} or {}: write the email address or the student number",
                    points.student,
                    people[first].display_name(),
                    people[*other].display_name()
                );
                return Err(self.error(points.row, problem));
            }
            if let Some(other) = rows.insert((ids[first], points.task.as_str()), points.row) {
                let problem = format!(
                    "row {other} has points for the same student and task: write them in one row"
                );
                return Err(self.error(points.row, problem));
            }
        }
        Ok(())
    }

    /// Returns the manual points of a person.
    pub fn of(&self, person: &Person) -> Vec<ManualPoints> {
        let own = self.all.iter().filter(|points| points.is_for(person));
        own.cloned().collect()
    }

    /// Checks that no task gets more than its maximum or fewer than 0 points. `exam` contains the
    /// tasks without any points. If the grader or the machine failed, the earned points aren't known
    /// yet.
    pub fn check_range(
        &self,
        points: &[ManualPoints],
        outcome: &EntryOutcome,
        exam: &[TaskScore],
    ) -> Result<(), Error> {
        let tasks = match outcome {
            EntryOutcome::Graded(score) => &score.tasks,
            EntryOutcome::NothingToGrade(_) => exam,
            EntryOutcome::Fault(_) => return Ok(()),
        };
        for ManualPoints {
            row, task, delta, ..
        } in points
        {
            let Some(graded) = tasks.iter().find(|graded| graded.id == *task) else {
                let problem = format!("the exam has no items of the task {task}: remove the row");
                return Err(self.error(*row, problem));
            };
            let (earned, most) = (graded.points, graded.max_points);
            let sum = earned.checked_add_signed(*delta);
            if sum.is_none_or(|sum| sum > most) {
                let problem = format!(
                    "{delta:+} points are out of range: {earned} of {most} points were earned for \
                     {task}"
                );
                return Err(self.error(*row, problem));
            }
        }
        Ok(())
    }

    fn error(&self, row: usize, problem: impl Display) -> Error {
        Error::user(format!("{}, row {row}: {problem}", self.path.display()))
    }
}

impl ManualPoints {
    /// Parses the cells of a row, in the order of [`COLUMNS`].
    fn parse(row: usize, cells: [String; 5], handed_out: &HandedOut) -> Result<Self, String> {
        let [student, task, delta, comment, author] = cells;
        let tasks = handed_out.assignment.tasks.iter().map(|task| task.id);
        let tasks: Vec<&str> = tasks.collect();
        if !tasks.contains(&task.as_str()) {
            let tasks = tasks.join(", ");
            return Err(format!("there is no task {task:?}; the tasks are {tasks}"));
        }
        if student.is_empty() || author.is_empty() {
            return Err("the columns student and author must not be empty".to_owned());
        }
        let Ok(delta) = delta.parse() else {
            let advice = "it must be a whole number of points, such as 2 or -1";
            return Err(format!("delta is {delta:?}: {advice}"));
        };
        Ok(ManualPoints {
            row,
            student,
            task,
            delta,
            comment,
            author,
            date: String::new(),
        })
    }

    fn is_for(&self, person: &Person) -> bool {
        let mut texts = person.identifiers();
        texts.any(|text| are_equal(text, &self.student))
    }
}

impl fmt::Display for ManualPoints {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let ManualPoints {
            task,
            delta,
            comment,
            author,
            date,
            ..
        } = self;
        let points = match delta.abs() {
            1 => "point",
            _ => "points",
        };
        write!(f, "{task}: {delta:+} {points} by {author}")?;
        if !date.is_empty() {
            write!(f, ", {date}")?;
        }
        match comment.as_str() {
            "" => Ok(()),
            comment => write!(f, ": {comment}"),
        }
    }
}
