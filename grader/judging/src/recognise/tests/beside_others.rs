//! Mistakes that explain every item they affect, alongside unknown mistakes.

use super::*;

#[test]
fn a_mistake_is_named_beside_an_unknown_one_if_it_explains_most_wrong_items() {
    let known = ("known", "7|7||");
    let named =
        |others: &[Mistake], answers| names_known("1|2|3|4", &[&[known], others].concat(), answers);
    assert!(named(&[], "7|7|9|4"));
    assert!(!named(&[], "7|7|9|9"), "half of the wrong items");
    assert!(!named(&[], "7|9|3|4"), "one of two items that it affects");
    assert!(named(&[("refuted", "7|7||8")], "7|7|9|4"));
}

/// A second mistake that explains the same items and every other item that it affects may be the
/// real cause.
#[test]
fn a_mistake_with_a_rival_is_not_named_beside_an_unknown_one() {
    let mistakes = [("known", "7|7|7||"), ("rival", "7|7|7|7|")];
    let named = |count: usize| explain("1|2|3|4|5", &mistakes[..count], "7|7|7|7|9");
    assert!(named(1).starts_with("known|"));
    assert!(named(2).starts_with("rival|"));
}

#[test]
fn the_same_defect_in_items_that_a_mistake_leaves_correct_has_another_cause() {
    let named = |known: &str, third: &str| {
        let (wrong, answers) = (format!("{known}||"), format!("{known}|{third}|'valid'"));
        names_known(
            "'valid'|'valid'|'valid'|'valid'",
            &[("known", &wrong)],
            &answers,
        )
    };
    assert!(named("'boxes'|'boxes'", "'leaves'"));
    assert!(!named("'boxes'|'boxes'", "'boxes'"));
    assert!(named("'boxes'|'leaves'", "'splits'"));
    assert!(!named("'boxes'|'leaves'", "'boxes'"));
    assert!(!named("'boxes'|'leaves'", "'leaves'"));
}

#[test]
fn a_mistake_that_explains_nearly_all_answers_is_not_named() {
    let named = |last: &str| {
        let answers = format!("7*3|7*3|7*3|{last}");
        names_known("1*3|2*3|3*3|4*3", &[("known", "7*3|7*3|7*3|7*3")], &answers)
    };
    assert!(named("7 7 7"));
    assert!(!named("7 7 9"), "one answer differs");
}

#[test]
fn a_mistake_that_misses_is_named_if_most_wrong_items_are_its_own() {
    let known = ("known", "1 miss|1 miss|1 miss|1 miss|||");
    let correct = "1*2|1*2|1*2|1*2|1*2|1*2|1*2";
    let named = |other: &str| {
        let answers = format!("1 miss|1 miss|1 miss|1 miss|{other}|{other}|{other}");
        explain(correct, &[known], &answers).starts_with("known|")
    };
    assert!(named("9*2"), "four of seven wrong items");
    assert!(
        named("stack*2"),
        "it has no such answers, so they are another mistake's"
    );
}

/// A miss together with another wrong answer is stronger evidence than misses alone.
#[test]
fn a_mistake_that_also_misses_is_named_beside_an_unknown_one() {
    let known = ("known", "miss 7|miss 7|");
    assert!(explain("1*2|1*2|1*2", &[known], "miss 7|miss 7|9 9").starts_with("known|"));
}

#[test]
fn several_items_without_an_answer_have_another_cause_than_one_that_is_known_to_give_none() {
    let known = ("known", "1 miss|1 miss|1 panic||");
    let named = |last: &str| {
        let answers = format!("1 miss|1 miss|1 panic|{last}");
        names_known("1*2|1*2|1*2|1*2|1*2", &[known], &answers)
    };
    assert!(named("1 9|1 9"));
    assert!(named("1 panic|1 9"));
    assert!(!named("1 panic|1 panic"));
}

#[test]
fn a_single_item_without_an_answer_may_be_due_to_other_code() {
    let known = ("known", "7 panic|7 panic||");
    let answers = "7 panic|7 panic|panic*2|1*2";
    assert!(explain("1*2|1*2|1*2|1*2", &[known], answers).starts_with("known|"));
}
