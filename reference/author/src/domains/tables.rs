//! Draws the rows of a table: calls of one subject, every other one a hit.

use super::{Balance, Call, FunctionDomain};
use crate::seed::Rng;

/// A subject, and the arguments of its calls.
pub type Drawn<C> = (<C as Call>::Subject, Vec<<C as Call>::Input>);

/// Draws the arguments of a call. Returns `None` if the contract does not allow them.
type DrawInput<'a, C> = &'a dyn Fn(&mut Rng, &<C as Call>::Subject) -> Option<<C as Call>::Input>;

/// How the calls of a function are drawn.
pub struct Generator<'a, C: Call> {
    /// The domain of the function.
    pub domain: &'static FunctionDomain<C>,
    /// Draws a subject of a size.
    pub subject: &'a dyn Fn(&mut Rng, usize) -> C::Subject,
    /// Draws the arguments of a call. Returns `None` if the contract does not allow them.
    pub input: DrawInput<'a, C>,
    /// Returns a call of another subject, which shows whether anything is kept from the call before.
    pub similar: &'a dyn Fn(&C) -> C,
    /// Returns whether a call belongs to the idea of an item, and all correct formulas agree about it.
    pub fits: &'a dyn Fn(&C) -> bool,
}

/// The number of pairs of a hit and a miss in a table.
const PAIRS: usize = 10;

impl<C: Call> Generator<'_, C> {
    /// Draws a subject of each of these sizes, each with pairs of a hit and a miss, so that each class
    /// of each aspect occurs. Some pairs differ in nothing but the range, if the range decides.
    /// The last table has the calls before it again, with another subject.
    pub fn tables(&self, rng: &mut Rng, sizes: &[usize]) -> Vec<Drawn<C>> {
        let FunctionDomain {
            subject_aspects,
            aspects,
            ..
        } = self.domain;
        let mut balances = (Balance::new(subject_aspects), Balance::new(aspects));
        let table = |(index, &size): (usize, &usize)| {
            balances.0.begin(size);
            balances.1.begin(index);
            rng.retry(|rng| self.table(rng, size, &mut balances))
        };
        let mut tables: Vec<Drawn<C>> = sizes.iter().enumerate().map(table).collect();
        if let Some((subject, inputs)) = tables.last_mut() {
            // The last call hits, so that an answer that is kept shows in the first call of the next table.
            let is_hit = |input: &C::Input| C::new(*subject, *input).is_hit();
            if let Some(hit) = inputs.iter().rposition(is_hit) {
                let hit = inputs.remove(hit);
                inputs.push(hit);
            }
        }
        let again = tables.last().and_then(|last| self.with_other_subject(last));
        tables.extend(again);
        tables
    }

    /// Returns those calls that also fit another subject, or `None` if only hits or only misses do.
    fn with_other_subject(&self, (subject, inputs): &Drawn<C>) -> Option<Drawn<C>> {
        // The first call is the one before it again.
        let calls = inputs.iter().rev().map(|&input| C::new(*subject, input));
        let calls = calls.map(|call| (self.similar)(&call));
        let calls: Vec<C> = calls.filter(|call| (self.fits)(call)).collect();
        let hits = calls.iter().filter(|call| call.is_hit()).count();
        let inputs = calls.iter().map(C::input).collect();
        let subject = calls.first()?.subject();
        (0 < hits && hits < calls.len()).then_some((subject, inputs))
    }

    /// Draws a subject and its calls. Returns `None` if few calls of the subject fit.
    fn table(
        &self,
        rng: &mut Rng,
        size: usize,
        (of_subject, of_row): &mut (Balance<C>, Balance<C>),
    ) -> Option<Drawn<C>> {
        /// How many calls are drawn until one of them fits a subject.
        const ATTEMPTS: usize = 20;
        // A subject that turns out not to fit counts as well, so that the next one is of another kind.
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
            Some(rng.shuffled(vec![hit.input(), miss.input()]))
        });
        let pairs = pairs.collect::<Option<Vec<Vec<C::Input>>>>()?;
        *of_row = balance;
        Some((subject, rng.shuffled(pairs).concat()))
    }

    fn call(&self, rng: &mut Rng, subject: &C::Subject) -> Option<C> {
        let call = C::new(*subject, (self.input)(rng, subject)?);
        (self.fits)(&call).then_some(call)
    }

    fn call_of(&self, rng: &mut Rng, subject: &C::Subject, is_hit: bool) -> Option<C> {
        let call = self.call(rng, subject)?;
        (call.is_hit() == is_hit).then_some(call)
    }

    /// Returns a call that misses because of its range alone, if one fits.
    fn miss_by_range(&self, rng: &mut Rng, hit: &C) -> Option<C> {
        const ATTEMPTS: usize = 20;
        rng.attempt(ATTEMPTS, |rng| {
            let call = hit.with_other_range(rng)?;
            (!call.is_hit() && (self.fits)(&call)).then_some(call)
        })
    }
}
