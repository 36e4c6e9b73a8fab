//! The numbers that people see: all files of a class must say the same about everybody's points. The
//! expected numbers are computed here from the scores, and not with the grader's policy.

mod walk;

use std::fs;
use std::path::{Path, PathBuf};

use grader::handed_out::RAYS;
use proptest::prelude::*;
use tempfile::TempDir;

use self::walk::disagreements;
use crate::harness::{class_command, successful_stdout};
use crate::stored_class::{StoredEntry, people, stored_class, write_shard};

/// The rules of a course.
#[derive(Clone, Copy, Debug)]
struct Rules {
    out_of: u32,
    percent_per_day: u32,
}

/// The numbers that one person's grade consists of.
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
        // Rounded to the nearest number, and up in the middle.
        let counts = (2 * self.out_of * sum * percent + 10_000) / 20_000;
        Some(Numbers {
            counts,
            earned,
            manual,
            late_days,
        })
    }
}

/// Writes the files of a graded class, with gradebooks, and returns their folder.
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
        let out = write_class(root.path(), &class, rules);
        prop_assert_eq!(disagreements(&out, &class, rules), Vec::<String>::new());
    }
}

#[test]
fn a_changed_number_in_any_file_is_a_disagreement() {
    let entry = StoredEntry {
        points: Some(vec![14, 13, 12, 9, 19, 18]),
        people: 1,
        hours_late: 30,
        manual: -1,
        is_resubmitted: false,
    };
    let rules = Rules {
        out_of: 50,
        percent_per_day: 10,
    };
    let (root, class) = (TempDir::new().unwrap(), [entry]);
    let out = write_class(root.path(), &class, rules);
    assert_eq!(disagreements(&out, &class, rules), Vec::<String>::new());
    // 85 points, of which one is taken off and a fifth deducted, are 33.6 of 50.
    for (file, from, to) in [
        ("grades.csv", "graded,34,85", "graded,33,85"),
        ("grades.csv", ",-1,2,", ",-1,1,"),
        ("grades.csv", ",19,18,", ",19,17,"),
        ("canvas.csv", ",34", ",35"),
        ("moodle.csv", ",34,", ",34.5,"),
        ("gradescope.csv", ",34,", ",,"),
        ("class.json", "\"mean\": 85.0", "\"mean\": 84.0"),
        ("class.json", "\"graded\": 1", "\"graded\": 2"),
        ("class.html", "<strong>34</strong>", "<strong>43</strong>"),
        ("class.html", ">85.0<", ">85.1<"),
        (
            "students/s00/report.html",
            "34 of 50 points",
            "35 of 50 points",
        ),
        ("students/s00/feedback.html", "2 days late", "3 days late"),
        ("students/s00/score.json", "\"points\":85", "\"points\":86"),
    ] {
        let path = out.join(file);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(from), "{file} lacks {from:?}: {text}");
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let found = disagreements(&out, &class, rules);
        assert!(
            found.len() == 1 && found[0].starts_with(file),
            "{file}: {found:?}"
        );
        fs::write(&path, text).unwrap();
    }
}
