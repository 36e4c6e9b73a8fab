//! Mistakes that explain all answers of a task.

use super::*;

#[test]
fn a_mistake_that_explains_all_answers_is_named_at_the_items_that_it_affects() {
    let correct = [numbers(&[1, 2]), numbers(&[3, 4]), numbers(&[5])];
    let far_root = [Some(numbers(&[7, 2])), Some(numbers(&[3, 8])), None];
    let other = [Some(numbers(&[9, 2])), None, None];
    let exam = exam(&correct, &[("far root", &far_root), ("other", &other)]);

    let answers = [numbers(&[7, 2]), numbers(&[3, 8]), numbers(&[5])];
    assert_eq!(
        explained(&exam, &answers),
        [vec!["far root"], vec!["far root"], vec![]]
    );
    // One answer differs from it, in an item that it alone explains half of.
    let answers = [numbers(&[7, 2]), numbers(&[3, 6]), numbers(&[5])];
    assert_eq!(explained(&exam, &answers), [NOTHING, NOTHING, NOTHING]);
    assert_eq!(explained(&exam, &correct), [NOTHING, NOTHING, NOTHING]);
}

#[test]
fn mistakes_that_answer_alike_are_named_together_but_not_a_long_list() {
    let correct = [numbers(&[1, 2])];
    let wrong = [Some(numbers(&[7, 2]))];
    let known: Vec<Mistake> = ["a", "b", "c", "d"].map(|hint| (hint, &wrong[..])).to_vec();
    let answers = [numbers(&[7, 2])];
    let named = |count: usize| explained(&exam(&correct, &known[..count]), &answers);
    assert_eq!(named(1), [["a"]]);
    assert_eq!(named(MAX_MISTAKES), [["a", "b", "c"]]);
    assert_eq!(named(MAX_MISTAKES + 1), [NOTHING]);
    let sharing = [("a", &wrong[..]), ("a", &wrong[..])];
    assert_eq!(explained(&exam(&correct, &sharing), &answers), [["a"]]);
}

#[test]
fn code_that_hits_nothing_is_not_taken_for_a_known_mistake() {
    let miss = || ObservedAnswer::NoHit;
    let correct = [vec![number(1), miss()], numbers(&[3])];
    let nothing = [Some(all(miss(), 2)), Some(all(miss(), 1))];
    let one_item = [Some(all(miss(), 2)), None];
    let answers = [all(miss(), 2), all(miss(), 1)];
    let exam_of = |mistake: Mistake| exam(&correct, &[mistake]);
    assert_eq!(
        explained(&exam_of(("all", &nothing)), &answers),
        [NOTHING, NOTHING]
    );
    // A ray that misses in each item is not all of them.
    let correct = [vec![number(1), miss()], vec![number(3), miss()]];
    let wrong = [Some(vec![number(7), miss()]), None];
    let answers = [vec![number(7), miss()], correct[1].clone()];
    assert_eq!(
        explained(&exam(&correct, &[("hits", &wrong)]), &answers),
        [vec!["hits"], vec![]]
    );
    // If something is hit, it tells more.
    let answers = [all(miss(), 2), numbers(&[3])];
    assert_eq!(
        explained(&exam_of(("one", &one_item)), &answers),
        [vec!["one"], vec![]]
    );
}

#[test]
fn a_mistake_that_gives_no_answers_needs_several_items() {
    let panic = |kind| Some(vec![ObservedAnswer::PanickedBy(kind)]);
    let stack = || Some(vec![ObservedAnswer::NoAnswer(NoAnswerReason::Stack)]);
    let named = |wrong: [Option<Vec<ObservedAnswer>>; 4]| {
        let correct = [1, 2, 3, 4].map(|index| numbers(&[index]));
        let answers = wrong.iter().zip(&correct);
        let answers = answers.map(|(wrong, correct)| wrong.as_ref().unwrap_or(correct).clone());
        let exam = exam(&correct, &[("crash", &wrong)]);
        explained(&exam, &answers.collect::<Vec<_>>())
            .iter()
            .any(|named| !named.is_empty())
    };
    assert!(named([stack(), stack(), stack(), None]));
    assert!(!named([stack(), stack(), None, None]));
    // Few mistakes panic with an index, so one item less suffices.
    let index = || panic(PanicKind::Index);
    assert!(named([index(), index(), None, None]));
    assert!(!named([index(), None, None, None]));
    assert!(named([index(), stack(), None, None]));
    assert!(named([Some(numbers(&[9])), None, None, None]));
}
