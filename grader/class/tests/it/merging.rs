//! Properties of merged classes.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use tempfile::TempDir;

use crate::harness::comparable_files;
use crate::stored_class::{StoredEntry, stored_class, write_shard, write_shards};

/// Merges shards, and returns the standard output without the folder.
fn merge(shards: &[PathBuf], out: &Path) -> String {
    crate::harness::merge(shards, out).replace(out.to_str().unwrap(), "OUT")
}

/// Returns the files that are not the same in both folders.
fn differences(one: &Path, other: &Path) -> Vec<PathBuf> {
    let (one, other) = (comparable_files(one), comparable_files(other));
    let all: BTreeSet<&PathBuf> = one.keys().chain(other.keys()).collect();
    let differ = |file: &&&PathBuf| one.get(**file) != other.get(**file);
    all.iter().filter(differ).copied().cloned().collect()
}

/// Returns an order for up to five shards.
fn order() -> impl Strategy<Value = Vec<usize>> {
    Just((0..5).collect::<Vec<usize>>()).prop_shuffle()
}

/// Merges an undivided class.
fn merge_whole(root: &Path, class: &[StoredEntry]) -> (PathBuf, String) {
    let (whole, out) = (root.join("whole"), root.join("merged-whole"));
    write_shard(&whole, class, None, false);
    let text = merge(&[whole], &out);
    (out, text)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// With more shards than submissions, some shards are empty. A shard may also have the results of
    /// somebody who has left the class.
    #[test]
    fn shards_in_any_number_and_order_are_merged_to_the_same_files(
        class in stored_class(),
        of in 1..=5usize,
        order in order(),
        stale: bool,
    ) {
        let root = TempDir::new().unwrap();
        let (whole, text) = merge_whole(root.path(), &class);
        let shards = write_shards(root.path(), &class, of, stale);
        let order = order.into_iter().filter(|index| *index < of);
        let shuffled: Vec<PathBuf> = order.map(|index| shards[index].clone()).collect();
        let out = root.path().join("merged");
        let merged = merge(&shuffled, &out);
        let mut differ = differences(&out, &whole);
        if stale {
            // The page and the output list who has left.
            differ.retain(|file| file != "class.html");
            prop_assert!(merged.contains("no longer in the input"), "{}", merged);
        } else {
            prop_assert_eq!(merged, text);
        }
        prop_assert_eq!(differ, Vec::<PathBuf>::new());
    }
}
