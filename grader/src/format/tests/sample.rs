//! A score that contains every kind of verdict, and views of it under several policies, for the
//! tests of the formats.

use std::collections::BTreeMap;

use judging::assignment::TaskInfo;
use judging::section::Section;

use crate::format::{FormatContext, MethodLocation, StudentView};
use crate::handed_out::RAYS;
use crate::policy::{Lateness, Policy};
use crate::report::text::HintDetail;
use crate::sandbox::Isolation;
use crate::score::tests::small_exam::{exam, pending};
use crate::score::tests::verdicts;
use crate::score::{
    BuildReport, CodeLocation, Evidence, FileReport, Hint, ItemScore, Score, Verdict,
};

/// A policy that doubles the points and deducts a tenth of them for each late day.
pub const LATE: &str = "[points]\nout_of = 56\n[late]\npercent_per_day = 10";
/// A policy that uses every level of visibility for at least one item, and full visibility for all
/// items that it doesn't list.
pub const RESTRICTED: &str = "[visibility]\nfinal = 'all'\n[visibility.items]\n\
    'triangle.edge' = 'feedback'\nsphere = 'points'\nbbox = 'after_due'\nbuild = 'feedback'\n\
    'build.depth' = 'after_published'\n'build.leaves' = 'hidden'\n";

/// The items, one per line: the id, the points earned, the maximum points, the label of the
/// verdict, and the message.
const ITEMS: &str = "\
camera.corners|3|3|passed|
camera.unit_length|1|2|partial|3 of 8 answers are wrong; in #2: length
triangle.inside|0|4|wrong|wrong: distance
triangle.edge|0|3|panicked|panicked at triangle.rs:34:9: boom
sphere.near_side|2|2|passed|
sphere.far_root|1|2|partial|1 of 3 answers is wrong: distance
sphere.from_inside|0|1|not written yet|sphere.rs:66:9 still contains `todo!`
bbox.flat|0|3|not compiled|bbox.rs does not compile
build.partition|0|1|out of time|took too long
build.memory|0|1|out of memory|out of memory
build.depth|0|1|crashed|the program crashed
build.leaves|0|1|no answer|an invalid answer
traverse.closest_hit|0|2|blocked|depends on bbox.flat: fix that first
traverse.any_hit|2|2|passed|wrong only because bbox.flat failed; passes with the reference's other files";

/// Returns the item described by a line of [`ITEMS`].
fn read_item(line: &str) -> ItemScore {
    let fields: Vec<&str> = line.split('|').collect();
    let [id, points, max_points, label, message] = fields[..] else {
        panic!("{line}");
    };
    let verdict = verdicts().into_iter().find(|known| known.label() == label);
    let [points, max_points] = [points, max_points].map(|points| points.parse().unwrap());
    item(id, points, max_points, verdict.unwrap(), message)
}

/// Returns a score of 9 out of 28 points in the practice exam.
pub fn score() -> Score {
    let items: Vec<ItemScore> = ITEMS.lines().map(read_item).collect();
    let ids: Vec<&str> = items.iter().map(|item| item.id.as_str()).collect();
    let mut score = pending(&exam(&ids));
    items.iter().cloned().for_each(|item| score.record(item));
    for task in &mut score.tasks {
        task.max_points = task.items.iter().map(|item| item.max_points).sum();
        task.items.iter_mut().for_each(add_details);
        task.printed = match task.id.id() {
            "camera" => Some("camera \u{7}printed this".to_owned()),
            "sphere" => Some("sphere printed this".to_owned()),
            _ => None,
        };
    }
    "ann\u{202e}".clone_into(&mut score.submission);
    "practice".clone_into(&mut score.exam.id);
    score.isolation = Isolation::Full;
    score.complete = true;
    score.rerun_command.submission = Some("/home/staff/ann".into());
    score.rerun_command.is_untrusted = true;
    score.max_points = 28;
    score.build = BuildReport {
        not_compiled: vec![FileReport {
            file: "bbox.rs".to_owned(),
            line: Some(7),
            message: "error: expected `;`\n --> bbox.rs:7:1\u{1b}[0m".to_owned(),
            is_missing: false,
        }],
        ignored_copies: vec!["old/bvh.rs differs from bvh.rs and is ignored".to_owned()],
        notes: Vec::new(),
    };
    (score.timings.build_ms, score.timings.exam_ms) = (300, 1_200);
    score.update_totals();
    score
}

/// Adds text to some items, so that every field has a value in at least one item.
fn add_details(item: &mut ItemScore) {
    let text = |text: &str| Some(text.to_owned());
    let location = |file: &str, line| {
        let file = file.to_owned();
        Some(CodeLocation { file, line })
    };
    let evidence = |number, texts: [&str; 3]| {
        let [asked, got, wanted] = texts.map(str::to_owned);
        Some(Evidence {
            number,
            asked,
            got,
            wanted,
            can_be_shown: !item.id.starts_with("camera."),
        })
    };
    let hint = |nudge: &str, hint: &str| Hint {
        nudge: nudge.to_owned(),
        hint: hint.to_owned(),
    };
    match item.id.as_str() {
        "camera.unit_length" => {
            item.look = text("Compute the length by hand.");
            item.section = Some(Section::new("camera.md#unit-vectors"));
            item.hints = vec![
                hint("How long is it?", "It is not normalised."),
                hint("Which camera?", "The camera is another one."),
            ];
            item.evidence = evidence(2, ["pixel\u{1b}[2J (1, 2)", "2", "1"]);
            item.staff = text("the answers match those of camera.not_normalised");
        }
        "triangle.inside" => {
            item.look = text("Draw the triangle.");
            item.clue = text("The sign is the other one.");
            item.section = Some(Section::new("triangle.md"));
            item.evidence = evidence(1, ["a ray", "-1", "1"]);
            item.pictures = vec!["triangle.inside.svg".to_owned()];
        }
        "triangle.edge" => item.at = location("triangle.rs", 34),
        "sphere.from_inside" => item.at = location("sphere.rs", 66),
        "build.partition" => item.look = text("Count the primitives."),
        "traverse.any_hit" => item.carried_forward = true,
        _ => {}
    }
}

/// Returns the score of a job that was stopped before the last item.
pub fn unfinished_score() -> Score {
    let mut score = score();
    score.complete = false;
    score.record(item("traverse.any_hit", 0, 2, Verdict::Pending, ""));
    score.update_totals();
    score
}

/// Returns a score with full points for every item.
pub fn perfect_score() -> Score {
    let mut score = score();
    for line in score.tasks.iter_mut().flat_map(|task| &mut task.items) {
        let points = line.max_points;
        *line = item(&line.id, points, points, Verdict::Pass, "");
    }
    score.build = BuildReport::default();
    score.update_totals();
    score
}

/// Returns this score as if it were for a final exam, which students don't have access to.
pub fn of_final_exam(mut score: Score) -> Score {
    "final".clone_into(&mut score.exam.id);
    score
}

/// Returns the students' view of a score under this policy, for a submission that is this many days
/// late.
pub fn view(score: &Score, policy: &str, late_days: u64) -> StudentView {
    let policy = Policy::from_text("policy.toml".as_ref(), policy).unwrap();
    let lateness = Lateness::of_seconds(late_days * 24 * 60 * 60);
    StudentView::new(score, &policy, lateness)
}

/// Returns the sample under the default policy, submitted on time. Students see everything, and the
/// points are used unchanged.
pub fn open() -> StudentView {
    view(&score(), "", 0)
}

/// Returns the sample with full visibility, submitted a day late. The final points are 16 of 56.
pub fn late() -> StudentView {
    view(&score(), LATE, 1)
}

/// Returns the sample as if it were for a final exam with partial visibility, submitted a day late.
pub fn restricted() -> StudentView {
    view(&of_final_exam(score()), &format!("{LATE}\n{RESTRICTED}"), 1)
}

/// Returns facts about the submission. The line number is known for every method except `build`.
pub fn context() -> FormatContext {
    let tasks = RAYS.assignment.tasks.iter();
    let location = |(task, line): (&TaskInfo, u32)| {
        let (file, line) = (task.file, (task.id != "build").then_some(line));
        (task.task(), MethodLocation { file, line })
    };
    let value = |name: &'static str| (name, format!("the {name}"));
    FormatContext {
        folder: "student/src".to_owned(),
        methods: tasks.zip(11..).map(location).collect(),
        variables: BTreeMap::from(["CLASSROOM", "COMMIT_URL", "REVIEW_URL"].map(value)),
        hints: HintDetail::Nudge,
    }
}

/// Returns an item with no text besides its message.
pub fn item(id: &str, points: u32, max_points: u32, verdict: Verdict, message: &str) -> ItemScore {
    let (_, title) = id.split_once('.').unwrap();
    ItemScore {
        points,
        verdict,
        message: message.to_owned(),
        ..ItemScore::pending(id, &title.replace('_', " "), max_points)
    }
}
