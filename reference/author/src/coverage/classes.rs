//! How often the classes of a function's domain are asked.

use std::collections::{BTreeMap, BTreeSet};

use judging::exam::{Exam, Key, TreeCheck};

use crate::domains::Domain;

/// The column of calls whose answer is not `None`.
const PRESENT: &str = "some";
/// The column of calls whose answer is `None`.
const ABSENT: &str = "`None`";

/// How often each class of each aspect is asked, for hits, misses, and each quantity of a hit.
#[derive(Debug)]
pub(super) struct Classes {
    /// The columns that occur.
    pub columns: Vec<String>,
    counts: BTreeMap<(usize, usize, String), usize>,
    /// How often each pair of classes is asked.
    pairs: BTreeMap<[(usize, usize); 2], usize>,
}

impl Classes {
    /// Counts the calls of a function in an exam.
    pub(super) fn count(domain: &dyn Domain, exam: &Exam) -> Self {
        let mut counted = Classes {
            columns: Vec::new(),
            counts: BTreeMap::new(),
            pairs: BTreeMap::new(),
        };
        let mut judged_anywhere = BTreeSet::new();
        for asked in exam.items.iter().flat_map(|item| &item.questions) {
            let Key::Table { judged, rows, .. } = &asked.key else {
                let judged = judged_of_tree(&asked.key);
                judged_anywhere.extend(judged.iter().map(|&name| name.to_owned()));
                counted.add_all(&domain.classes(&asked.question), |_| {
                    std::iter::once(PRESENT)
                        .chain(judged.iter().copied())
                        .collect()
                });
                continue;
            };
            judged_anywhere.extend(judged.iter().cloned());
            counted.add_all(&domain.classes(&asked.question), |row| {
                if rows.is_present(row) {
                    let quantities = judged.iter().map(String::as_str);
                    std::iter::once(PRESENT).chain(quantities).collect()
                } else {
                    vec![ABSENT]
                }
            });
        }
        let used: BTreeSet<String> = counted.counts.keys().map(|key| key.2.clone()).collect();
        let quantities = judged_anywhere.into_iter().filter(|it| used.contains(it));
        let fixed = [PRESENT, ABSENT].map(str::to_owned).into_iter();
        counted.columns = fixed
            .filter(|it| used.contains(it))
            .chain(quantities)
            .collect();
        counted
    }

    fn add_all<'a>(
        &mut self,
        calls: &[Vec<Option<usize>>],
        columns: impl Fn(usize) -> Vec<&'a str>,
    ) {
        for (row, classes) in calls.iter().enumerate() {
            let classes = classes.iter().enumerate();
            let classes = classes.filter_map(|(aspect, class)| Some((aspect, (*class)?)));
            let classes: Vec<(usize, usize)> = classes.collect();
            for &(aspect, class) in &classes {
                for column in columns(row) {
                    let key = (aspect, class, column.to_owned());
                    *self.counts.entry(key).or_default() += 1;
                }
                for &other in &classes {
                    *self.pairs.entry([(aspect, class), other]).or_default() += 1;
                }
            }
        }
    }

    /// Returns how often a class of an aspect is asked for what a column counts.
    pub(super) fn times(&self, aspect: usize, class: usize, column: &str) -> usize {
        let key = (aspect, class, column.to_owned());
        self.counts.get(&key).copied().unwrap_or(0)
    }

    /// Returns how often two classes are asked together.
    pub(super) fn times_together(&self, pair: [(usize, usize); 2]) -> usize {
        self.pairs.get(&pair).copied().unwrap_or(0)
    }
}

/// Returns the names of what is judged about a tree.
fn judged_of_tree(key: &Key) -> Vec<&'static str> {
    let Key::Tree {
        checks, sweep_cost, ..
    } = key
    else {
        return Vec::new();
    };
    let checks = checks.iter().map(|check| match check {
        TreeCheck::Partition => "partition",
        TreeCheck::Contains => "contents",
        TreeCheck::Tight => "tightness",
        TreeCheck::Split => "split",
        TreeCheck::LeafSize => "leaf size",
        TreeCheck::Stops => "stops",
    });
    checks.chain(sweep_cost.map(|_| "cost")).collect()
}
