//! Single mistakes that explain all answers in a task.

use super::*;

#[test]
fn a_mistake_that_explains_all_answers_is_named_at_the_items_that_it_affects() {
    let correct = "1 2|3 4|5";
    let known = [("root", "7 2|3 8|"), ("other", "9 2||")];
    assert_eq!(explain(correct, &known, "7 2|3 8|5"), "root|root|");
    // One answer to the second item differs from the mistake's, so the mistake explains only half
    // of that item.
    assert_eq!(explain(correct, &known, "7 2|3 6|5"), "||");
    assert_eq!(explain(correct, &known, correct), "||");
}

#[test]
fn mistakes_that_answer_alike_are_named_together_but_not_a_long_list() {
    let known = ["a", "b", "c", "d"].map(|hint| (hint, "7 2"));
    let named = |count: usize| explain("1 2", &known[..count], "7 2");
    assert_eq!(named(1), "a");
    assert_eq!(named(MAX_MISTAKES), "a b c");
    assert_eq!(named(MAX_MISTAKES + 1), "");
    assert_eq!(explain("1 2", &[known[0], known[0]], "7 2"), "a");
}

#[test]
fn code_that_hits_nothing_is_not_taken_for_a_known_mistake() {
    let nothing = "miss miss|miss";
    assert_eq!(explain("1 miss|3", &[("all", nothing)], nothing), "|");
    // One miss in each item doesn't mean that all rays miss.
    let named = explain("1 miss|3 miss", &[("hits", "7 miss|")], "7 miss|3 miss");
    assert_eq!(named, "hits|");
    // A hit among the answers is stronger evidence.
    let named = explain("1 miss|3", &[("one", "miss miss|")], "miss miss|3");
    assert_eq!(named, "one|");
}

#[test]
fn a_mistake_that_gives_no_answers_needs_several_items() {
    let named = |wrong: &str, answers: &str| names_known("1|2|3|4", &[("known", wrong)], answers);
    assert!(named("stack|stack|stack|", "stack|stack|stack|4"));
    assert!(!named("stack|stack||", "stack|stack|3|4"));
    // Few mistakes cause a panic about an index, so one item fewer is enough.
    assert!(named("index|index||", "index|index|3|4"));
    assert!(!named("index|||", "index|2|3|4"));
    assert!(named("index|stack||", "index|stack|3|4"));
    assert!(named("9|||", "9|2|3|4"));
}
