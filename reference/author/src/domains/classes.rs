//! Counts how often the classes in a function's domain are tested.

use std::collections::{BTreeMap, BTreeSet};

use judging::exam::{Item, Key, TreeCheck};

use super::Domain;

/// The minimum number of answers per class, so that no mistake passes by luck.
pub const FEWEST: usize = 2;

/// The column for calls whose answer is not `None`.
const PRESENT: &str = "some";
/// The column for calls whose answer is `None`.
const ABSENT: &str = "`None`";

/// How often each class of each aspect is tested, counted separately for hits, for misses and for
/// each quantity of a hit.
#[derive(Clone, Debug, Default)]
pub struct Classes {
    counts: BTreeMap<(usize, usize, String), usize>,
    /// How often each pair of classes is tested.
    pairs: BTreeMap<[(usize, usize); 2], usize>,
}

impl Classes {
    /// Counts the calls to a function in an exam's items.
    pub fn count<'a>(domain: &dyn Domain, items: impl IntoIterator<Item = &'a Item>) -> Self {
        let items: Vec<Classes> = items
            .into_iter()
            .map(|item| Classes::of_item(domain, item))
            .collect();
        Classes::sum(&items)
    }

    /// Counts the calls to a function in an item.
    pub fn of_item(domain: &dyn Domain, item: &Item) -> Self {
        let mut counted = Classes::default();
        let pairs = pairs_of_aspects(domain);
        let before = std::iter::once(None).chain(item.questions.iter().map(Some));
        for (asked, before) in item.questions.iter().zip(before) {
            let question_before = before.map(|before| &before.question);
            let mut calls = domain.classes(&asked.question, question_before);
            let changes = domain.only_changes(asked, before).into_iter();
            for (classes, change) in calls.iter_mut().zip(changes) {
                classes.push(change);
            }
            let mut present = vec![PRESENT];
            let rows = if let Key::Table { judged, rows, .. } = &asked.key {
                present.extend(judged.iter().map(String::as_str));
                Some(rows)
            } else {
                present.extend(judged_without_rows(&asked.key));
                None
            };
            for (row, classes) in calls.iter().enumerate() {
                let is_present = rows.is_none_or(|rows| rows.is_present(row));
                counted.add(
                    &pairs,
                    classes,
                    if is_present { &present } else { &[ABSENT] },
                );
            }
        }
        counted
    }

    /// Adds up the counts of several items.
    pub fn sum<'a>(items: impl IntoIterator<Item = &'a Classes>) -> Self {
        let mut sum = Classes::default();
        for Classes { counts, pairs } in items {
            for (key, count) in counts {
                *sum.counts.entry(key.clone()).or_default() += count;
            }
            for (key, count) in pairs {
                *sum.pairs.entry(*key).or_default() += count;
            }
        }
        sum
    }

    /// Returns the columns that occur.
    pub fn columns(&self) -> Vec<String> {
        let used: BTreeSet<&str> = self.counts.keys().map(|key| key.2.as_str()).collect();
        let fixed = [PRESENT, ABSENT];
        let quantities = used.iter().filter(|it| !fixed.contains(it));
        let columns = fixed.iter().filter(|it| used.contains(*it));
        columns.chain(quantities).map(|&it| it.to_owned()).collect()
    }

    /// Counts a call whose answer belongs in these columns.
    fn add(&mut self, pairs: &[[usize; 2]], classes: &[Option<usize>], columns: &[&str]) {
        for (aspect, class) in classes.iter().enumerate() {
            let Some(class) = *class else { continue };
            for &column in columns {
                let key = (aspect, class, column.to_owned());
                *self.counts.entry(key).or_default() += 1;
            }
        }
        for &[a, b] in pairs {
            if let (Some(class), Some(other)) = (classes[a], classes[b]) {
                *self.pairs.entry([(a, class), (b, other)]).or_default() += 1;
            }
        }
    }

    /// Returns a cell for each class in each column: all cells for the first class, then those for
    /// the second, and so on.
    pub fn cells(&self, domain: &dyn Domain) -> Vec<Cell> {
        let (columns, mut cells) = (self.columns(), Vec::new());
        for (aspect, (name, classes)) in domain.aspects().into_iter().enumerate() {
            for (class, class_name) in classes.iter().enumerate() {
                for column in &columns {
                    let key = (aspect, class, column.clone());
                    cells.push(Cell {
                        aspect: name,
                        class: class_name,
                        column: column.clone(),
                        count: self.counts.get(&key).copied().unwrap_or(0),
                        reason: reason(domain, name, class_name, column),
                    });
                }
            }
        }
        cells
    }

    /// Returns a count for each pair of classes that should be tested together.
    pub fn pairs(&self, domain: &dyn Domain) -> Vec<Pair> {
        /// The column name that a domain's reasons use for pairs.
        const COLUMN: &str = "pairs";
        let aspects = domain.aspects();
        let mut pairs = Vec::new();
        for (names, [a, b]) in domain.pairs().iter().zip(pairs_of_aspects(domain)) {
            for (i, class) in aspects[a].1.iter().enumerate() {
                for (j, other) in aspects[b].1.iter().enumerate() {
                    let count = self.pairs.get(&[(a, i), (b, j)]).copied().unwrap_or(0);
                    let of_first = reason(domain, names[0], class, COLUMN);
                    let of_second = || reason(domain, names[1], other, COLUMN);
                    pairs.push(Pair {
                        classes: [(names[0], class), (names[1], other)],
                        count,
                        reason: of_first.or_else(of_second),
                    });
                }
            }
        }
        pairs
    }
}

/// How often a class is tested in a column.
#[derive(Debug)]
pub struct Cell {
    /// The aspect.
    pub aspect: &'static str,
    /// The class of the aspect.
    pub class: &'static str,
    /// The name of the column, such as a judged quantity.
    pub column: String,
    /// The number of answers.
    pub count: usize,
    /// The reason an exam need not test the class in this column, if any.
    pub reason: Option<&'static str>,
}

impl Cell {
    /// Returns whether the class should be tested more often.
    pub fn is_missing(&self) -> bool {
        self.count < FEWEST && self.reason.is_none()
    }
}

/// How often the classes of two aspects are tested together.
#[derive(Debug)]
pub struct Pair {
    /// The aspects, each with its class.
    pub classes: [(&'static str, &'static str); 2],
    /// The number of answers.
    pub count: usize,
    /// The reason an exam need not test the pair, if any.
    pub reason: Option<&'static str>,
}

impl Pair {
    /// Returns whether the pair still has to be tested.
    pub fn is_missing(&self) -> bool {
        self.count == 0 && self.reason.is_none()
    }
}

/// Returns the indices of the two aspects in each of a domain's pairs. Panics if the domain doesn't
/// contain one of these aspects.
fn pairs_of_aspects(domain: &dyn Domain) -> Vec<[usize; 2]> {
    let aspects = domain.aspects();
    let place = |name: &str| {
        let found = aspects.iter().position(|aspect| aspect.0 == name);
        found.expect("a pair names two aspects of its domain")
    };
    let pairs = domain.pairs().iter();
    pairs.map(|names| names.map(place)).collect()
}

/// Returns the reason an exam need not test a class in a column, if the domain states one.
fn reason(domain: &dyn Domain, aspect: &str, class: &str, column: &str) -> Option<&'static str> {
    let mut reasons = domain.not_asked().iter();
    let found = reasons.find(|reason| reason.is_about(aspect, class, column));
    found.map(|reason| reason.why)
}

/// Returns the names of the judged properties of an answer that isn't compared row by row.
fn judged_without_rows(key: &Key) -> Vec<&'static str> {
    if let Key::SpreadEvenly { .. } = key {
        return vec!["evenness"];
    }
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
