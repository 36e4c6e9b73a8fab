//! Scores that depend on other items, and hints that depend on the answers to a whole task.

use super::*;

/// Returns an item's score with a value in every field.
fn full_score() -> ItemScore {
    let judgement = panicked(Credit::NONE, "attempt to add with overflow", "bbox.rs:34:9");
    let line = answered(vec![boxes(1)], vec![judgement]);
    assert!(line.at.is_some() && line.look.is_some() && line.clue.is_some());
    assert!(line.section.is_some() && line.evidence.is_some());
    line
}

#[test]
fn a_blocked_item_says_only_what_to_fix_first() {
    let line = full_score();
    let by = "triangle.inside".to_owned();
    let expected = ItemScore {
        message: format!("depends on {by}: fix that first"),
        verdict: Verdict::Blocked { by },
        ..ItemScore::pending(&line.id, &line.title, 4)
    };
    assert_eq!(
        blocked_score("triangle.inside", line.clone(), true),
        expected
    );
    let waiting = blocked_score("triangle.inside", line, false);
    assert_eq!(waiting.message, "waits for triangle.inside: fix that first");
}

#[test]
fn an_item_that_earned_points_in_spite_of_a_failed_one_is_not_blocked() {
    for points in [1, 4] {
        let line = ItemScore {
            points,
            ..full_score()
        };
        assert_eq!(blocked_score("triangle.inside", line.clone(), true), line);
    }
    let line = without_answer(&ItemOutcome::Pending);
    assert_eq!(blocked_score("triangle.inside", line.clone(), true), line);
}

fn mistake(id: &str, section: Option<&str>) -> KnownMistake {
    KnownMistake {
        id: id.to_owned(),
        nudge: format!("Is it {id}?"),
        hint: format!("It is {id}."),
        section: section.map(Section::new),
    }
}

#[test]
fn every_mistake_that_explains_the_answers_gives_a_hint_and_the_first_its_section() {
    let hinted = |mistakes: &[KnownMistake]| {
        let mut line = full_score();
        add_hints(&mut line, &mistakes.iter().collect::<Vec<_>>());
        line
    };
    let known = [
        mistake("bbox.swap", Some("boxes.md#swap")),
        mistake("bbox.flat", Some("boxes.md#flat")),
    ];
    let line = hinted(&known);
    let hint = |id: &str| Hint {
        nudge: format!("Is it {id}?"),
        hint: format!("It is {id}."),
    };
    assert_eq!(line.hints, ["bbox.swap", "bbox.flat"].map(hint));
    assert_eq!(line.section, Some(Section::new("boxes.md#swap")));
    let staff = "the answers match those of bbox.swap or bbox.flat";
    assert_eq!(line.staff.as_deref(), Some(staff));

    let line = hinted(&[mistake("bbox.swap", None)]);
    assert_eq!(line.section, full_score().section);
    assert_eq!(
        line.staff.as_deref(),
        Some("the answers match those of bbox.swap")
    );

    assert_eq!(hinted(&[]), full_score());
}

#[test]
fn a_substituted_score_counts_and_compares_itself_with_the_items_own() {
    let passed = answered(vec![boxes(1)], vec![right()]);
    let failed = answered(vec![boxes(1)], vec![wrong(Credit::NONE, 0, None)]);
    let message = |own: &ItemScore, substituted: &ItemScore| {
        let score = substituted_score("triangle.inside", own, substituted.clone());
        let message = score.message.clone();
        let expected = ItemScore {
            message: message.clone(),
            carried_forward: true,
            ..substituted.clone()
        };
        assert_eq!(score, expected);
        message
    };
    assert_eq!(message(&passed, &passed), "");
    let others = [(&failed, &passed), (&passed, &failed), (&failed, &failed)];
    let messages = others.map(|(own, substituted)| message(own, substituted));
    insta::assert_snapshot!(messages.join("\n"), @r"
    wrong only because triangle.inside failed; passes with the reference's other files
    wrong: interval; passes only because the mistake in triangle.inside cancels this one out, so it is graded with the reference's other files
    wrong: interval; graded with the reference's other files because triangle.inside failed
    ");
}
