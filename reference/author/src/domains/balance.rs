//! Draws calls so that each class occurs about equally often.

use super::Aspect;
use crate::seed::Rng;

/// How many suitable calls are compared.
const CANDIDATES: usize = 12;
/// How many calls are drawn at most to find them.
const ATTEMPTS: usize = 1000;

/// Counts how often each class has been chosen.
#[derive(Clone, Debug)]
pub struct Balance<C: 'static> {
    aspects: &'static [Aspect<C>],
    /// For each aspect, how often each of its classes has been chosen.
    counts: Vec<Vec<u32>>,
    /// The same for one subject.
    of_subject: Vec<Vec<u32>>,
}

impl<C> Balance<C> {
    /// Creates a balance in which nothing has been chosen yet.
    pub fn new(aspects: &'static [Aspect<C>]) -> Self {
        let zeros = aspects.iter().map(|aspect| vec![0; aspect.classes.len()]);
        let zeros: Vec<Vec<u32>> = zeros.collect();
        Balance {
            aspects,
            counts: zeros.clone(),
            of_subject: zeros,
        }
    }

    /// Begins the calls of another subject. Each class shall occur for each subject, too.
    pub fn next_subject(&mut self) {
        for count in self.of_subject.iter_mut().flatten() {
            *count = 0;
        }
    }

    /// Draws some calls, and chooses the one whose classes have been chosen least often. Returns `None`
    /// if `draw` never returns a call.
    pub fn choose(
        &mut self,
        rng: &mut Rng,
        mut draw: impl FnMut(&mut Rng) -> Option<C>,
    ) -> Option<C> {
        let drawn = (0..ATTEMPTS).filter_map(|_| draw(rng));
        let rarity = |call: &C| -> f64 {
            let classes = self.classes(call);
            classes
                .map(|(aspect, class)| self.rarity(aspect, class))
                .sum()
        };
        let rated = drawn.take(CANDIDATES).map(|call| (rarity(&call), call));
        let (_, call) = rated.max_by(|(a, _), (b, _)| a.total_cmp(b))?;
        let classes: Vec<(usize, usize)> = self.classes(&call).collect();
        for (aspect, class) in classes {
            self.counts[aspect][class] += 1;
            self.of_subject[aspect][class] += 1;
        }
        Some(call)
    }

    /// Returns the classes of a call, each with the index of its aspect.
    fn classes<'a>(&'a self, call: &'a C) -> impl Iterator<Item = (usize, usize)> + 'a {
        let aspects = self.aspects.iter().enumerate();
        aspects.filter_map(|(index, aspect)| Some((index, (aspect.class)(call)?)))
    }

    fn rarity(&self, aspect: usize, class: usize) -> f64 {
        let counts = [&self.counts, &self.of_subject].map(|counts| counts[aspect][class]);
        counts
            .map(|count| (1.0 + f64::from(count)).powi(-2))
            .iter()
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    const ASPECTS: &[Aspect<bool>] = &[Aspect {
        name: "luck",
        classes: &["usual", "rare"],
        class: |&is_rare| Some(usize::from(is_rare)),
    }];

    #[test]
    fn a_rare_class_is_chosen_as_often_as_a_usual_one() {
        let (mut balance, mut rng) = (Balance::new(ASPECTS), Seed(1).rng("balance"));
        let chosen = (0..40).map(|_| balance.choose(&mut rng, |rng| Some(rng.index(10) == 0)));
        let rare = chosen.flatten().filter(|&is_rare| is_rare).count();
        assert!((15..=20).contains(&rare), "{rare}");
        assert_eq!(balance.choose(&mut rng, |_| None), None);
    }
}
