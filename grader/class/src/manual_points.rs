//! Manual points: points that staff add or deduct, with comments. They are read from a CSV file
//! with a row for each student and task, and are kept separate from the graded points.

use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::mem;
use std::path::{Path, PathBuf};

use grader::handed_out::HandedOut;
use grader::nearest_name::suggestion;
use grader::printing::print_error_line;
use serde::Serialize;

use crate::entry::{EntryInfo, Person};
use crate::error::Error;
use crate::identity::{
    Attempt, PSEUDONYM_PREFIX, attempts_by_person, distinct_name, matching_people,
    submission_called,
};
use crate::names::{are_equal, are_same_name, joined, with_detail};
use crate::outcome::{EntryOutcome, TaskScore};
use crate::table::Table;

/// The required columns. A `date` column is optional.
const COLUMNS: [&str; 5] = ["student", "task", "delta", "comment", "author"];
const REMEDY: &str = "manual points need the columns student, task, delta, comment and author";

/// Points that staff gave somebody for a task, and the reason.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct ManualPoints {
    /// The row number in the file, as in spreadsheets.
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
    /// Whether the row names a submission, so that it isn't for other attempts.
    #[serde(skip)]
    pub is_for_attempt: bool,
}

/// The manual points of a class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ManualPointsList {
    path: PathBuf,
    /// The rows whose people are still unknown.
    rows: Vec<ManualPoints>,
    /// The manual points for each person in each submission, keyed by the submission's id and the
    /// person's index.
    all: BTreeMap<(String, usize), Vec<ManualPoints>>,
}

impl ManualPointsList {
    /// Reads a file and checks each row separately.
    pub fn read(path: &Path, handed_out: &HandedOut) -> Result<Self, Error> {
        let table = Table::read(path)?;
        let mut columns = [0; 5];
        for (index, name) in columns.iter_mut().zip(COLUMNS) {
            *index = table.require_column(path, name, REMEDY)?;
        }
        let date = table.column("date");
        let mut list = ManualPointsList {
            path: path.to_owned(),
            ..ManualPointsList::default()
        };
        for (row, cells) in table.numbered_rows() {
            let date = date.map_or("", |index| cells[index].trim()).to_owned();
            let cells = columns.map(|index| cells[index].trim().to_owned());
            let points = ManualPoints::parse(row, cells, date, handed_out);
            let points = points.map_err(|problem| list.error(row, problem))?;
            list.rows.push(points);
        }
        Ok(list)
    }

    /// Finds out who each row is for. Checks that no two rows are for the same person and task.
    /// `entries` contains each submission's id and information. `missing` lists the people on the
    /// lists who submitted nothing.
    pub fn find_people(
        &mut self,
        entries: &[(&str, &EntryInfo)],
        missing: &[Person],
    ) -> Result<(), Error> {
        let people = entries.iter().map(|(_, info)| info.people.as_slice());
        let known = attempts_by_person(people.clone());
        let person = |(row, index): &Attempt| &entries[*row].1.people[*index];
        for mut points in mem::take(&mut self.rows) {
            let (row, student) = (points.row, &points.student);
            let refused = |list: &Self, problem: String| Err(list.error(row, problem));
            let found = matching_people(student, entries);
            let Some(first) = found.first() else {
                return refused(self, unknown_name(student, people.flatten(), missing));
            };
            let mut names = person(first).identifiers();
            let is_exact = names.any(|name| are_equal(name, student));
            let submission = submission_called(student, entries).filter(|_| !is_exact);
            let group = &person(first).group;
            let is_team = |own: &Attempt| {
                own.0 == first.0 || (!group.is_empty() && are_equal(group, &person(own).group))
            };
            let is_meant = |own: &&Vec<Attempt>| own.iter().any(|part| found.contains(part));
            let meant = Vec::from_iter(known.iter().filter(is_meant));
            if meant.len() > 1 && (is_exact || !found.iter().all(is_team)) {
                let all = || people.clone().flatten();
                let name = |own: &&Vec<Attempt>| distinct_name(person(&own[0]), all());
                let names = joined(meant.iter().map(name), " or ");
                let advice = "use the email address or the student number";
                return refused(self, format!("{student:?} could be {names}: {advice}"));
            }
            points.is_for_attempt = submission.is_some();
            let parts = meant.into_iter().flatten();
            for part in parts.filter(|part| submission.is_none_or(|row| row == part.0)) {
                let id = entries[part.0].0.to_owned();
                let own = self.all.entry((id, part.1)).or_default();
                if let Some(ManualPoints { row, .. }) =
                    own.iter().find(|own| own.task == points.task)
                {
                    let why =
                        format!("row {row} is for the same student and task: combine the two rows");
                    return refused(self, why);
                }
                own.push(points.clone());
            }
        }
        Ok(())
    }

    /// Returns the manual points for a submission of the person with this index. A row that names a
    /// submission isn't used for the person's other submissions.
    pub fn of(&self, submission: &str, person: usize) -> &[ManualPoints] {
        let own = self.all.get(&(submission.to_owned(), person));
        own.map_or(&[], Vec::as_slice)
    }

    /// Prints a warning for each of these rows that names a submission, because another attempt by
    /// the person counts.
    pub fn warn_about_attempt(&self, points: &[ManualPoints]) {
        for points in points.iter().filter(|points| points.is_for_attempt) {
            let problem = "another attempt counts instead, so these points have no effect: remove \
                           the row, or use the student's name";
            print_error_line(self.error(points.row, problem));
        }
    }

    /// Checks that no task gets more than its maximum or fewer than 0 points. `exam` contains the
    /// exam's tasks with 0 points each. If the grader or the machine failed, nothing is checked,
    /// because the earned points aren't known yet.
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
        for own in points {
            let ManualPoints {
                student,
                task,
                delta,
                ..
            } = own;
            let Some(graded) = tasks.iter().find(|graded| graded.id == *task) else {
                let problem = format!("the exam has no items for the task {task}: remove the row");
                return Err(self.error(own.row, problem));
            };
            let (earned, most) = (graded.points, graded.max_points);
            let sum = earned.checked_add_signed(*delta);
            if sum.is_none_or(|sum| sum > most) {
                return Err(self.error(own.row, format!(
                    "{delta:+} points is out of range: {student} earned {earned} of {most} points \
                     for {task}. Correct this row and pass the table with --manual-points. If the \
                     row was valid before, files were probably handed in again"
                )));
            }
        }
        Ok(())
    }

    fn error(&self, row: usize, problem: impl Display) -> Error {
        Error::user(format!("{}, row {row}: {problem}", self.path.display()))
    }
}

/// Returns the problem with a name that stands for none of these people.
fn unknown_name<'a>(
    student: &str,
    people: impl Iterator<Item = &'a Person>,
    missing: &[Person],
) -> String {
    let is_meant = |person: &&Person| {
        let mut names = person.identifiers().chain([&*person.group]);
        names.any(|name| are_same_name(name, student))
    };
    let known = people.flat_map(|own| own.identifiers().chain([&*own.group]));
    // The account may be known without the address.
    let (account, _) = student.split_once('@').unwrap_or((student, ""));
    let remedy = match missing.iter().find(is_meant) {
        Some(person) => format!(
            ": to give points anyway, add an empty submission for {:?}, named like the others",
            person.display_name()
        ),
        None if student.starts_with(PSEUDONYM_PREFIX) => ": the submission with this pseudonym is \
            not in the input: remove the row, or use the name of the student, who is listed in \
            anonymous-key.json"
            .to_owned(),
        None => {
            suggestion(account, known)
                + ": use a name, email address, account or student id \
            from grades.csv, or the name of a group or submission"
        }
    };
    format!("nobody called {student:?} handed anything in{remedy}")
}

impl ManualPoints {
    /// Parses a row. `cells` contains its cells in the order of [`COLUMNS`].
    fn parse(
        row: usize,
        cells: [String; 5],
        date: String,
        handed_out: &HandedOut,
    ) -> Result<Self, String> {
        let [student, task, delta, comment, author] = cells;
        let tasks = handed_out.assignment.tasks.iter().map(|task| task.id);
        let tasks: Vec<&str> = tasks.collect();
        if !tasks.contains(&task.as_str()) {
            let tasks = tasks.join(", ");
            return Err(format!("unknown task {task:?}; the tasks are {tasks}"));
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
            date,
            is_for_attempt: false,
        })
    }
}

impl fmt::Display for ManualPoints {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let ManualPoints { task, delta, .. } = self;
        let (author, date) = (&self.author, &self.date);
        let plural = if delta.abs() == 1 { "" } else { "s" };
        let comma = if date.is_empty() { "" } else { ", " };
        let text = format!("{task}: {delta:+} point{plural} by {author}{comma}{date}");
        f.write_str(&with_detail(&text, &self.comment))
    }
}
