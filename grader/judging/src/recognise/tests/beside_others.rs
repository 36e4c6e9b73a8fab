//! Mistakes that explain most answers, beside others that are not known.

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

/// Another mistake that explains the same items, and all that it affects, may be the one.
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
fn a_mistake_that_explains_nearly_all_answers_is_named() {
    let named = |last: &str| {
        let answers = format!("7*3|7*3|7*3|{last}");
        names_known("1*3|2*3|3*3|4*3", &[("known", "7*3|7*3|7*3|7*3")], &answers)
    };
    assert!(named("7 7 9"), "one answer of another mistake");
    assert!(named("7 9 9"), "ten answers agree, two differ");
    assert!(!named("9 9 9"), "nine answers agree, three differ");
}

/// Returns whether the mistake `known`, which changes every answer to these items, is named. An item is
/// given by the number of its answers, and of those among them that are not the mistake's. Each rival
/// changes the first items as `known` does, as many as its number says. `others` is the number of items
/// that are wrong and that no mistake changes.
fn is_named(items: &[(usize, usize)], rivals: &[usize], others: usize) -> bool {
    let text = |changed: usize, of_item: &dyn Fn(usize, usize) -> String, other: &str| {
        let changed_items = items[..changed.min(items.len())].iter();
        let unchanged = vec![String::new(); items.len().saturating_sub(changed)];
        let own = changed_items.map(|&(size, differing)| of_item(size, differing));
        let own = own.chain(unchanged);
        let all: Vec<String> = own.chain(vec![other.to_owned(); others]).collect();
        all.join("|")
    };
    let correct = text(items.len(), &|size, _| format!("1*{size}"), "1");
    let answer = |size, differing| format!("7*{} 9*{differing}", size - differing);
    let answers = text(items.len(), &answer, "9");
    let changing = |count| text(count, &|size, _| format!("7*{size}"), "");
    let known = changing(items.len());
    let rivals: Vec<String> = rivals.iter().map(|&count| changing(count)).collect();
    let rivals = rivals.iter().map(|rival| ("rival", rival.as_str()));
    let mistakes: Vec<Mistake> = [("known", known.as_str())]
        .into_iter()
        .chain(rivals)
        .collect();
    names_known(&correct, &mistakes, &answers)
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

#[test]
fn correct_items_do_not_count_against_a_dominant_mistake() {
    let known = ("known", "7*3|7*3|7*3|7*3|||||");
    let answers = "7*3|7*3|7*3|7 7 9|2|2|2|2|2";
    assert!(explain("1*3|1*3|1*3|1*3|2|2|2|2|2", &[known], answers).starts_with("known|"));
}

#[test]
fn correct_answers_are_no_evidence_for_a_dominant_mistake() {
    let known = ("known", "7 2 3 4|7 2 3 4|7 2 3 4|7 2 3 4");
    let answers = "7 2 3 4|7 2 3 4|7 2 3 4|9 2 3 4";
    assert_eq!(
        explain("1 2 3 4|1 2 3 4|1 2 3 4|1 2 3 4", &[known], answers),
        "|||"
    );
}

/// Misses are no evidence, so these mistakes are named only if they explain all items that they affect.
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

/// A miss beside another wrong answer tells more than a miss.
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
