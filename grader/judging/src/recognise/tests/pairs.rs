//! Pairs of mistakes that together explain all answers in a task.

use super::*;

/// Returns the hints if the mistakes `one` and `other` are known.
fn explain_pair(correct: &str, one: &str, other: &str, answers: &str) -> String {
    explain(correct, &[("one", one), ("other", other)], answers)
}

#[test]
fn two_mistakes_are_named_where_each_explains_an_item_alone() {
    // Neither mistake is named for the last item, since each explains only some of its answers.
    let named = |answers| explain_pair("1 2|3 4|5 6", "7 2||7 6", "|3 8|5 8", answers);
    assert_eq!(named("7 2|3 8|7 8"), "one|other|");
    // An answer that neither mistake changes must be correct.
    assert_eq!(named("7 9|3 8|7 8"), "||");
}

#[test]
fn a_second_mistake_that_only_makes_up_for_the_first_is_not_named() {
    // Together, the two mistakes can produce anything in the first item, but `other` explains no
    // item on its own.
    assert_eq!(explain_pair("1 2|3 4", "7 2|7 4", "8 2|", "9 2|7 4"), "|");
}

#[test]
fn each_mistake_of_a_pair_must_affect_an_item_of_its_own() {
    assert_eq!(explain_pair("1|2|3", "7|7|7", "8||", "9|7|7"), "||");
}

#[test]
fn three_of_five_answers_must_be_those_of_a_mistake_in_a_pair() {
    // Both mistakes change the same `open` answers, which can therefore be anything. In addition,
    // `one` changes `own` further answers, and `other` changes three.
    let named = |open: usize, own: usize| {
        let correct = format!("1*{open}|3*{own}|4 5 6");
        let one = format!("7*{open}|7*{own}|");
        let other = format!("8*{open}||8*3");
        explain_pair(&correct, &one, &other, &format!("9*{open}|7*{own}|8*3"))
    };
    assert_eq!(named(2, 3), "|one|other");
    assert_eq!(named(2, 2), "||other");
    assert_eq!(named(3, 4), "||");
}

#[test]
fn a_pair_does_not_answer_like_one_of_its_two_mistakes() {
    let named = |answers| explain_pair("1 2|3 4|5 6", "7 2|7 7|", "8 2||8 8", answers);
    assert_eq!(named("9 2|7 7|8 8"), "|one|other");
    // Both mistakes change the first number, but the answer matches `one`, so `other` can't be
    // present.
    assert!(!named("7 2|7 7|8 8").contains("other"));
}

/// Both mistakes change the first number, and all answers to the first item match `one`.
#[test]
fn a_pair_answers_like_one_of_them_only_where_both_answer_alike() {
    let named = |other| explain_pair("1 2|3 4|5*4", "7 7|7 7|", other, "7 7|7 7|8*4");
    assert_eq!(named("7 2||8*4"), "one|one|other");
    assert!(!named("8 2||8*4").contains("other"));
}

#[test]
fn a_pair_that_leaves_most_answers_open_explains_nothing() {
    // The last two mistakes change everything, so together they can produce any answer.
    let known = [
        ("one", "7*3|"),
        ("other", "|8*3"),
        ("any", "11*3|11*3"),
        ("thing", "12*3|12*3"),
    ];
    assert_eq!(explain("1*3|2*3", &known, "7*3|8*3"), "one|other");
}

#[test]
fn an_answer_that_both_change_is_not_open_if_it_is_that_of_one() {
    let named = explain_pair("1*8|2*2|3*2", "7*8|7*2|", "8*8||8*2", "7*4 8*4|7*2|8*2");
    assert_eq!(named, "|one|other");
}

#[test]
fn a_hit_of_one_mistake_can_hide_the_miss_of_another() {
    let named = explain_pair("1|2|3*3", "7|7|", "miss||8*3", "7|7|8*3");
    assert_eq!(named, "one|one|other");
}
