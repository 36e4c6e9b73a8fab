//! Channels that could leak a final exam. When a submission's program is graded, it sees the
//! questions. These tests send 32 known bits through everything the program can influence and count
//! how many arrive in each output that students can read.

mod capacity;
mod programs;
mod sent;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use grader::exam_source::ExamSource;
use grader::format::{FormatContext, StudentView};
use grader::handed_out::RAYS;
use grader::policy::{Lateness, Policy};
use grader::score::{Score, Verdict};
use grader::verdict::pending_score;
use insta::assert_snapshot;
use judging::exam::{Exam, Item};
use tempfile::NamedTempFile;

use crate::formats::{FormatTexts, rendered, small_exam};
use sent::channels;

/// The bits to send.
const MESSAGE: u32 = 0x9e37_79b9;
/// The item whose result carries the bits.
const ITEM: &str = "sphere.near_side";

/// The visibility levels that hide the questions from students.
const CLOSED: [&str; 5] = [
    "feedback",
    "points",
    "after_due",
    "after_published",
    "hidden",
];

/// The number of bits that arrived, keyed by output.
type Arrived = BTreeMap<&'static str, u32>;

/// Returns a policy that shows every item of every exam at this level.
fn policy(level: &str) -> Policy {
    let text = format!("[visibility]\npractice = '{level}'\nfinal = '{level}'");
    Policy::from_text(Path::new("policy.toml"), &text).unwrap()
}

/// Returns the score of a final exam where every item passed.
fn all_passed() -> (Exam, Score) {
    let file = NamedTempFile::new().unwrap();
    std::fs::write(file.path(), small_exam("final")).unwrap();
    let file = ExamSource::File(file.path().to_owned())
        .load(&RAYS)
        .unwrap();
    let mut score = pending_score(&file.exam, file.name(), "sender", &RAYS);
    score.complete = true;
    for item in score.tasks.iter_mut().flat_map(|task| &mut task.items) {
        (item.points, item.verdict) = (item.max_points, Verdict::Pass);
    }
    score.update_totals();
    (file.exam, score)
}

fn item<'a>(exam: &'a Exam, id: &str) -> &'a Item {
    exam.items.iter().find(|item| item.id == id).unwrap()
}

/// Returns everything students can read about a score.
fn readable(score: &Score, policy: &Policy) -> FormatTexts {
    let view = StudentView::new(score, policy, Lateness::NONE);
    rendered(&view, &FormatContext::default())
}

/// Sends bits and counts those that change an output when flipped.
fn count_arrived(send: impl Fn(u32) -> Score, policy: &Policy) -> Arrived {
    let sent = readable(&send(MESSAGE), policy);
    let mut arrived: Arrived = sent.keys().map(|output| (*output, 0)).collect();
    for bit in 0..u32::BITS {
        for (output, text) in readable(&send(MESSAGE ^ (1 << bit)), policy) {
            let differs = sent[output] != text;
            *arrived.get_mut(output).unwrap() += u32::from(differs);
        }
    }
    arrived
}

/// Panics if an output depends on the bits sent through any channel.
fn assert_nothing_arrives(policy: &Policy) {
    let (exam, passed) = all_passed();
    let item = item(&exam, ITEM);
    for channel in channels() {
        let send = |bits| channel.send(passed.clone(), item, bits);
        for (output, bits) in count_arrived(send, policy) {
            let name = channel.name;
            assert_eq!(bits, 0, "{name} arrives in {output}: {policy:?}");
        }
    }
}

#[test]
fn no_bit_of_a_final_exam_reaches_students_through_text_that_a_program_chooses() {
    for level in CLOSED {
        assert_nothing_arrives(&policy(level));
    }
}

#[test]
fn an_item_that_is_open_says_nothing_about_others_of_its_task() {
    let text = "[visibility]\nfinal = 'all'\n[visibility.items]\n'sphere.far_root' = 'feedback'";
    let policy = Policy::from_text(Path::new("policy.toml"), text).unwrap();
    assert_nothing_arrives(&policy);
}

/// Shows that the counting works: if students may see the entire exam, bits arrive through every
/// channel.
#[test]
fn bits_arrive_where_students_see_everything() {
    let (exam, passed) = all_passed();
    let item = item(&exam, ITEM);
    let mut rows = Vec::new();
    for channel in channels() {
        let send = |bits| channel.send(passed.clone(), item, bits);
        let arrived = count_arrived(send, &policy("all"));
        let most = arrived.values().max().unwrap();
        assert!(*most > 0, "{} is not a channel", channel.name);
        rows.push((channel.name, arrived));
    }
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    // Outputs that carry the same bits share a table.
    let mut tables: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for output in rows[0].1.keys() {
        let mut table = String::new();
        for (name, arrived) in &rows {
            writeln!(table, "{:>2} {name}", arrived[output]).unwrap();
        }
        tables.entry(table).or_default().push(output);
    }
    let tables = tables.iter();
    let tables = tables.map(|(table, outputs)| format!("{}:\n{table}", outputs.join(", ")));
    let tables: Vec<String> = tables.collect();
    settings.bind(|| assert_snapshot!("arrived", tables.join("\n")));
}
