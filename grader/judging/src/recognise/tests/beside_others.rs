//! Mistakes that explain most answers, beside others that are not known.

use super::*;

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
    let refuted = [
        Some(numbers(&[7])),
        Some(numbers(&[7])),
        None,
        Some(numbers(&[8])),
    ];
    assert!(named(&exam_of(&[("refuted", &refuted)]), [7, 7, 9, 4]));
}

/// Another mistake that explains the same items, and all that it affects, may be the one.
#[test]
fn a_mistake_with_a_rival_is_not_named_beside_an_unknown_one() {
    let correct = [1, 2, 3, 4, 5].map(|index| numbers(&[index]));
    let wrong = |count: usize| [0, 1, 2, 3, 4].map(|item| (item < count).then(|| numbers(&[7])));
    let (known, rival) = (wrong(3), wrong(4));
    let answers = [7, 7, 7, 7, 9].map(|answer| numbers(&[answer]));
    let named = |mistakes: &[Mistake]| explained(&exam(&correct, mistakes), &answers)[0].clone();
    assert_eq!(named(&[("known", &known)]), ["known"]);
    assert_eq!(named(&[("known", &known), ("rival", &rival)]), ["rival"]);
}

#[test]
fn the_same_defect_in_items_that_a_mistake_leaves_correct_has_another_cause() {
    let tree = |defect: &str| vec![ObservedAnswer::Tree(Some((defect.to_owned(), 0.0)))];
    let correct = [(); 4].map(|()| vec![ObservedAnswer::Tree(None)]);
    let named = |known: [&str; 2], third: &str| {
        let [first, second] = known.map(tree);
        let known = [Some(first.clone()), Some(second.clone()), None, None];
        let exam = exam(&correct, &[("known", &known)]);
        let answers = [first, second, tree(third), correct[3].clone()];
        !explained(&exam, &answers).concat().is_empty()
    };
    assert!(named(["boxes", "boxes"], "leaves"));
    assert!(!named(["boxes", "boxes"], "boxes"));
    assert!(named(["boxes", "leaves"], "splits"));
    assert!(!named(["boxes", "leaves"], "boxes"));
    assert!(!named(["boxes", "leaves"], "leaves"));
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

/// Returns whether the mistake `known`, which changes every answer to these items, is named. An item is
/// given by the number of its answers, and of those among them that are not the mistake's. Each rival
/// changes the first items as `known` does, as many as its number says. `others` is the number of items
/// that are wrong and that no mistake changes.
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
fn correct_items_do_not_count_against_a_dominant_mistake() {
    let correct = [vec![numbers(&[1, 1, 1]); 4], vec![numbers(&[2]); 5]].concat();
    let wrong = |item: usize| (item < 4).then(|| numbers(&[7, 7, 7]));
    let known: Vec<_> = (0..9).map(wrong).collect();
    let mut answers = correct.clone();
    answers[..3].fill(numbers(&[7, 7, 7]));
    answers[3] = numbers(&[7, 7, 9]);
    let named = explained(&exam(&correct, &[("known", &known)]), &answers);
    assert_eq!(named[0], ["known"]);
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

/// A miss beside another wrong answer tells more than a miss.
#[test]
fn a_mistake_that_also_misses_is_named_beside_an_unknown_one() {
    let wrong = || vec![ObservedAnswer::NoHit, number(7)];
    let correct = [(); 3].map(|()| numbers(&[1, 1]));
    let exam = exam(
        &correct,
        &[("known", &[Some(wrong()), Some(wrong()), None])],
    );
    let answers = [wrong(), wrong(), numbers(&[9, 9])];
    assert_eq!(explained(&exam, &answers)[0], ["known"]);
}

#[test]
fn several_items_without_an_answer_have_another_cause_than_one_that_is_known_to_give_none() {
    let missed = || vec![number(1), ObservedAnswer::NoHit];
    let panicked = || vec![number(1), ObservedAnswer::Panicked];
    let correct = [(); 5].map(|()| numbers(&[1, 1]));
    let known = [Some(missed()), Some(missed()), Some(panicked()), None, None];
    let exam = exam(&correct, &[("known", &known)]);
    let named = |last: [Vec<ObservedAnswer>; 2]| {
        let [fourth, fifth] = last;
        let answers = [missed(), missed(), panicked(), fourth, fifth];
        !explained(&exam, &answers).concat().is_empty()
    };
    assert!(named([numbers(&[1, 9]), numbers(&[1, 9])]));
    assert!(named([panicked(), numbers(&[1, 9])]));
    assert!(!named([panicked(), panicked()]));
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
