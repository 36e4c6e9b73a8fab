//! Manual points: points that staff add or deduct, with comments. They are read from a CSV file
//! with a row for each student and task, and are kept separate from the graded points.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Display};
use std::mem;
use std::path::{Path, PathBuf};

use grader::handed_out::HandedOut;
use grader::printing::print_error_line;
use serde::Serialize;

use crate::entry::{EntryInfo, Person};
use crate::error::Error;
use crate::identity::{distinct_name, person_ids};
use crate::names::{are_equal, are_same_name, with_detail};
use crate::outcome::{EntryOutcome, TaskScore};
use crate::table::Table;

/// The required columns. A `date` column is optional.
const COLUMNS: [&str; 5] = ["student", "task", "delta", "comment", "author"];
/// The prefix of every pseudonym.
pub const PSEUDONYM_PREFIX: &str = "anon-";
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
    /// The pseudonym in the file, which stands for one attempt, or an empty string.
    #[serde(skip)]
    pub pseudonym: String,
}

/// The manual points of a class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ManualPointsList {
    path: PathBuf,
    all: Vec<ManualPoints>,
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
            all: Vec::new(),
        };
        for (row, cells) in table.numbered_rows() {
            let date = date.map_or("", |index| cells[index].trim()).to_owned();
            let cells = columns.map(|index| cells[index].trim().to_owned());
            let points = ManualPoints::parse(row, cells, date, handed_out);
            let points = points.map_err(|problem| list.error(row, problem))?;
            list.all.push(points);
        }
        Ok(list)
    }

    /// Replaces each row for a pseudonym with rows for the people who handed in the submission, or
    /// with a row for one member of the group. If a name in a row differs from a person's name only
    /// in punctuation, replaces it with the person's name.
    pub fn resolve_names(&mut self, entries: &[&mut EntryInfo]) {
        let resolve = |points: ManualPoints| {
            let (pseudonym, member) = split_pseudonym(&points.student);
            let is_meant = |info: &&&mut EntryInfo| info.pseudonym == pseudonym;
            let Some(info) = entries.iter().find(is_meant) else {
                return vec![points.with_name_of(entries)];
            };
            let people = (1..).zip(&info.people);
            let people = people.filter(|(number, _)| member.is_none_or(|own| own == *number));
            let names = people.filter_map(|(_, own)| own.identifiers().next());
            let of_person = |name: &str| ManualPoints {
                student: name.to_owned(),
                pseudonym: pseudonym.to_owned(),
                ..points.clone()
            };
            let own: Vec<ManualPoints> = names.map(of_person).collect();
            if own.is_empty() { vec![points] } else { own }
        };
        let all = mem::take(&mut self.all).into_iter();
        self.all = all.flat_map(resolve).collect();
    }

    /// Checks that each row belongs to exactly one of these people, and that no two rows belong to
    /// the same person and task. `people` contains each person once per submission. `missing` lists
    /// the people on the lists who submitted nothing.
    pub fn check_students(&self, people: &[&Person], missing: &[Person]) -> Result<(), Error> {
        let ids = person_ids(people);
        let mut rows: BTreeMap<(usize, &str), usize> = BTreeMap::new();
        for points in &self.all {
            let (row, student) = (points.row, &points.student);
            let all = people.iter().zip(&ids);
            let mut found = all.filter(|(person, _)| points.is_for(person));
            let Some((first, id)) = found.next() else {
                let remedy = match missing.iter().find(|person| points.is_for(person)) {
                    Some(person) => format!(
                        "to give points anyway, add an empty submission for {:?}, named like the others",
                        person.display_name()
                    ),
                    None if student.starts_with(PSEUDONYM_PREFIX) => "the submission with this \
                        pseudonym is not in the input: remove the row, or use the name of the \
                        student, who is listed in anonymous-key.json"
                        .to_owned(),
                    None => "use the email address, the student number, the account name or the \
                             full name"
                        .to_owned(),
                };
                return Err(self.error(
                    row,
                    format!("nobody called {student:?} handed anything in: {remedy}"),
                ));
            };
            if let Some((other, _)) = found.find(|(_, other)| *other != id) {
                let shown = |person| distinct_name(person, people.iter().copied());
                let [first, other] = [*first, *other].map(shown);
                return Err(self.error(
                    row,
                    format!(
                        "{student:?} could be {first} or {other}: use the email address or the \
                     student number"
                    ),
                ));
            }
            if let Some(other) = rows.insert((*id, points.task.as_str()), row) {
                return Err(self.error(
                    row,
                    format!("row {other} is for the same student and task: combine the two rows"),
                ));
            }
        }
        Ok(())
    }

    /// Returns the manual points of a person for a submission. A row for a pseudonym isn't used for
    /// the person's other submissions.
    pub fn of(&self, person: &Person, submission: &EntryInfo) -> Vec<ManualPoints> {
        let is_for_submission =
            |own: &&ManualPoints| ["", &submission.pseudonym].contains(&&*own.pseudonym);
        let own = self.all.iter().filter(|points| points.is_for(person));
        own.filter(is_for_submission).cloned().collect()
    }

    /// Prints a warning for each row that is for this submission's pseudonym, because another
    /// attempt by the person counts.
    pub fn warn_about_attempt(&self, person: &Person, submission: &EntryInfo) {
        for points in self.of(person, submission) {
            if !points.pseudonym.is_empty() {
                let problem = "another attempt counts instead, so these points have no effect: \
                               remove the row, or use the student's name";
                print_error_line(self.error(points.row, problem));
            }
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
        for ManualPoints {
            row,
            student,
            task,
            delta,
            ..
        } in points
        {
            let Some(graded) = tasks.iter().find(|graded| graded.id == *task) else {
                let problem = format!("the exam has no items for the task {task}: remove the row");
                return Err(self.error(*row, problem));
            };
            let (earned, most) = (graded.points, graded.max_points);
            let sum = earned.checked_add_signed(*delta);
            if sum.is_none_or(|sum| sum > most) {
                return Err(self.error(*row, format!(
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

/// Splits `anon-1, member 2`, as shown in the graders' tables, into the pseudonym and the number.
fn split_pseudonym(student: &str) -> (&str, Option<usize>) {
    let parts = student.split_once(", member ");
    let parts = parts.filter(|(own, _)| !own.is_empty());
    let member = parts.and_then(|(own, number)| Some((own, number.parse().ok()?)));
    member.map_or((student, None), |(own, number)| (own, Some(number)))
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
            pseudonym: String::new(),
        })
    }

    /// If no person's name is identical to the row's, but exactly one differs from it only in
    /// punctuation, returns the points with that person's name. Otherwise, returns the points
    /// unchanged.
    fn with_name_of(mut self, entries: &[&mut EntryInfo]) -> Self {
        let people = || entries.iter().flat_map(|info| &info.people);
        let names = people().map(|person| person.name.as_str());
        let names = names.filter(|name| are_same_name(name, &self.student));
        let names: BTreeSet<&str> = names.collect();
        if names.len() == 1 && !people().any(|person| self.is_for(person)) {
            self.student = names.into_iter().collect();
        }
        self
    }

    fn is_for(&self, person: &Person) -> bool {
        let mut texts = person.identifiers();
        texts.any(|text| are_equal(text, &self.student))
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
