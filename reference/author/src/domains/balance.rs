//! Picks random calls so that all classes occur about equally often. Classes that rarely come up at
//! random are favoured slightly.

use std::collections::BTreeMap;

use super::Aspect;
use crate::seed::Rng;

/// The number of suitable calls to compare.
const CANDIDATES: usize = 48;
/// The maximum number of random calls to try while searching for [`CANDIDATES`] suitable ones.
const ATTEMPTS: usize = 1000;

/// Counts how often each class has been chosen.
#[derive(Clone, Debug)]
pub struct Balance<C: 'static> {
    aspects: &'static [Aspect<C>],
    /// For each aspect, how often each of its classes has been chosen.
    counts: Vec<Vec<u32>>,
    /// For each group of calls, the same counts within that group.
    of_groups: BTreeMap<usize, Vec<Vec<u32>>>,
    /// The group of the next call.
    group: usize,
}

impl<C> Balance<C> {
    /// Creates a balance with all counts at 0.
    pub fn new(aspects: &'static [Aspect<C>]) -> Self {
        Balance {
            aspects,
            counts: zeros(aspects),
            of_groups: BTreeMap::new(),
            group: 0,
        }
    }

    /// Starts a group for the next calls. Every class should also occur within each group.
    pub fn begin(&mut self, group: usize) {
        self.group = group;
    }

    /// Generates some calls with `draw` and chooses the one whose classes have been chosen least
    /// often. Returns `None` if `draw` never returns a call.
    pub fn choose(
        &mut self,
        rng: &mut Rng,
        mut draw: impl FnMut(&mut Rng) -> Option<C>,
    ) -> Option<C> {
        let group = self.of_groups.entry(self.group);
        let mut of_group = group.or_insert_with(|| zeros(self.aspects)).clone();
        let drawn = (0..ATTEMPTS).filter_map(|_| draw(rng));
        let with_classes = drawn
            .take(CANDIDATES)
            .map(|call| (self.classes(&call), call));
        let drawn: Vec<(Vec<(usize, usize)>, C)> = with_classes.collect();
        // A class that rarely comes up is chosen as soon as it does, since it may not come up
        // again.
        let mut times = zeros(self.aspects);
        for &(aspect, class) in drawn.iter().flat_map(|(classes, _)| classes) {
            times[aspect][class] += 1;
        }
        let count_of_drawn = drawn.len() as f64;
        let rarity = |classes: &[(usize, usize)]| -> f64 {
            let rarities = classes.iter().map(|&(aspect, class)| {
                let counts = [self.counts[aspect][class], of_group[aspect][class]];
                let rarities = counts.map(|count| (1.0 + f64::from(count)).powi(-2));
                let seldom = count_of_drawn / f64::from(times[aspect][class]);
                rarities.iter().sum::<f64>() * seldom.sqrt()
            });
            rarities.sum()
        };
        let rated = drawn.into_iter().map(|it| (rarity(&it.0), it));
        let (_, (classes, call)) = rated.max_by(|(a, _), (b, _)| a.total_cmp(b))?;
        for (aspect, class) in classes {
            self.counts[aspect][class] += 1;
            of_group[aspect][class] += 1;
        }
        self.of_groups.insert(self.group, of_group);
        Some(call)
    }

    /// Returns the classes of a call, each with the index of its aspect.
    fn classes(&self, call: &C) -> Vec<(usize, usize)> {
        let aspects = self.aspects.iter().enumerate();
        let classes = aspects.filter_map(|(index, aspect)| Some((index, (aspect.class)(call)?)));
        classes.collect()
    }
}

/// Returns a count of 0 for each class of each aspect.
fn zeros<C>(aspects: &[Aspect<C>]) -> Vec<Vec<u32>> {
    let counts = aspects.iter().map(|aspect| vec![0; aspect.classes.len()]);
    counts.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    const ASPECTS: &[Aspect<bool>] = &[Aspect::new("luck", &["usual", "rare"], |&is_rare| {
        Some(usize::from(is_rare))
    })];

    #[test]
    fn a_rare_class_is_chosen_at_least_as_often_as_a_usual_one() {
        let (mut balance, mut rng) = (Balance::new(ASPECTS), Seed(1).rng("balance"));
        let chosen = (0..40).map(|_| balance.choose(&mut rng, |rng| Some(rng.index(10) == 0)));
        let rare = chosen.flatten().filter(|&is_rare| is_rare).count();
        assert!((20..=27).contains(&rare), "{rare}");
        assert_eq!(balance.choose(&mut rng, |_| None), None);
    }
}
