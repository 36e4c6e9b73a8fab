//! Items with right and wrong answers.

use super::*;

#[test]
fn a_score_begins_with_the_items_of_each_task_in_lecture_order() {
    // This exam has no items of the first task.
    let exam = exam(&["sphere.normal", "triangle.uv", "sphere.uv"]);
    let score = pending(&exam);
    let tasks = score.tasks.iter().map(|task| {
        let ids: Vec<&str> = task.items.iter().map(|item| item.id.as_str()).collect();
        (task.title.as_str(), task.points, task.max_points, ids)
    });
    assert_eq!(
        tasks.collect::<Vec<_>>(),
        [
            ("Task 2: triangles", 0, 4, vec!["triangle.uv"]),
            ("Task 2: spheres", 0, 8, vec!["sphere.normal", "sphere.uv"]),
        ]
    );
    assert_eq!(score.tasks[0].chapter, Some(Section::new("triangle.md")));
    assert_eq!((score.points, score.max_points), (0, 12));
    let names = (&*score.submission, &*score.exam.id);
    assert_eq!((names, score.complete), (("alice", "small"), false));
    assert!(score.items().all(|item| item.verdict == Verdict::Pending));
}

#[test]
fn a_wrong_answer_is_shown_with_its_question_and_its_number_in_the_item() {
    let judgements = vec![right(), wrong(Credit::NONE, 1, None)];
    let line = answered(vec![boxes(3), boxes(2)], judgements);
    assert_eq!((line.points, line.verdict), (0, Verdict::Wrong));
    assert_eq!(line.message, "wrong: interval");
    assert_eq!(line.look.as_deref(), Some("look here"));
    assert_eq!(line.section, Some(Section::new("boxes.md#a-heading")));
    assert_eq!((line.at, line.clue), (None, None));
    let evidence = line.evidence.unwrap();
    assert_eq!(evidence.number, 5);
    assert!(evidence.asked.contains("from (1, 0, 0)"), "{evidence:?}");
    assert_eq!((&*evidence.got, &*evidence.wanted), ("None", "[0, 1]"));
}

#[test]
fn an_item_has_the_credit_of_its_worst_question() {
    let judgements = vec![
        wrong(Credit::HALF, 0, None),
        right(),
        wrong(Credit::by_count(8, 40), 1, None),
    ];
    let line = answered(vec![boxes(1), boxes(2), boxes(2)], judgements);
    assert_eq!((line.points, line.verdict), (1, Verdict::Partial));
    assert_eq!(line.evidence.unwrap().number, 5);
}

#[test]
fn the_number_of_wrong_answers_covers_all_questions_of_the_item() {
    let wrong = |element, count| wrong(Credit::NONE, element, count);
    let two = [wrong(0, Some((2, 2))), wrong(1, Some((1, 3)))];
    for (judgements, message) in [
        (
            [right(), wrong(1, Some((1, 3)))],
            "1 of 5 answers is wrong: interval",
        ),
        (two, "3 of 5 answers are wrong; in #1: interval"),
        // A question without a count is counted as one wrong answer.
        (
            [wrong(1, Some((1, 2))), wrong(1, None)],
            "2 of 5 answers are wrong; in #2: interval",
        ),
    ] {
        let line = answered(vec![boxes(2), boxes(3)], judgements.into());
        assert_eq!(line.message, message);
    }
    let only_one = answered(vec![boxes(1)], vec![wrong(0, Some((1, 1)))]);
    assert_eq!(only_one.message, "wrong: interval");
}

#[test]
fn the_pixels_of_a_path_traced_picture_are_counted_by_themselves() {
    let picture = ExamQuestion::new(
        Question::Radiance {
            scene: String::new(),
            film: glam::UVec2::new(4, 2),
            samples: 1,
            seed: 0,
        },
        Key::Radiance {
            pixels: Vec::new(),
            max_wrong_pixels: 0,
        },
    );
    let judgements = vec![
        wrong(Credit::NONE, 6, Some((3, 8))),
        wrong(Credit::HALF, 0, Some((2, 2))),
    ];
    let line = answered(vec![picture, boxes(2)], judgements);
    assert_eq!(line.message, "3 of 8 answers are wrong; in #1: interval");
    assert_eq!(line.evidence.unwrap().number, 1);
}

#[test]
fn a_panic_in_a_picture_that_is_partly_right_is_partial() {
    let judgement = panicked(Credit::HALF, "oh", "world.rs:3:1");
    let line = answered(vec![boxes(1)], vec![judgement]);
    assert_eq!((line.points, line.verdict), (2, Verdict::Partial));
    assert_eq!((line.at, line.clue), (None, None), "in a given file");
    let wanted = line.evidence.map(|evidence| evidence.wanted);
    assert_eq!(wanted.as_deref(), Some("None"));
}

#[test]
fn an_answer_of_the_wrong_kind_is_no_evidence() {
    let kind = FailureKind::Protocol("too short".to_owned());
    let line = answered(vec![boxes(1)], vec![failed(Credit::NONE, 0, kind)]);
    assert_eq!((line.points, line.verdict), (0, Verdict::Protocol));
    let message = "the program sent an invalid answer: too short";
    assert_eq!((&*line.message, line.evidence), (message, None));
    // An item without judgements earns nothing either.
    let line = answered(Vec::new(), Vec::new());
    assert_eq!((line.points, line.verdict), (0, Verdict::Protocol));
}
