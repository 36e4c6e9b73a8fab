//! The channels: everything in a score that a submission's program can influence.

use grader::handed_out::RAYS;
use grader::item_outcome::ItemOutcome;
use grader::probe::{Crash, Fault, TimeLimit};
use grader::score::{ItemScore, Score};
use grader::verdict::{item_score, substituted_score};
use judging::exam::Item;
use judging::judge::{Credit, Failure, FailureKind, Judgement};
use protocol::Panic;

/// A part of a score that a program can write bits into.
pub struct Channel {
    /// The human-readable name.
    pub name: &'static str,
    write: fn(&mut Score, &Item, u32),
}

impl Channel {
    /// Returns the score after the program has used an item to send these bits.
    pub fn send(&self, mut score: Score, item: &Item, bits: u32) -> Score {
        (self.write)(&mut score, item, bits);
        score.update_totals();
        score
    }
}

/// Returns all channels.
pub fn channels() -> Vec<Channel> {
    let channel = |name, write| Channel { name, write };
    vec![
        channel("exit code", |score, item, bits| {
            record_fault(score, item, Fault::Crashed(Crash::Exited(bits as i32)));
        }),
        channel("signal", |score, item, bits| {
            record_fault(score, item, Fault::Crashed(Crash::Signal(bits as i32)));
        }),
        channel("length of a frame", |score, item, bits| {
            let why = format!("a frame has {bits} bytes, but the limit is 100");
            record_fault(score, item, Fault::Protocol(why));
        }),
        channel("element that crashes", |score, item, bits| {
            let culprit = Some((0, bits as usize % item.questions[0].question.count()));
            let fault = Fault::Crashed(Crash::Signal(11));
            record(score, item, &ItemOutcome::Fault { fault, culprit });
        }),
        channel("message of a panic", |score, item, bits| {
            let message = bits.to_string();
            record_failure(score, item, panic(message, "sphere.rs:34:9"), None);
        }),
        channel("location of a panic", |score, item, bits| {
            let location = format!("sphere.rs:{bits}:{bits}");
            record_failure(score, item, panic("oh".to_owned(), &location), None);
        }),
        channel("location of a `todo!`", |score, item, bits| {
            let location = format!("sphere.rs:{bits}");
            let message = "not yet implemented".to_owned();
            record_failure(score, item, panic(message, &location), None);
        }),
        channel("number of wrong answers", |score, item, bits| {
            record_failure(
                score,
                item,
                wrong("distance", "1"),
                Some((bits as usize, 9)),
            );
        }),
        channel("wrong answer", |score, item, bits| {
            record_failure(score, item, wrong("distance", &bits.to_string()), None);
        }),
        channel("wrong quantity", |score, item, bits| {
            record_failure(score, item, wrong(&bits.to_string(), "1"), None);
        }),
        channel("answer of the wrong kind", |score, item, bits| {
            record_failure(score, item, FailureKind::Protocol(bits.to_string()), None);
        }),
        channel("answer with the reference's parts", |score, item, bits| {
            let outcome = ItemOutcome::answered(vec![failed(wrong("uv", &bits.to_string()), None)]);
            let line = item_score(item, &outcome, &RAYS);
            // The program's own answer and its answer with the reference's parts can both carry
            // bits.
            let own = ItemScore {
                message: bits.to_string(),
                ..line.clone()
            };
            score.record(substituted_score("bbox.through", &own, line));
        }),
        channel("printed text", |score, item, bits| {
            let mut tasks = score.tasks.iter_mut();
            let task = tasks.find(|task| task.id == item.task).unwrap();
            task.printed = Some(bits.to_string());
        }),
        channel("time", |score, _, bits| {
            score.timings.exam_ms = bits.into();
        }),
    ]
}

/// Fails to compile when a program can fail in a new way, i.e. when one of the enums matched below
/// gets a new variant. Add a channel for each number and each text in that variant.
#[expect(dead_code, reason = "it only has to compile")]
fn has_a_channel(fault: &Fault, failure: &FailureKind) {
    match fault {
        Fault::TimedOut(TimeLimit::Cpu | TimeLimit::Waiting | TimeLimit::Wall)
        | Fault::OutOfMemory
        | Fault::Crashed(
            Crash::StackOverflow
            | Crash::Exited(_)
            | Crash::Signal(_)
            | Crash::Killed
            | Crash::NotStarted,
        )
        | Fault::Protocol(_) => {}
    }
    match failure {
        FailureKind::Wrong {
            what: _,
            side: _,
            got: _,
            wanted: _,
        }
        | FailureKind::Uneven { got: _, wanted: _ }
        | FailureKind::Panicked(Panic {
            message: _,
            location: _,
        })
        | FailureKind::Protocol(_) => {}
    }
}

fn record(score: &mut Score, item: &Item, outcome: &ItemOutcome) {
    score.record(item_score(item, outcome, &RAYS));
}

fn record_fault(score: &mut Score, item: &Item, fault: Fault) {
    let culprit = None;
    record(score, item, &ItemOutcome::Fault { fault, culprit });
}

fn record_failure(
    score: &mut Score,
    item: &Item,
    kind: FailureKind,
    count: Option<(usize, usize)>,
) {
    record(
        score,
        item,
        &ItemOutcome::answered(vec![failed(kind, count)]),
    );
}

fn failed(kind: FailureKind, count: Option<(usize, usize)>) -> Judgement {
    Judgement {
        credit: Credit::NONE,
        failure: Some(Failure {
            element: 0,
            kind,
            count,
        }),
    }
}

fn panic(message: String, location: &str) -> FailureKind {
    let location = location.to_owned();
    FailureKind::Panicked(Panic { message, location })
}

fn wrong(what: &str, got: &str) -> FailureKind {
    FailureKind::Wrong {
        what: what.to_owned(),
        side: None,
        got: got.to_owned(),
        wanted: "2".to_owned(),
    }
}
