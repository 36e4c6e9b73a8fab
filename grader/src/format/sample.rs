//! A score with every kind of verdict, and views of it under some policies, for the tests of the
//! formats.

use std::collections::BTreeMap;

use judging::assignment::TaskInfo;
use judging::exam_file::ExamName;
use judging::section::Section;

use super::{FormatContext, MethodLocation, StudentView};
use crate::handed_out::RAYS;
use crate::policy::{Lateness, Policy};
use crate::report::text::HintDetail;
use crate::rerun_command::RerunCommand;
use crate::sandbox::Isolation;
use crate::score::{
    BuildReport, CodeLocation, Evidence, FileReport, Hint, ItemScore, SCHEMA_VERSION, Score,
    TaskScore, Timings, Verdict,
};
use crate::stage_times::StageTimes;

/// Points count double, and each late day costs a tenth.
pub const LATE: &str = "[points]\nout_of = 56\n[late]\npercent_per_day = 10";
/// Each visibility for some items, and everything for the rest.
pub const RESTRICTED: &str = "[visibility]\nfinal = 'all'\n[visibility.items]\n\
    'triangle.edge' = 'feedback'\nsphere = 'points'\nbbox = 'after_due'\nbuild = 'feedback'\n\
    'build.depth' = 'after_published'\n'build.leaves' = 'hidden'\n";

/// Returns a score of 9 of 28 points in the practice exam.
pub fn score() -> Score {
    let tasks = vec![
        task("camera", camera(), Some("camera \u{7}printed this")),
        task("triangle", triangle(), None),
        task("sphere", sphere(), Some("sphere printed this")),
        task("bbox", bbox(), None),
        task("build", build(), None),
        task("traverse", traverse(), None),
    ];
    let mut score = Score {
        schema: SCHEMA_VERSION,
        submission: "ann\u{202e}".to_owned(),
        exam: ExamName {
            id: "practice".to_owned(),
            hash: "0123".to_owned(),
        },
        isolation: Isolation::Full,
        complete: true,
        bundle: None,
        rerun_command: RerunCommand {
            submission: Some("/home/staff/ann".into()),
            exam: None,
            is_untrusted: true,
        },
        book: None,
        assignment_title: RAYS.assignment.title,
        points: 0,
        max_points: tasks.iter().map(|task| task.max_points).sum(),
        tasks,
        build: BuildReport {
            not_compiled: vec![FileReport {
                file: "bbox.rs".to_owned(),
                line: Some(7),
                message: "error: expected `;`\n --> bbox.rs:7:1\u{1b}[0m".to_owned(),
            }],
            ignored_copies: vec!["old/bvh.rs differs from bvh.rs, and is ignored".to_owned()],
            notes: Vec::new(),
        },
        timings: Timings {
            build_ms: 300,
            exam_ms: 1_200,
            stages: StageTimes::default(),
        },
    };
    score.update_totals();
    score
}

/// Returns the score of a job that was stopped before the last item.
pub fn unfinished_score() -> Score {
    let mut score = score();
    score.complete = false;
    score.record(item("traverse.any_hit", 0, 2, Verdict::Pending, ""));
    score.update_totals();
    score
}

/// Returns the score with all points.
pub fn perfect_score() -> Score {
    let mut score = score();
    for task in &mut score.tasks {
        for line in &mut task.items {
            *line = item(
                &line.id,
                line.max_points,
                line.max_points,
                Verdict::Pass,
                "",
            );
        }
    }
    score.build = BuildReport::default();
    score.update_totals();
    score
}

/// Returns this score as that of a final exam, which students do not have.
pub fn of_final_exam(mut score: Score) -> Score {
    "final".clone_into(&mut score.exam.id);
    score
}

/// Returns what students see of a score under this policy, if it was handed in this late.
pub fn view(score: &Score, policy: &str, late_days: u64) -> StudentView {
    let policy = Policy::from_text("policy.toml".as_ref(), policy).unwrap();
    let lateness = Lateness::of_seconds(late_days * 24 * 60 * 60);
    StudentView::new(score, &policy, lateness)
}

/// Returns the sample under the default policy, on time: students see everything, and the points
/// count as they were earned.
pub fn open() -> StudentView {
    view(&score(), "", 0)
}

/// Returns the sample of which students see everything, a day late: 16 of 56 points count.
pub fn late() -> StudentView {
    view(&score(), LATE, 1)
}

/// Returns the sample of a final exam of which students see some parts, a day late.
pub fn restricted() -> StudentView {
    view(&of_final_exam(score()), &format!("{LATE}\n{RESTRICTED}"), 1)
}

/// Returns facts about the submission. All methods have a line, except the one of `build`.
pub fn context() -> FormatContext {
    let tasks = RAYS.assignment.tasks.iter();
    let location = |(task, line): (&TaskInfo, u32)| {
        let line = (task.id != "build").then_some(line);
        (
            task.task(),
            MethodLocation {
                file: task.file,
                line,
            },
        )
    };
    let value = |name: &'static str| (name, format!("the {name}"));
    FormatContext {
        folder: "student/src".to_owned(),
        methods: tasks.zip(11..).map(location).collect(),
        variables: BTreeMap::from(["CLASSROOM", "COMMIT_URL", "REVIEW_URL"].map(value)),
        hints: HintDetail::Nudge,
    }
}

/// Returns an item without texts other than its message.
pub fn item(id: &str, points: u32, max_points: u32, verdict: Verdict, message: &str) -> ItemScore {
    let (_, title) = id.split_once('.').unwrap();
    ItemScore {
        points,
        verdict,
        message: message.to_owned(),
        ..ItemScore::pending(id, &title.replace('_', " "), max_points)
    }
}

fn task(id: &str, items: Vec<ItemScore>, printed: Option<&str>) -> TaskScore {
    let info = RAYS.assignment.find(id).unwrap();
    TaskScore {
        id: info.task(),
        title: info.title.to_owned(),
        chapter: None,
        points: 0,
        max_points: items.iter().map(|item| item.max_points).sum(),
        items,
        printed: printed.map(str::to_owned),
    }
}

fn camera() -> Vec<ItemScore> {
    let hint = |nudge: &str, hint: &str| Hint {
        nudge: nudge.to_owned(),
        hint: hint.to_owned(),
    };
    let message = "3 of 8 answers are wrong; in #2: length";
    let unit_length = ItemScore {
        look: Some("Compute the length by hand.".to_owned()),
        section: Some(Section::new("camera.md#unit-vectors")),
        hints: vec![
            hint("How long is it?", "It is not normalised."),
            hint("Which camera?", "The camera is another one."),
        ],
        evidence: Some(Evidence {
            number: 2,
            asked: "pixel\u{1b}[2J (1, 2)".to_owned(),
            got: "2".to_owned(),
            wanted: "1".to_owned(),
        }),
        staff: Some("answers like camera.not_normalised".to_owned()),
        ..item("camera.unit_length", 1, 2, Verdict::Partial, message)
    };
    vec![item("camera.corners", 3, 3, Verdict::Pass, ""), unit_length]
}

fn triangle() -> Vec<ItemScore> {
    let inside = ItemScore {
        look: Some("Draw the triangle.".to_owned()),
        clue: Some("The sign is the other one.".to_owned()),
        section: Some(Section::new("triangle.md")),
        evidence: Some(Evidence {
            number: 1,
            asked: "a ray".to_owned(),
            got: "-1".to_owned(),
            wanted: "1".to_owned(),
        }),
        pictures: vec!["triangle.inside.svg".to_owned()],
        ..item("triangle.inside", 0, 4, Verdict::Wrong, "wrong: distance")
    };
    let message = "panicked at triangle.rs:34:9: boom";
    let edge = ItemScore {
        at: Some(CodeLocation {
            file: "triangle.rs".to_owned(),
            line: 34,
        }),
        ..item("triangle.edge", 0, 3, Verdict::Panicked, message)
    };
    vec![inside, edge]
}

fn sphere() -> Vec<ItemScore> {
    let message = "sphere.rs:66:9 still contains `todo!`";
    let from_inside = ItemScore {
        at: Some(CodeLocation {
            file: "sphere.rs".to_owned(),
            line: 66,
        }),
        ..item("sphere.from_inside", 0, 1, Verdict::Unimplemented, message)
    };
    vec![
        item("sphere.near_side", 2, 2, Verdict::Pass, ""),
        item(
            "sphere.far_root",
            1,
            2,
            Verdict::Partial,
            "1 of 3 answers is wrong: distance",
        ),
        from_inside,
    ]
}

fn bbox() -> Vec<ItemScore> {
    let message = "bbox.rs does not compile";
    vec![item("bbox.flat", 0, 3, Verdict::NotCompiled, message)]
}

fn build() -> Vec<ItemScore> {
    let partition = ItemScore {
        look: Some("Count the primitives.".to_owned()),
        ..item("build.partition", 0, 1, Verdict::TimedOut, "took too long")
    };
    vec![
        partition,
        item("build.memory", 0, 1, Verdict::OutOfMemory, "out of memory"),
        item("build.depth", 0, 1, Verdict::Crashed, "the program crashed"),
        item("build.leaves", 0, 1, Verdict::Protocol, "an invalid answer"),
    ]
}

fn traverse() -> Vec<ItemScore> {
    let blocked = Verdict::Blocked {
        by: "bbox.flat".to_owned(),
    };
    let message = "wrong only because bbox.flat failed: correct with the reference's other files";
    let any_hit = ItemScore {
        carried_forward: true,
        ..item("traverse.any_hit", 2, 2, Verdict::Pass, message)
    };
    let message = "depends on bbox.flat: fix that first";
    vec![
        item("traverse.closest_hit", 0, 2, blocked, message),
        any_hit,
    ]
}
