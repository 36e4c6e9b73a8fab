//! Reads the numbers in all files of a class, and compares them with the expected ones.

use std::fs;
use std::path::Path;

use grader::handed_out::RAYS;
use serde_json::Value;

use super::Rules;
use crate::stored_class::{StoredEntry, id, people};

/// The files of a class, and the numbers in them that are not the expected ones.
struct Walk<'a> {
    out: &'a Path,
    found: Vec<String>,
}

impl Walk<'_> {
    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.out.join(file)).unwrap()
    }

    fn compare(&mut self, file: &str, what: &str, got: &str, expected: &str) {
        if got != expected {
            let text = format!("{file}: {what} is {got:?} instead of {expected:?}");
            self.found.push(text);
        }
    }

    /// Compares the cells in a table's row, in which `key` is the content of a cell.
    fn compare_row(&mut self, file: &str, key: &str, cells: &[(&str, String)]) {
        let text = self.read(file);
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().unwrap().clone();
        let mut rows = reader.records().map(Result::unwrap);
        let row = rows.find(|row| row.iter().any(|cell| cell == key));
        let row = row.unwrap_or_else(|| panic!("{file} lacks {key}: {text}"));
        for (title, expected) in cells {
            let column = header.iter().position(|name| name == *title);
            let got = &row[column.unwrap_or_else(|| panic!("{file} lacks {title}"))];
            self.compare(file, &format!("{title} of {key}"), got, expected);
        }
    }
}

/// Returns the disagreements in all files of a class.
pub fn disagreements(out: &Path, class: &[StoredEntry], rules: Rules) -> Vec<String> {
    let found = Vec::new();
    let mut walk = Walk { out, found };
    for (index, entry) in class.iter().enumerate() {
        walk_pages(&mut walk, &id(index), entry, rules);
        walk_row_of_page(&mut walk, index, entry, rules);
        for person in people(index, entry) {
            let numbers = rules.numbers(entry);
            let counts = text(numbers.as_ref().map(|numbers| numbers.counts));
            let mut cells = vec![
                ("counts", counts.clone()),
                (
                    "points",
                    text(numbers.as_ref().map(|numbers| numbers.earned)),
                ),
                ("max_points", text(numbers.as_ref().map(|_| 100))),
                (
                    "late_days",
                    text(numbers.as_ref().map(|numbers| numbers.late_days)),
                ),
                (
                    "manual",
                    text(
                        numbers
                            .map(|numbers| numbers.manual)
                            .filter(|sum| *sum != 0),
                    ),
                ),
            ];
            let tasks = RAYS.assignment.tasks.iter().enumerate();
            if class.iter().any(|entry| entry.points.is_some()) {
                cells.extend(tasks.map(|(task, info)| {
                    let points = entry.points.as_ref().map(|points| points[task]);
                    (info.id, text(points))
                }));
            }
            walk.compare_row("grades.csv", &person.login, &cells);
            let cell = |title| [(title, counts.clone())];
            walk.compare_row("canvas.csv", &person.login, &cell("Path Tracer (4242)"));
            walk.compare_row("moodle.csv", &person.email, &cell("Grade"));
            walk.compare_row("gradescope.csv", &person.email, &cell("Total Score"));
        }
    }
    walk_summary(&mut walk, class);
    walk.found
}

fn text(number: Option<impl ToString>) -> String {
    number.map_or(String::new(), |number| number.to_string())
}

/// Checks the score file and the pages of a submission.
fn walk_pages(walk: &mut Walk, id: &str, entry: &StoredEntry, rules: Rules) {
    let (Some(numbers), Some(points)) = (rules.numbers(entry), &entry.points) else {
        return;
    };
    let file = format!("students/{id}/score.json");
    let score: Value = serde_json::from_str(&walk.read(&file)).unwrap();
    let of_tasks = points.iter().map(u32::to_string).collect::<Vec<_>>();
    for (index, expected) in of_tasks.iter().enumerate() {
        let task = &score["tasks"][index];
        walk.compare(&file, "a task", &task["points"].to_string(), expected);
        walk.compare(
            &file,
            "an item",
            &task["items"][0]["points"].to_string(),
            expected,
        );
    }
    let total = score["points"].to_string();
    walk.compare(&file, "the total", &total, &numbers.earned.to_string());

    let is_changed = (numbers.counts, rules.out_of) != (numbers.earned, 100)
        || numbers.late_days > 0
        || numbers.manual != 0;
    let sentence = format!(
        "{} of {} points count towards the grade: {} of 100 points earned",
        numbers.counts, rules.out_of, numbers.earned
    );
    let late = match numbers.late_days {
        0 => String::new(),
        1 => "handed in 1 day late".to_owned(),
        days => format!("handed in {days} days late"),
    };
    for page in ["report.html", "feedback.html"] {
        let file = format!("students/{id}/{page}");
        let page = walk.read(&file);
        if is_changed && !(page.contains(&sentence) && page.contains(&late)) {
            walk.compare(&file, "the page", &page, &format!("{sentence} {late}"));
        }
        if !is_changed && page.contains("count towards the grade") {
            walk.compare(&file, "the page", &page, "");
        }
    }
}

/// Checks the row of a submission on the class's page.
fn walk_row_of_page(walk: &mut Walk, index: usize, entry: &StoredEntry, rules: Rules) {
    let page = walk.read("class.html");
    let names: Vec<String> = people(index, entry)
        .into_iter()
        .map(|who| who.name)
        .collect();
    let table = page.split("id=\"students\"").nth(1).unwrap();
    let mut rows = table.split("<tr>").map(cells);
    let row = rows.find(|cells| cells.first() == Some(&names.join(" + ")));
    let Some(row) = row else {
        walk.compare("class.html", "a row", "", &names.join(" + "));
        return;
    };
    let expected: Vec<String> = match (rules.numbers(entry), &entry.points) {
        (Some(numbers), Some(points)) => {
            let first = [numbers.counts, numbers.earned];
            first.iter().chain(points).map(u32::to_string).collect()
        }
        _ => vec!["–".to_owned(); 2],
    };
    let got = &row[1..=expected.len()];
    walk.compare(
        "class.html",
        &names.join(" + "),
        &got.join(","),
        &expected.join(","),
    );
}

/// Returns the texts of the cells in a row of a page.
fn cells(row: &str) -> Vec<String> {
    let cells = row.split("</td>").flat_map(|cell| cell.split("</th>"));
    cells.map(without_tags).collect()
}

fn without_tags(html: &str) -> String {
    let parts = html
        .split('<')
        .map(|part| part.split_once('>').map_or(part, |(_, text)| text));
    parts.collect()
}

/// Checks the totals, in the summary for programs and on the class's page.
fn walk_summary(walk: &mut Walk, class: &[StoredEntry]) {
    let summary: Value = serde_json::from_str(&walk.read("class.json")).unwrap();
    let page = walk.read("class.html");
    let scores: Vec<&Vec<u32>> = class
        .iter()
        .filter_map(|entry| entry.points.as_ref())
        .collect();
    let graded = summary["graded"].to_string();
    walk.compare("class.json", "graded", &graded, &scores.len().to_string());
    let nothing = summary["nothing_to_grade"].to_string();
    let expected = (class.len() - scores.len()).to_string();
    walk.compare("class.json", "nothing_to_grade", &nothing, &expected);
    if scores.is_empty() {
        return;
    }
    let totals: Vec<u32> = scores.iter().map(|points| points.iter().sum()).collect();
    let mut all = vec![("All tasks", &summary["points"], totals, 100)];
    for (index, task) in RAYS.assignment.tasks.iter().enumerate() {
        let points = scores.iter().map(|points| points[index]).collect();
        all.push((task.title, &summary["tasks"][index], points, task.points));
    }
    for (title, distribution, points, of) in all {
        let number = |name: &str| distribution[name].as_f64().unwrap();
        let mean = f64::from(points.iter().sum::<u32>()) / points.len() as f64;
        // Means have one digit after the point, also in the file for programs.
        let mean = (10.0 * mean).round() / 10.0;
        for (name, expected) in [
            ("of", f64::from(of)),
            ("least", f64::from(*points.iter().min().unwrap())),
            ("most", f64::from(*points.iter().max().unwrap())),
            ("mean", mean),
        ] {
            let (got, expected) = (number(name).to_string(), expected.to_string());
            walk.compare("class.json", &format!("{name} of {title}"), &got, &expected);
        }
        let row = page
            .split("<tr>")
            .map(cells)
            .find(|cells| cells[0] == title);
        let row = row.unwrap_or_else(|| panic!("class.html lacks {title}"));
        let expected = [format!("{mean:.1}"), of.to_string()];
        let got = [row[2].clone(), row[4].clone()];
        walk.compare("class.html", title, &got.join(","), &expected.join(","));
    }
}
