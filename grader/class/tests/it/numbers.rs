//! The numbers that people see. All files of a class must agree on everybody's points. The expected
//! numbers are computed here from the scores, without using the grader's policy.

use std::fs;
use std::path::{Path, PathBuf};

use grader::handed_out::RAYS;
use proptest::prelude::*;
use serde_json::Value;
use tempfile::TempDir;

use crate::harness::{class_command, successful_stdout, table};
use crate::stored_class::{StoredEntry, id, people, stored_class, write_shard};

/// The rules of a course.
#[derive(Clone, Copy, Debug)]
struct Rules {
    out_of: u32,
    percent_per_day: u32,
}

/// The numbers that make up one person's grade.
struct Numbers {
    counts: u32,
    earned: u32,
    manual: i32,
    late_days: u32,
}

impl Rules {
    /// Returns the numbers for a submission, or `None` if there was nothing to grade.
    fn numbers(self, entry: &StoredEntry) -> Option<Numbers> {
        let earned = entry.points.as_ref()?.iter().sum::<u32>();
        let manual = entry.possible_manual();
        let late_days = u32::try_from((entry.hours_late.max(0) + 23) / 24).unwrap();
        let percent = 100 - (self.percent_per_day * late_days).min(100);
        let sum = earned.checked_add_signed(manual).unwrap().min(100);
        Some(Numbers {
            // Rounded to the nearest integer, with halves rounded up.
            counts: (2 * self.out_of * sum * percent + 10_000) / 20_000,
            earned,
            manual,
            late_days,
        })
    }
}

/// Writes the files of a graded class, including gradebooks. Returns their folder.
fn write_class(root: &Path, class: &[StoredEntry], rules: Rules) -> PathBuf {
    let mut manual = "student,task,delta,comment,author\n".to_owned();
    let mut canvas = "Student,ID,SIS User ID,SIS Login ID,Section,Path Tracer (4242)\n".to_owned();
    let mut moodle = "Identifier,Full name,ID number,Email address,Status,Grade,Maximum Grade,\
        Grade can be changed,Last modified (submission),Last modified (grade),Feedback comments\n"
        .to_owned();
    let mut gradescope =
        "First Name,Last Name,SID,Email,Sections,Total Score,Max Points,Status\n".to_owned();
    for (index, entry) in class.iter().enumerate() {
        for person in people(index, entry) {
            let (sid, login, email) = (&person.sid, &person.login, &person.email);
            if entry.possible_manual() != 0 {
                let task = RAYS.assignment.tasks[0].id;
                manual += &format!("{login},{task},{},style,TA\n", entry.possible_manual());
            }
            canvas += &format!("Student {sid},7{sid},{sid},{login},Lab,\n");
            moodle += &format!("Participant 3,Student {sid},{sid},{email},Submitted,,,Yes,-,-,\n");
            gradescope += &format!("Student,{sid},{sid},{email},,,,Graded\n");
        }
    }
    let policy = format!(
        "[points]\nout_of = {}\n[late]\ndue = 2026-11-20T12:00:00Z\npercent_per_day = {}\n",
        rules.out_of, rules.percent_per_day
    );
    let (graded, out) = (root.join("graded"), root.join("out"));
    write_shard(&graded, class, None, false);
    let mut command = class_command();
    command.arg("merge").arg(graded).arg("--out").arg(&out);
    for (option, text) in [
        ("policy", policy),
        ("manual-points", manual),
        ("canvas", canvas),
        ("moodle", moodle),
        ("gradescope", gradescope),
    ] {
        let path = root.join(option);
        fs::write(&path, text).unwrap();
        command.arg(format!("--{option}")).arg(path);
    }
    successful_stdout(&command.output().unwrap());
    out
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn all_files_of_a_class_agree(
        class in stored_class(),
        out_of in 1..=200u32,
        percent_per_day in 0..=40u32,
    ) {
        let root = TempDir::new().unwrap();
        let rules = Rules { out_of, percent_per_day };
        let files = Files(write_class(root.path(), &class, rules));
        for (index, entry) in class.iter().enumerate() {
            if let (Some(numbers), Some(points)) = (rules.numbers(entry), &entry.points) {
                files.check_score(&id(index), &numbers, points);
                files.check_pages(&id(index), &numbers, rules.out_of);
            }
            files.check_row_of_page(index, entry, rules);
            let has_tasks = class.iter().any(|entry| entry.points.is_some());
            files.check_tables(index, entry, rules, has_tasks);
        }
        files.check_summary(&class);
    }
}

/// The folder with the files of a class.
struct Files(PathBuf);

impl Files {
    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.0.join(file)).unwrap()
    }

    fn check_score(&self, id: &str, numbers: &Numbers, points: &[u32]) {
        let score = self.read(&format!("students/{id}/score.json"));
        let score: Value = serde_json::from_str(&score).unwrap();
        for (index, expected) in points.iter().enumerate() {
            let task = &score["tasks"][index];
            assert_eq!(task["points"], *expected);
            assert_eq!(task["items"][0]["points"], *expected);
        }
        assert_eq!(score["points"], numbers.earned);
    }

    fn check_pages(&self, id: &str, numbers: &Numbers, out_of: u32) {
        let Numbers {
            counts,
            earned,
            manual,
            late_days,
        } = numbers;
        let is_changed = (*counts, out_of) != (*earned, 100) || *late_days > 0 || *manual != 0;
        let sentence = format!(
            "{counts} of {out_of} points count towards the grade: {earned} of 100 points earned"
        );
        let late = match late_days {
            0 => String::new(),
            1 => "handed in 1 day late".to_owned(),
            days => format!("handed in {days} days late"),
        };
        for page in ["report.html", "feedback.html"] {
            let page = self.read(&format!("students/{id}/{page}"));
            let has_sentence = page.contains(&sentence) && page.contains(&late);
            assert_eq!(has_sentence, is_changed, "{page}");
            assert_eq!(
                page.contains("count towards the grade"),
                is_changed,
                "{page}"
            );
        }
    }

    /// Checks a person's row in every table.
    fn check_tables(&self, index: usize, entry: &StoredEntry, rules: Rules, has_tasks: bool) {
        let numbers = rules.numbers(entry);
        let text = |of: &dyn Fn(&Numbers) -> u32| text(numbers.as_ref().map(of));
        let counts = text(&|numbers| numbers.counts);
        let manual = numbers.as_ref().map(|numbers| numbers.manual);
        let mut cells = vec![
            ("counts", counts.clone()),
            ("points", text(&|numbers| numbers.earned)),
            ("max_points", text(&|_| 100)),
            ("late_days", text(&|numbers| numbers.late_days)),
            ("manual", self::text(manual.filter(|sum| *sum != 0))),
        ];
        let tasks = RAYS.assignment.tasks.iter().enumerate();
        for (index, task) in tasks.filter(|_| has_tasks) {
            let points = entry.points.as_ref().map(|points| points[index]);
            cells.push((task.id, self::text(points)));
        }
        for person in people(index, entry) {
            let (login, email) = (&person.login, &person.email);
            self.check_row("grades.csv", login, &cells);
            let cell = |title| [(title, counts.clone())];
            self.check_row("canvas.csv", login, &cell("Path Tracer (4242)"));
            self.check_row("moodle.csv", email, &cell("Grade"));
            self.check_row("gradescope.csv", email, &cell("Total Score"));
        }
    }

    /// Checks the cells in the table row that contains the cell `key`.
    fn check_row(&self, file: &str, key: &str, cells: &[(&str, String)]) {
        let text = self.read(file);
        let mut rows = table(&text).into_iter();
        let row = rows.find(|row| row.values().any(|cell| cell == key));
        let row = row.unwrap_or_else(|| panic!("{file} lacks {key}: {text}"));
        for (title, expected) in cells {
            let cell = row.get(*title);
            assert_eq!(cell, Some(expected), "{file}: {title} of {key}");
        }
    }

    /// Checks a submission's row on the class's page.
    fn check_row_of_page(&self, index: usize, entry: &StoredEntry, rules: Rules) {
        let names = people(index, entry).into_iter().map(|who| who.name);
        let names: Vec<String> = names.collect();
        let page = self.read("class.html");
        let table = page.split("id=\"students\"").nth(1).unwrap();
        let who = format!("{} {}", names.join(" + "), id(index));
        let row = row_of_page(table, &who);
        let expected: Vec<String> = match (rules.numbers(entry), &entry.points) {
            (Some(numbers), Some(points)) => {
                let first = [numbers.counts, numbers.earned];
                first.iter().chain(points).map(u32::to_string).collect()
            }
            _ => vec!["–".to_owned(); 2],
        };
        assert_eq!(row[1..=expected.len()], expected, "{names:?}");
    }

    /// Checks the totals in the machine-readable summary and on the class's page.
    fn check_summary(&self, class: &[StoredEntry]) {
        let summary: Value = serde_json::from_str(&self.read("class.json")).unwrap();
        let page = self.read("class.html");
        let scores = class.iter().filter_map(|entry| entry.points.as_ref());
        let scores: Vec<&Vec<u32>> = scores.collect();
        assert_eq!(summary["graded"], scores.len());
        assert_eq!(summary["nothing_to_grade"], class.len() - scores.len());
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
            let mean = f64::from(points.iter().sum::<u32>()) / points.len() as f64;
            // Means have one decimal place, even in the machine-readable file.
            let mean = (10.0 * mean).round() / 10.0;
            assert_eq!(distribution["mean"], mean, "{title}");
            for (name, expected) in [
                ("of", Some(of)),
                ("least", points.iter().min().copied()),
                ("most", points.iter().max().copied()),
            ] {
                assert_eq!(distribution[name], expected.unwrap(), "{name} of {title}");
            }
            let row = row_of_page(&page, title);
            assert_eq!(
                [&row[2], &row[4]],
                [&format!("{mean:.1}"), &of.to_string()],
                "{title}"
            );
        }
    }
}

fn text(number: Option<impl ToString>) -> String {
    number.map_or(String::new(), |number| number.to_string())
}

/// Returns the text of each cell in the row of the page that begins with the cell `first`.
fn row_of_page(page: &str, first: &str) -> Vec<String> {
    let without_tags = |html: &str| -> String {
        let parts = html.split('<');
        parts
            .map(|part| part.split_once('>').map_or(part, |(_, text)| text))
            .collect()
    };
    let mut rows = page.split("<tr>").map(|row| {
        let cells = row.split("</td>").flat_map(|cell| cell.split("</th>"));
        cells.map(without_tags).collect::<Vec<String>>()
    });
    let row = rows.find(|cells| cells[0] == first);
    row.unwrap_or_else(|| panic!("class.html lacks {first}"))
}
