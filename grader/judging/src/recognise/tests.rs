//! Tests of recognition with small exams, in which each element of an item has one number.

use super::*;
use crate::assignment::RAYS;
use crate::exam::Exam;
use crate::signatures::{MistakeAnswers, MistakeSignatures, PanicKind};

/// A number that is far from others.
fn number(number: i32) -> ObservedAnswer {
    ObservedAnswer::Numbers(vec![number as f32 * 100.0])
}

/// The answers of a mistake to the items of an exam, which it leaves correct where there is `None`.
type Mistake<'a> = (&'a str, &'a [Option<Vec<ObservedAnswer>>]);

/// Creates an exam of one task, given the correct answers to each item, and known mistakes, each with
/// its hint. Mistakes with the same hint have the same name here.
fn exam(correct: &[Vec<ObservedAnswer>], mistakes: &[Mistake]) -> Exam {
    let task = RAYS.tasks[0].task();
    let item = |(index, correct): (usize, &Vec<ObservedAnswer>)| {
        let changed = mistakes.iter().enumerate();
        let changed = changed.filter_map(|(mistake, (_, answers))| {
            let answers = answers[index].as_ref()?;
            let elements = (0..).zip(answers).zip(correct);
            let wrong = elements.filter(|((_, answer), correct)| answer != correct);
            Some(MistakeAnswers {
                mistakes: vec![mistake as u32],
                answers: wrong
                    .map(|((element, answer), _)| (element, answer.clone()))
                    .collect(),
            })
        });
        Item {
            id: format!("{task}.{index}"),
            title: String::new(),
            task,
            points: 1,
            look: String::new(),
            section: None,
            needs: Vec::new(),
            questions: Vec::new(),
            signatures: MistakeSignatures {
                elements: (0..correct.len() as u32).collect(),
                correct_answers: correct.clone(),
                mistake_answers: changed.collect(),
            },
        }
    };
    let known = mistakes.iter().map(|(hint, _)| KnownMistake {
        id: (*hint).to_owned(),
        nudge: String::new(),
        hint: (*hint).to_owned(),
        section: None,
    });
    Exam {
        schema: 1,
        assignment: RAYS.id.to_owned(),
        id: "small".to_owned(),
        mistakes: known.collect(),
        items: correct.iter().enumerate().map(item).collect(),
    }
}

/// Returns the ids of the mistakes that explain each item, given a submission's answers.
fn explained(exam: &Exam, answers: &[Vec<ObservedAnswer>]) -> Vec<Vec<String>> {
    let ids = exam.items.iter().map(|item| item.id.clone());
    let observations = Observations(ids.zip(answers.iter().cloned()).collect());
    let of_item = |item| {
        let mistakes = observations.explain(exam, item).into_iter();
        mistakes.map(|mistake| mistake.id.clone()).collect()
    };
    exam.items.iter().map(of_item).collect()
}

/// Returns an item's answers with these numbers.
fn numbers(all: &[i32]) -> Vec<ObservedAnswer> {
    all.iter().copied().map(number).collect()
}

/// Returns an item's answers that are all this one.
fn all(answer: ObservedAnswer, count: usize) -> Vec<ObservedAnswer> {
    vec![answer; count]
}

const NOTHING: [&str; 0] = [];

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
    assert!(named([Some(numbers(&[9])), None, None, None]));
}

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

#[test]
fn a_mistake_is_named_beside_an_unknown_one_if_it_explains_most_wrong_items() {
    let correct = [1, 2, 3, 4].map(|index| numbers(&[index]));
    let known = [Some(numbers(&[7])), Some(numbers(&[7])), None, None];
    let exam_of = |others: &[Mistake]| {
        let mistakes = [&[("known", &known[..])], others].concat();
        exam(&correct, &mistakes)
    };
    let named = |exam: &Exam, answers: [i32; 4]| {
        let answers = answers.map(|answer| numbers(&[answer]));
        explained(exam, &answers)
            .concat()
            .contains(&"known".to_owned())
    };
    let alone = exam_of(&[]);
    assert!(named(&alone, [7, 7, 9, 4]));
    assert!(!named(&alone, [7, 7, 9, 9]), "half of the wrong items");
    assert!(
        !named(&alone, [7, 9, 3, 4]),
        "one of two items that it affects"
    );
    // Another mistake that explains the same items, and all that it affects, may be the one.
    let rival = [
        Some(numbers(&[7])),
        Some(numbers(&[7])),
        Some(numbers(&[9])),
        None,
    ];
    assert!(!named(&exam_of(&[("rival", &rival)]), [7, 7, 9, 5]));
    let refuted = [
        Some(numbers(&[7])),
        Some(numbers(&[7])),
        None,
        Some(numbers(&[8])),
    ];
    assert!(named(&exam_of(&[("refuted", &refuted)]), [7, 7, 9, 4]));
}

#[test]
fn the_same_defect_in_items_that_a_mistake_leaves_correct_has_another_cause() {
    let tree = |defect: &str| vec![ObservedAnswer::Tree(Some((defect.to_owned(), 0.0)))];
    let correct = [(); 4].map(|()| vec![ObservedAnswer::Tree(None)]);
    let known = [Some(tree("boxes")), Some(tree("boxes")), None, None];
    let exam = exam(&correct, &[("known", &known)]);
    let named = |third: &str| {
        let answers = [
            tree("boxes"),
            tree("boxes"),
            tree(third),
            correct[3].clone(),
        ];
        !explained(&exam, &answers).concat().is_empty()
    };
    assert!(named("leaves"));
    assert!(!named("boxes"));
}

#[test]
fn a_mistake_that_explains_nearly_all_answers_is_named() {
    let correct = [1, 2, 3, 4].map(|index| numbers(&[index, index, index]));
    let known = [7; 4].map(|wrong| Some(numbers(&[wrong, wrong, wrong])));
    let exam = exam(&correct, &[("known", &known)]);
    let named = |last: [i32; 3]| {
        let answers = [[7; 3], [7; 3], [7; 3], last].map(|answers| numbers(&answers));
        !explained(&exam, &answers).concat().is_empty()
    };
    assert!(named([7, 7, 9]), "one answer of another mistake");
    assert!(named([7, 9, 9]), "ten answers agree, two differ");
    assert!(!named([9, 9, 9]), "nine answers agree, three differ");
}

/// Returns whether `known` is named if it changes every answer, items have these sizes, and the last
/// answers to some of them are not its own. Rivals change all answers to the given number of items, as
/// it does. Besides, this many other items are wrong.
fn is_named(items: &[(usize, usize)], rivals: &[usize], others: usize) -> bool {
    let sizes = || items.iter().map(|&(size, _)| size);
    let right = sizes().map(|size| all(number(1), size));
    let correct: Vec<_> = right.chain(vec![all(number(1), 1); others]).collect();
    let changing = |count: usize| -> Vec<_> {
        let changed = sizes().take(count).map(|size| Some(all(number(7), size)));
        let unchanged = correct.len() - items.len().min(count);
        changed.chain(vec![None; unchanged]).collect()
    };
    let known = changing(items.len());
    let rivals: Vec<_> = rivals.iter().map(|&count| changing(count)).collect();
    let rivals = rivals.iter().map(|rival| ("rival", rival.as_slice()));
    let mistakes: Vec<Mistake> = [("known", known.as_slice())]
        .into_iter()
        .chain(rivals)
        .collect();
    let answers = items.iter().map(|&(size, differing)| {
        [all(number(7), size - differing), all(number(9), differing)].concat()
    });
    let answers: Vec<_> = answers.chain(vec![all(number(9), 1); others]).collect();
    let named = explained(&exam(&correct, &mistakes), &answers).concat();
    named.contains(&"known".to_owned())
}

#[test]
fn a_dominant_mistake_explains_three_quarters_of_its_items_and_most_wrong_ones() {
    let items = [(3, 0), (3, 0), (3, 0), (3, 1)];
    assert!(is_named(&items, &[], 1), "three of five wrong items");
    assert!(!is_named(&items, &[], 2), "three of six");
    let items = [(4, 0), (4, 0), (4, 0), (2, 1), (2, 1)];
    assert!(!is_named(&items, &[], 0), "three of five that it affects");
}

#[test]
fn a_dominant_mistake_explains_most_answers() {
    // In nine items of ten, it must be two of three answers, and otherwise more than four of five.
    let ten = |differing: usize| [[(1, 0); 9].as_slice(), &[(differing, differing)]].concat();
    assert!(is_named(&ten(3), &[], 0), "nine agree, three differ");
    assert!(!is_named(&ten(5), &[], 0), "nine agree, five differ");
    let four = [(4, 0), (4, 0), (4, 0), (3, 3)];
    assert!(!is_named(&four, &[], 0), "twelve agree, three differ");
}

#[test]
fn correct_answers_are_no_evidence_for_a_dominant_mistake() {
    let correct = [(); 4].map(|()| numbers(&[1, 2, 3, 4]));
    let known = [(); 4].map(|()| Some(numbers(&[7, 2, 3, 4])));
    let exam = exam(&correct, &[("known", &known)]);
    let answers = [7, 7, 7, 9].map(|first| numbers(&[first, 2, 3, 4]));
    assert_eq!(explained(&exam, &answers), [NOTHING; 4]);
}

#[test]
fn a_rival_explains_more_than_half_of_the_items_and_of_the_answers() {
    let items = [(3, 0), (3, 0), (3, 0), (3, 1)];
    assert!(
        !is_named(&items, &[2], 0),
        "two of three items, and six of eleven answers"
    );
    let items = [(2, 0), (3, 0), (3, 0), (4, 2)];
    assert!(is_named(&items, &[2], 0), "five of ten answers");
    let items = [(6, 0), (6, 0), (1, 0), (1, 0), (2, 1)];
    assert!(is_named(&items, &[2], 0), "two of four items");
    let items = [(4, 0), (4, 0), (4, 0), (1, 0), (1, 0), (2, 1)];
    assert!(!is_named(&items, &[3], 0), "three of five items");
}

/// Misses are no evidence, so these mistakes are named only if they explain all items that they affect.
#[test]
fn a_mistake_that_misses_is_named_if_most_wrong_items_are_its_own() {
    let missed = || vec![number(1), ObservedAnswer::NoHit];
    let correct = [(); 7].map(|()| numbers(&[1, 1]));
    let known = [0, 1, 2, 3, 4, 5, 6].map(|item| (item < 4).then(missed));
    let exam = exam(&correct, &[("known", &known)]);
    let answers = |other: &ObservedAnswer| {
        [0, 1, 2, 3, 4, 5, 6].map(|item| match item {
            0..4 => missed(),
            _ => all(other.clone(), 2),
        })
    };
    let named = |other: ObservedAnswer| explained(&exam, &answers(&other))[0] == ["known"];
    assert!(named(number(9)), "four of seven wrong items");
    let stack = ObservedAnswer::NoAnswer(NoAnswerReason::Stack);
    assert!(
        named(stack),
        "it has no such answers, so they are another mistake's"
    );
}

#[test]
fn a_single_item_without_an_answer_may_be_due_to_other_code() {
    let panicked = || vec![number(7), ObservedAnswer::Panicked];
    let correct = [(); 4].map(|()| numbers(&[1, 1]));
    let known = [Some(panicked()), Some(panicked()), None, None];
    let exam = exam(&correct, &[("known", &known)]);
    let third = all(ObservedAnswer::Panicked, 2);
    let answers = [panicked(), panicked(), third, correct[3].clone()];
    assert_eq!(explained(&exam, &answers)[0], ["known"]);
}
