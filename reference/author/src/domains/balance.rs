//! Draws calls so that each class occurs about equally often.

use super::Aspect;
use crate::seed::Rng;

/// How many calls are drawn for each that is chosen.
const CANDIDATES: usize = 16;
/// How many calls are drawn at most until one of them is of the right kind.
const ATTEMPTS: usize = 1000;

/// Counts how often each class has been chosen.
#[derive(Clone, Debug)]
pub struct Balance<C: 'static> {
    aspects: &'static [Aspect<C>],
    /// For each aspect, how often each of its classes has been chosen.
    counts: Vec<Vec<u32>>,
}

impl<C> Balance<C> {
    /// Creates a balance in which nothing has been chosen yet.
    pub fn new(aspects: &'static [Aspect<C>]) -> Self {
        let zeros = aspects.iter().map(|aspect| vec![0; aspect.classes.len()]);
        Balance {
            aspects,
            counts: zeros.collect(),
        }
    }

    /// Draws some calls, and chooses the one whose classes have been chosen least often. Returns `None`
    /// if `draw` hardly ever returns a call.
    pub fn choose(
        &mut self,
        rng: &mut Rng,
        mut draw: impl FnMut(&mut Rng) -> Option<C>,
    ) -> Option<C> {
        let candidates = (0..CANDIDATES).map(|_| rng.attempt(ATTEMPTS, &mut draw));
        let mut candidates = candidates.collect::<Option<Vec<C>>>()?;
        let rarity = |call: &C| {
            self.classes(call)
                .map(|(aspect, class)| self.rarity(aspect, class))
                .sum::<f64>()
        };
        let rarities: Vec<f64> = candidates.iter().map(rarity).collect();
        let rarest = (0..CANDIDATES).max_by(|&a, &b| rarities[a].total_cmp(&rarities[b]));
        let call = candidates.swap_remove(rarest.expect("there are candidates"));
        let classes: Vec<(usize, usize)> = self.classes(&call).collect();
        for (aspect, class) in classes {
            self.counts[aspect][class] += 1;
        }
        Some(call)
    }

    /// Returns the classes of a call, each with the index of its aspect.
    fn classes<'a>(&'a self, call: &'a C) -> impl Iterator<Item = (usize, usize)> + 'a {
        let aspects = self.aspects.iter().enumerate();
        aspects.filter_map(|(index, aspect)| Some((index, (aspect.class)(call)?)))
    }

    fn rarity(&self, aspect: usize, class: usize) -> f64 {
        (1.0 + f64::from(self.counts[aspect][class])).powi(-2)
    }
}
