//! Tests for rounds, and for the folders, lists and numbers that a class is graded with. Complete
//! runs are tested in `tests/histories`.

use std::fs;

use super::*;
use crate::store::tests::{run, store};

#[test]
fn a_run_is_resumed_and_a_finished_one_regraded_in_a_new_round() {
    let (_folder, store) = store();
    use RoundState::{Finished, Resumed, SavesPrevious, Started};
    let next = |state: RoundState, regrade: bool| {
        let written = Run { state, ..run() };
        store.write_run(&written).unwrap();
        let next = start_or_resume(&store, run().settings, regrade).unwrap();
        (next.round, next.state)
    };
    assert_eq!(next(Started, false), (1, Started));
    assert_eq!(next(SavesPrevious, false), (1, SavesPrevious));
    assert_eq!(next(Finished, false), (1, Resumed));
    // A stopped regrade is resumed.
    assert_eq!(next(Started, true), (1, Started));
    assert_eq!(next(Finished, true), (2, SavesPrevious));
    // The round's second run was stopped or was an estimate.
    assert_eq!(next(Resumed, false), (1, Resumed));
    assert_eq!(next(Resumed, true), (2, SavesPrevious));
}

#[test]
fn the_output_must_be_outside_of_the_input_and_of_the_same_part() {
    let (folder, store) = store();
    let input = folder.path().join("class");
    fs::create_dir(&input).unwrap();
    let archive = folder.path().join("class.zip");
    fs::write(&archive, "").unwrap();
    let part: Shard = "1/2".parse().unwrap();
    for input in [&input, &archive] {
        check_out(&store, input, None).unwrap();
        check_out(&store, input, Some(part)).unwrap();
    }
    let refused = |input: &Path| {
        let refused = check_out(&store, input, None);
        refused.unwrap_err().to_string()
    };
    let error = refused(folder.path());
    assert!(error.contains("taken for submissions"), "{error}");

    let of_part = Run {
        shard: Some(part),
        ..run()
    };
    store.write_run(&of_part).unwrap();
    check_out(&store, &input, Some(part)).unwrap();
    let error = refused(&input);
    let text = "of part 1/2, not of the whole class";
    assert!(error.contains(text), "{error}");
}

#[test]
fn a_given_number_of_slots_counts_and_otherwise_there_is_at_least_one() {
    assert_eq!(slot_count(Some(3)), 3);
    assert!(slot_count(None) >= 1);
}
