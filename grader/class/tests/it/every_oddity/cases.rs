//! Twelve submissions, each with an oddity that could lose files or points.

use grader::handed_out::RAYS;

use crate::harness::{source, zip};

/// The paths and contents of a submission's files.
pub type Files = Vec<(String, Vec<u8>)>;

/// A submission and the grade it must get.
pub struct Case {
    pub title: &'static str,
    pub files: Files,
    /// The submission time, in one of the formats that platforms write.
    pub time: &'static str,
    /// The status in `grades.csv`.
    pub status: &'static str,
    /// The final points. `None` if the teacher has to decide first.
    pub counts: Option<&'static str>,
}

const IN_TIME: &str = "2026-11-20 10:00";
/// Only part of the points, since one of the two tested tasks doesn't compile.
pub const PART: &str = "part";

/// Returns all cases. The work is due at the end of 20 November, and each late day costs 10 of 100
/// points.
pub fn cases() -> Vec<Case> {
    let solution = || task_files("reference/src");
    let starter = || task_files("grader/starter");
    let damaged = zip(solution())[..100].to_vec();
    let old = ("bvh.rs".to_owned(), b"old".to_vec());
    let early = ("camera.rs".to_owned(), b"an earlier version".to_vec());
    let broken = ("sphere.rs".to_owned(), b"fn (".to_vec());
    let graded = |title, files, counts| case(title, files, IN_TIME, "graded", Some(counts));
    let nothing = |title, files| case(title, files, IN_TIME, "nothing to grade", None);
    vec![
        graded("flat", solution(), "100"),
        case(
            "late",
            within("my/own/deep/work", solution()),
            "22.11.2026 10:00",
            "graded",
            Some("80"),
        ),
        graded(
            "project",
            [
                within("grader/starter", starter()),
                within("student/src", solution()),
                within("target/package/src", starter()),
                within("__MACOSX/student/src", starter()),
            ]
            .concat(),
            "100",
        ),
        case(
            "stray",
            [within("student/src", solution()), vec![old.clone()]].concat(),
            "Friday, 20 November 2026, 11:12 PM",
            "graded",
            Some("100"),
        ),
        graded("starter", starter(), "0"),
        case(
            "layered",
            [starter(), within("solution", solution())].concat(),
            "yesterday",
            "time unclear",
            None,
        ),
        nothing(
            "versions",
            [
                within("final", solution()),
                within("final2", replaced(solution(), old)),
            ]
            .concat(),
        ),
        case(
            "beside",
            vec![early, ("hw.zip".to_owned(), zip(solution()))],
            "11/12/2026 10:00",
            "time unclear",
            None,
        ),
        nothing("damaged", vec![("hw.zip".to_owned(), damaged)]),
        nothing("report", vec![("report.pdf".to_owned(), b"%PDF".to_vec())]),
        graded("broken", replaced(solution(), broken), PART),
        graded(
            "browser",
            solution()
                .into_iter()
                .map(|(path, text)| (path.replace("bvh.rs", "bvh (1).rs"), text))
                .collect(),
            "100",
        ),
    ]
}

fn case(
    title: &'static str,
    files: Files,
    time: &'static str,
    status: &'static str,
    counts: Option<&'static str>,
) -> Case {
    Case {
        title,
        files,
        time,
        status,
        counts,
    }
}

fn task_files(folder: &str) -> Files {
    let read = |name: &str| source(&format!("{folder}/{name}")).into_bytes();
    let names = RAYS.file_names();
    names.map(|name| (name.to_owned(), read(name))).collect()
}

/// Moves files into a folder.
fn within(folder: &str, files: Files) -> Files {
    let moved = files.into_iter();
    let moved = moved.map(|(path, text)| (format!("{folder}/{path}"), text));
    moved.collect()
}

/// Replaces the file with the same path.
fn replaced(files: Files, file: (String, Vec<u8>)) -> Files {
    let others = files.into_iter().filter(is_not(&file.0));
    let others: Files = others.collect();
    [others, vec![file]].concat()
}

fn is_not(name: &str) -> impl Fn(&(String, Vec<u8>)) -> bool {
    move |(path, _)| path != name
}
