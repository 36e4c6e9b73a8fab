//! Score files are read back as they were written, whatever their texts are.

use class::outcome::ScoreSummary;
use grader::exam_source::ExamSource;
use grader::handed_out::RAYS;
use grader::report::json;
use grader::score::{Evidence, Hint, Score, Verdict};
use grader::verdict::pending_score;
use proptest::prelude::*;

/// The contents of an item that depend on the submission.
#[derive(Clone, Debug)]
struct Written {
    points: u32,
    verdict: Verdict,
    text: String,
}

fn written() -> impl Strategy<Value = Written> {
    let verdict = prop_oneof![
        Just(Verdict::Pass),
        Just(Verdict::Partial),
        Just(Verdict::Wrong),
        Just(Verdict::Panicked),
        Just(Verdict::Crashed),
        Just(Verdict::TimedOut),
        Just(Verdict::Pending),
        any::<String>().prop_map(|by| Verdict::Blocked { by }),
    ];
    (any::<u32>(), verdict, any::<String>()).prop_map(|(points, verdict, text)| Written {
        points,
        verdict,
        text,
    })
}

/// Returns a score of the practice exam with these items, from the first on, repeated.
fn score(written: &[Written]) -> Score {
    let file = ExamSource::Practice.load(&RAYS).expect("it is built in");
    let mut score = pending_score(&file.exam, file.name(), &written[0].text, &RAYS);
    let items = score.tasks.iter_mut().flat_map(|task| &mut task.items);
    for (item, written) in items.zip(written.iter().cycle()) {
        let Written {
            points,
            verdict,
            text,
        } = written.clone();
        item.points = points % (item.max_points + 1);
        item.verdict = verdict;
        item.message = text.clone();
        item.clue = Some(text.clone());
        item.hints = vec![Hint {
            nudge: text.clone(),
            hint: text.clone(),
        }];
        item.evidence = Some(Evidence {
            number: 1,
            asked: text.clone(),
            got: text.clone(),
            wanted: text,
        });
    }
    score.update_totals();
    score
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_score_file_is_read_back_as_it_was_written(written in prop::collection::vec(written(), 1..8)) {
        let score = score(&written);
        let read = ScoreSummary::parse(&json::to_string(&score)).expect("the grader wrote it");
        prop_assert_eq!((read.points, read.max_points), (score.points, score.max_points));
        prop_assert_eq!(read.tasks.len(), score.tasks.len());
        for (read, task) in read.tasks.iter().zip(&score.tasks) {
            prop_assert_eq!(&read.id, task.id.id());
            prop_assert_eq!(&read.title, &task.title);
            prop_assert_eq!((read.points, read.max_points), (task.points, task.max_points));
            prop_assert_eq!(read.items.len(), task.items.len());
            for (read, item) in read.items.iter().zip(&task.items) {
                prop_assert_eq!((&read.id, &read.title), (&item.id, &item.title));
                prop_assert_eq!((read.points, read.max_points), (item.points, item.max_points));
                prop_assert_eq!(&read.message, &item.message);
                let read_hints = read.hints.iter().map(|hint| &hint.hint);
                prop_assert!(read_hints.eq(item.hints.iter().map(|hint| &hint.hint)));
                let verdict = serde_json::to_value(&item.verdict).expect("verdicts are JSON");
                prop_assert_eq!(&serde_json::Value::from(read.verdict.clone()), &verdict["verdict"]);
            }
        }
    }
}
