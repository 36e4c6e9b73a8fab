//! Generates the rows of a table, which are random calls on one subject. Half of the calls are
//! hits.

use glam::DVec3;

use super::{Aspect, Balance, Call};
use crate::seed::Rng;

/// A subject, and the arguments of the calls on it.
pub type SubjectCalls<C> = (<C as Call>::Subject, Vec<<C as Call>::Input>);

/// Picks random arguments for a call. Returns `None` if the contract does not allow them.
type DrawInput<'a, C> = &'a dyn Fn(&mut Rng, &<C as Call>::Subject) -> Option<<C as Call>::Input>;

/// Returns the same call on a subject that differs in a single property. The vector has random
/// components from −1 to 1, which are the same for all calls in a table.
pub type Change<C> = fn(&C, DVec3) -> C;

/// Returns calls that are almost the same as this call and can come right after it. Returns `None`
/// if no such calls exist.
pub type Follow<C> = fn(&mut Rng, &C) -> Option<Vec<C>>;

/// A generator for calls to a function.
pub struct Generator<'a, C: Call> {
    /// The aspects of subjects.
    pub subject_aspects: &'static [Aspect<C>],
    /// The aspects of calls on one subject.
    pub call_aspects: &'static [Aspect<C>],
    /// Picks a random subject of this size.
    pub subject: &'a dyn Fn(&mut Rng, usize) -> C::Subject,
    /// Picks random arguments for a call. Returns `None` if the contract does not allow them.
    pub input: DrawInput<'a, C>,
    /// The ways a subject can differ from the previous one, to detect state kept between calls.
    pub changes: &'a [Change<C>],
    /// The maximum number of these changes in an item.
    pub most_changes: usize,
    /// The ways a call can follow another call on the same subject.
    pub follow: &'a [Follow<C>],
    /// Returns whether a call belongs in the item and has an answer that all correct formulas agree
    /// on.
    pub fits: &'a dyn Fn(&C) -> bool,
    /// Returns whether the answers to two calls differ in a quantity that the item judges.
    pub differ: &'a dyn Fn(&C, &C) -> bool,
}

/// The number of pairs in a table. Each pair consists of a hit and a miss.
const PAIRS: usize = 10;

/// For a subject that differs from the previous one, the maximum number of hits, and also of
/// misses.
const AGAIN: usize = 5;

impl<C: Call> Generator<'_, C> {
    /// For each of these sizes, picks a random subject and random pairs of calls, so that each
    /// class of each aspect occurs. Each pair consists of a hit and a miss. In some pairs, the two
    /// differ only in their ranges. Some pairs are followed by calls that are almost the same as
    /// the call before them. The last tables repeat earlier calls. Each of them has a subject that
    /// differs from the previous one in a single property.
    pub fn tables(&self, rng: &mut Rng, sizes: &[usize]) -> Vec<SubjectCalls<C>> {
        let mut balances = (
            Balance::new(self.subject_aspects),
            Balance::new(self.call_aspects),
        );
        let table = |(index, &size): (usize, &usize)| {
            balances.0.begin(size);
            balances.1.begin(index);
            rng.retry(|rng| self.table(rng, size, &mut balances))
        };
        let mut tables: Vec<SubjectCalls<C>> = sizes.iter().enumerate().map(table).collect();
        let Some(last) = tables.pop() else {
            return tables;
        };
        // The last call is a hit, so that a method that keeps its answer gives a wrong answer to
        // the first call in the next table.
        let ends_with = |row: usize| {
            let (subject, mut inputs) = last.clone();
            let end = inputs.remove(row);
            inputs.push(end);
            (subject, inputs)
        };
        let is_hit = |row: &usize| C::new(last.0, last.1[*row]).is_hit();
        let mut ends = (0..last.1.len()).rev().filter(is_hit);
        let found = ends.find_map(|row| {
            let changed = self.changed_tables(rng, &ends_with(row));
            (!changed.is_empty()).then(|| [vec![ends_with(row)], changed].concat())
        });
        tables.extend(found.unwrap_or_else(|| vec![last]));
        tables
    }

    /// Returns tables whose subjects each differ from the previous one in a single property.
    fn changed_tables(
        &self,
        rng: &mut Rng,
        (subject, inputs): &SubjectCalls<C>,
    ) -> Vec<SubjectCalls<C>> {
        let calls = inputs.iter().map(|&input| C::new(*subject, input));
        let mut calls: Vec<C> = calls.collect();
        let mut tables = Vec::new();
        let mut changes = rng.shuffled(self.changes.to_vec());
        // A change that isn't possible yet may become possible after another change.
        for _ in 0..2 {
            changes.retain(|&change| {
                if tables.len() == self.most_changes {
                    return false;
                }
                let Some((asked, all)) = self.changed(rng, &calls, change) else {
                    return true;
                };
                tables.push((asked[0].subject(), asked.iter().map(C::input).collect()));
                calls = all;
                false
            });
        }
        tables
    }

    /// Returns two lists of calls on a subject that differs from the previous one: a few calls for
    /// the table, and all suitable calls. The first call in the table repeats the previous table's
    /// last call, which now has a different answer. The table's last call is a hit.
    fn changed(&self, rng: &mut Rng, before: &[C], change: Change<C>) -> Option<(Vec<C>, Vec<C>)> {
        const ATTEMPTS: usize = 60;
        let last = before.last()?;
        rng.attempt(ATTEMPTS, |rng| {
            let random = rng.vector(-1.0, 1.0);
            let first = change(last, random);
            if !(self.fits)(&first) || !(self.differ)(last, &first) {
                return None;
            }
            let others = before[..before.len() - 1].iter().rev();
            let others = others.map(|call| change(call, random));
            let (mut hits, misses): (Vec<C>, Vec<C>) =
                others.filter(|call| (self.fits)(call)).partition(C::is_hit);
            let has_miss = !first.is_hit() || !misses.is_empty();
            let end = hits.pop().filter(|_| has_miss)?;
            let of_both = misses.iter().take(AGAIN).chain(hits.iter().take(AGAIN));
            let asked = std::iter::once(first).chain(of_both.copied()).chain([end]);
            let all = misses.iter().chain(&hits).copied().chain([first, end]);
            Some((asked.collect(), all.collect()))
        })
    }

    /// Picks a random subject and random calls on it. Returns `None` if too few suitable calls are
    /// found.
    fn table(
        &self,
        rng: &mut Rng,
        size: usize,
        (of_subject, of_row): &mut (Balance<C>, Balance<C>),
    ) -> Option<SubjectCalls<C>> {
        /// The maximum number of random calls to try when looking for one that suits a subject.
        const ATTEMPTS: usize = 20;
        // Subjects that turn out to be unsuitable are counted too, so that the next subject is of a
        // different kind.
        let subject = of_subject.choose(rng, |rng| {
            let subject = (self.subject)(rng, size);
            rng.attempt(ATTEMPTS, |rng| self.call(rng, &subject))
        })?;
        let subject = subject.subject();
        let mut balance = of_row.clone();
        let pairs = (0..PAIRS).map(|_| {
            let hit = balance.choose(rng, |rng| self.call_of(rng, &subject, true))?;
            let miss = rng.coin().then(|| self.miss_by_range(rng, &hit)).flatten();
            let miss = match miss {
                Some(miss) => miss,
                None => balance.choose(rng, |rng| self.call_of(rng, &subject, false))?,
            };
            Some(rng.shuffled(vec![hit, miss]))
        });
        let pairs = pairs.collect::<Option<Vec<Vec<C>>>>()?;
        let calls = self.with_followers(rng, pairs).concat();
        *of_row = balance;
        Some((subject, calls.iter().map(C::input).collect()))
    }

    /// Returns the pairs in random order. Some are followed by calls that are almost the same as
    /// the call before them but have a different answer.
    fn with_followers(&self, rng: &mut Rng, pairs: Vec<Vec<C>>) -> Vec<Vec<C>> {
        const ATTEMPTS: usize = 12;
        let mut pairs = rng.shuffled(pairs);
        for follow in rng.shuffled(self.follow.to_vec()) {
            let is_hit = rng.coin();
            let mut found = |is_wanted: &dyn Fn(&C) -> bool| {
                let alone = pairs.iter().enumerate().filter(|(_, pair)| pair.len() == 2);
                let mut rows = alone.map(|(index, pair)| (index, pair[1]));
                rows.find_map(|(index, last)| {
                    let calls = rng.attempt(ATTEMPTS, |rng| {
                        let calls = follow(rng, &last)?;
                        let before = std::iter::once(&last).chain(&calls).rev().nth(1)?;
                        let end = calls.last()?;
                        let fit = is_wanted(end) && calls.iter().all(|call| (self.fits)(call));
                        (fit && (self.differ)(before, end)).then_some(calls)
                    })?;
                    Some((index, calls))
                })
            };
            let calls = found(&|call| call.is_hit() == is_hit).or_else(|| found(&|_| true));
            if let Some((index, calls)) = calls {
                pairs[index].extend(calls);
            }
        }
        pairs
    }

    fn call(&self, rng: &mut Rng, subject: &C::Subject) -> Option<C> {
        let call = C::new(*subject, (self.input)(rng, subject)?);
        (self.fits)(&call).then_some(call)
    }

    fn call_of(&self, rng: &mut Rng, subject: &C::Subject, is_hit: bool) -> Option<C> {
        let call = C::new(*subject, (self.input)(rng, subject)?);
        // Half of the calls fail the first test, which is the faster one.
        (call.is_hit() == is_hit && (self.fits)(&call)).then_some(call)
    }

    /// Returns a suitable call that misses only because of its range, if one is found.
    fn miss_by_range(&self, rng: &mut Rng, hit: &C) -> Option<C> {
        const ATTEMPTS: usize = 20;
        rng.attempt(ATTEMPTS, |rng| {
            let call = hit.with_other_range(rng)?;
            (!call.is_hit() && (self.fits)(&call)).then_some(call)
        })
    }
}
