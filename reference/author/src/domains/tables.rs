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
    /// Returns whether a call belongs to the idea of an item, and all correct formulas agree about it.
    pub fits: &'a dyn Fn(&C) -> bool,
}

/// The number of pairs of a hit and a miss in a table.
const PAIRS: usize = 8;

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
        let table = |&size: &usize| rng.retry(|rng| self.table(rng, size, &mut balances));
        let mut tables: Vec<Drawn<C>> = sizes.iter().map(table).collect();
        let again = tables.last().and_then(|last| self.with_other_subject(last));
        tables.extend(again);
        tables
    }

    /// Returns those calls that also fit another subject, or `None` if only hits or only misses do.
    fn with_other_subject(&self, (subject, inputs): &Drawn<C>) -> Option<Drawn<C>> {
        let other = C::new(*subject, *inputs.first()?).other_subject();
        // The first call is the one before it again.
        let calls = inputs.iter().rev().map(|&input| C::new(other, input));
        let calls: Vec<C> = calls.filter(|call| (self.fits)(call)).collect();
        let hits = calls.iter().filter(|call| call.is_hit()).count();
        let inputs = calls.iter().map(C::input).collect();
        (0 < hits && hits < calls.len()).then_some((other, inputs))
    }

    /// Draws a subject and its calls. Returns `None` if few calls of the subject fit.
    fn table(
        &self,
        rng: &mut Rng,
        size: usize,
        balances: &mut (Balance<C>, Balance<C>),
    ) -> Option<Drawn<C>> {
        /// How many calls are drawn until one of them fits a subject.
        const ATTEMPTS: usize = 20;
        let (mut of_subject, mut of_row) = balances.clone();
        let subject = of_subject.choose(rng, |rng| {
            let subject = (self.subject)(rng, size);
            rng.attempt(ATTEMPTS, |rng| self.call(rng, &subject))
        })?;
        let subject = subject.subject();
        of_row.next_subject();
        let pairs = (0..PAIRS).map(|_| {
            let hit = of_row.choose(rng, |rng| self.call_of(rng, &subject, true))?;
            let miss = rng.coin().then(|| self.miss_by_range(rng, &hit)).flatten();
            let miss = match miss {
                Some(miss) => miss,
                None => of_row.choose(rng, |rng| self.call_of(rng, &subject, false))?,
            };
            Some(rng.shuffled(vec![hit.input(), miss.input()]))
        });
        let pairs = pairs.collect::<Option<Vec<Vec<C::Input>>>>()?;
        *balances = (of_subject, of_row);
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
