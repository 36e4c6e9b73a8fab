//! Two mistakes that explain all answers of a task together.

use super::*;

#[test]
fn two_mistakes_are_named_where_each_explains_an_item_alone() {
    let correct = [numbers(&[1, 2]), numbers(&[3, 4]), numbers(&[5, 6])];
    let one = [Some(numbers(&[7, 2])), None, Some(numbers(&[7, 6]))];
    let other = [None, Some(numbers(&[3, 8])), Some(numbers(&[5, 8]))];
    let exam = exam(&correct, &[("one", &one), ("other", &other)]);
    let answers = [numbers(&[7, 2]), numbers(&[3, 8]), numbers(&[7, 8])];
    assert_eq!(
        explained(&exam, &answers),
        [vec!["one"], vec!["other"], vec!["one", "other"]]
    );
    // What neither changes is correct.
    let answers = [numbers(&[7, 9]), numbers(&[3, 8]), numbers(&[7, 8])];
    assert_eq!(explained(&exam, &answers), [NOTHING, NOTHING, NOTHING]);
}

#[test]
fn a_second_mistake_that_only_makes_up_for_the_first_is_not_named() {
    let correct = [numbers(&[1, 2]), numbers(&[3, 4])];
    let one = [Some(numbers(&[7, 2])), Some(numbers(&[7, 4]))];
    let other = [Some(numbers(&[8, 2])), None];
    let exam = exam(&correct, &[("one", &one), ("other", &other)]);
    // With both, anything can come out in the first item, but `other` explains no item alone.
    let answers = [numbers(&[9, 2]), numbers(&[7, 4])];
    assert_eq!(explained(&exam, &answers), [NOTHING, NOTHING]);
}

#[test]
fn each_mistake_of_a_pair_must_affect_an_item_of_its_own() {
    let correct = [1, 2, 3].map(|index| numbers(&[index]));
    let one = [7; 3].map(|wrong| Some(numbers(&[wrong])));
    let other = [Some(numbers(&[8])), None, None];
    let exam = exam(&correct, &[("one", &one), ("other", &other)]);
    let answers = [9, 7, 7].map(|answer| numbers(&[answer]));
    assert_eq!(explained(&exam, &answers), [NOTHING, NOTHING, NOTHING]);
}

#[test]
fn three_of_five_answers_must_be_those_of_a_mistake_in_a_pair() {
    // Both change some answers, which can be anything. Besides, `one` changes some, and `other` three.
    let named = |open: usize, own: usize| {
        let correct = [
            all(number(1), open),
            all(number(3), own),
            numbers(&[4, 5, 6]),
        ];
        let one = [Some(all(number(7), open)), Some(all(number(7), own)), None];
        let other = [Some(all(number(8), open)), None, Some(numbers(&[8, 8, 8]))];
        let exam = exam(&correct, &[("one", &one), ("other", &other)]);
        let answers = [
            all(number(9), open),
            all(number(7), own),
            numbers(&[8, 8, 8]),
        ];
        explained(&exam, &answers)
    };
    assert_eq!(
        named(2, 3),
        [vec!["one", "other"], vec!["one"], vec!["other"]]
    );
    assert_eq!(named(2, 2), [vec!["other"], vec![], vec!["other"]]);
    assert_eq!(named(3, 4), [NOTHING, NOTHING, NOTHING]);
}

#[test]
fn a_pair_does_not_answer_like_one_of_its_two_mistakes() {
    let correct = [numbers(&[1, 2]), numbers(&[3, 4]), numbers(&[5, 6])];
    let one = [Some(numbers(&[7, 2])), Some(numbers(&[7, 7])), None];
    let other = [Some(numbers(&[8, 2])), None, Some(numbers(&[8, 8]))];
    let exam = exam(&correct, &[("one", &one), ("other", &other)]);
    let answers = |first: i32| [numbers(&[first, 2]), numbers(&[7, 7]), numbers(&[8, 8])];
    let both = [vec!["one", "other"], vec!["one"], vec!["other"]];
    assert_eq!(explained(&exam, &answers(9)), both);
    // Both change the first number, and yet it is that of `one`: so `other` is not there.
    let of_one = explained(&exam, &answers(7));
    assert!(!of_one.concat().contains(&"other".to_owned()), "{of_one:?}");
}

/// Both change the first number, and all answers to that item are those of `one`.
#[test]
fn a_pair_answers_like_one_of_them_only_where_both_answer_alike() {
    let named = |first: i32| {
        let correct = [numbers(&[1, 2]), numbers(&[3, 4]), all(number(5), 4)];
        let one = [Some(numbers(&[7, 7])), Some(numbers(&[7, 7])), None];
        let other = [Some(numbers(&[first, 2])), None, Some(all(number(8), 4))];
        let exam = exam(&correct, &[("one", &one), ("other", &other)]);
        let answers = [numbers(&[7, 7]), numbers(&[7, 7]), all(number(8), 4)];
        explained(&exam, &answers)
    };
    assert_eq!(named(7), [vec!["one", "other"], vec!["one"], vec!["other"]]);
    assert!(!named(8).concat().contains(&"other".to_owned()));
}

#[test]
fn a_pair_that_leaves_most_answers_open_explains_nothing() {
    let correct = [1, 2].map(|index| numbers(&[index, index, index]));
    let one = [Some(numbers(&[7, 7, 7])), None];
    let other = [None, Some(numbers(&[8, 8, 8]))];
    let any = [11, 12].map(|wrong| [(); 2].map(|()| Some(all(number(wrong), 3))));
    let exam = exam(
        &correct,
        &[
            ("one", &one),
            ("other", &other),
            ("any", &any[0]),
            ("thing", &any[1]),
        ],
    );
    // The last two change everything, so with both, anything can come out.
    let answers = [numbers(&[7, 7, 7]), numbers(&[8, 8, 8])];
    assert_eq!(explained(&exam, &answers), [["one"], ["other"]]);
}

#[test]
fn an_answer_that_both_change_is_not_open_if_it_is_that_of_one() {
    let correct = [all(number(1), 8), numbers(&[2, 2]), numbers(&[3, 3])];
    let one = [Some(all(number(7), 8)), Some(numbers(&[7, 7])), None];
    let other = [Some(all(number(8), 8)), None, Some(numbers(&[8, 8]))];
    let exam = exam(&correct, &[("one", &one), ("other", &other)]);
    let half = [all(number(7), 4), all(number(8), 4)].concat();
    let answers = [half, numbers(&[7, 7]), numbers(&[8, 8])];
    assert_eq!(
        explained(&exam, &answers),
        [vec!["one", "other"], vec!["one"], vec!["other"]]
    );
}

#[test]
fn a_hit_of_one_mistake_can_hide_the_miss_of_another() {
    let correct = [numbers(&[1]), numbers(&[2]), numbers(&[3, 3, 3])];
    let one = [Some(numbers(&[7])), Some(numbers(&[7])), None];
    let missed = Some(vec![ObservedAnswer::NoHit]);
    let other = [missed, None, Some(numbers(&[8, 8, 8]))];
    let exam = exam(&correct, &[("one", &one), ("other", &other)]);
    let answers = [numbers(&[7]), numbers(&[7]), numbers(&[8, 8, 8])];
    assert_eq!(
        explained(&exam, &answers),
        [vec!["one", "other"], vec!["one"], vec!["other"]]
    );
}
