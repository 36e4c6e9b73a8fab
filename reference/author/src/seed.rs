//! Random numbers that are derived from a seed and an item's name. They are the same on every
//! machine.

use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The seed that all questions of an exam are drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seed(pub u64);

impl Seed {
    /// The seed of the practice exam. It isn't secret, because the practice exam is handed out with
    /// its keys.
    pub const PRACTICE: Seed = Seed(2025);

    /// Returns a seed derived from this one, for redrawing an item.
    pub fn next(self) -> Seed {
        Seed(self.rng("next").numbers.random())
    }

    /// Returns the random numbers for one item. Each item has its own sequence, so that changing
    /// one item doesn't affect the others.
    pub fn rng(self, item: &str) -> Rng {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&self.0.to_le_bytes());
        for (i, byte) in item.bytes().enumerate() {
            let slot: &mut u8 = &mut key[8 + i % 24];
            *slot = slot.rotate_left(3) ^ byte;
        }
        Rng {
            numbers: ChaCha8Rng::from_seed(key),
            seed: self,
        }
    }
}

/// A sequence of random numbers.
#[derive(Debug)]
pub struct Rng {
    numbers: ChaCha8Rng,
    seed: Seed,
}

impl Rng {
    /// Returns a different sequence for the same seed. It doesn't depend on how many numbers have
    /// been drawn from this sequence.
    pub fn sequence(&self, name: &str) -> Rng {
        self.seed.rng(name)
    }

    /// Returns a number in `[min, max)`.
    pub fn uniform(&mut self, min: f64, max: f64) -> f64 {
        self.numbers.random_range(min..max)
    }

    /// Returns a number in `[min, max)` whose logarithm is uniformly distributed.
    pub fn log_uniform(&mut self, min: f64, max: f64) -> f64 {
        libm::exp(self.uniform(libm::log(min), libm::log(max)))
    }

    /// Returns an integer in `0..n`. Panics if `n` is 0.
    pub fn index(&mut self, n: usize) -> usize {
        self.numbers.random_range(0..n)
    }

    /// Returns an integer from `min` to `max`, inclusive.
    pub fn integer(&mut self, min: u32, max: u32) -> u32 {
        self.numbers.random_range(min..=max)
    }

    /// Returns true or false with equal probability.
    pub fn coin(&mut self) -> bool {
        self.numbers.random_bool(0.5)
    }

    /// Returns −1 or 1 with equal probability.
    pub fn sign(&mut self) -> f64 {
        if self.coin() { 1.0 } else { -1.0 }
    }

    /// Returns a point in the cube from `-half` to `half` along each axis.
    pub fn point(&mut self, half: f64) -> DVec3 {
        self.vector(-half, half)
    }

    /// Returns a vector whose components are in `[min, max)`.
    pub fn vector(&mut self, min: f64, max: f64) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| self.uniform(min, max)))
    }

    /// Returns a uniformly distributed unit vector.
    pub fn direction(&mut self) -> DVec3 {
        // Rejection sampling in the unit ball avoids trigonometry.
        loop {
            let point = self.point(1.0);
            let length = point.length();
            if (0.1..=1.0).contains(&length) {
                return point / length;
            }
        }
    }

    /// Returns a random unit vector that is perpendicular to `dir`.
    pub fn perpendicular_to(&mut self, dir: DVec3) -> DVec3 {
        loop {
            let rejection = self.direction().reject_from(dir);
            if rejection.length() > 0.1 {
                return rejection.normalize();
            }
        }
    }

    /// Returns the elements in random order.
    pub fn shuffled<T>(&mut self, mut list: Vec<T>) -> Vec<T> {
        // The Fisher–Yates shuffle.
        for i in (1..list.len()).rev() {
            list.swap(i, self.index(i + 1));
        }
        list
    }

    /// Calls `attempt` until it returns `Some`, up to `most` times.
    pub fn attempt<T>(
        &mut self,
        most: usize,
        mut attempt: impl FnMut(&mut Rng) -> Option<T>,
    ) -> Option<T> {
        (0..most).find_map(|_| attempt(self))
    }

    /// Calls `attempt` until it returns `Some`. Returns that value.
    ///
    /// Questions are found by rejection sampling: a question is drawn again if a correct answer in
    /// single precision could differ from the key.
    pub fn retry<T>(&mut self, attempt: impl FnMut(&mut Rng) -> Option<T>) -> T {
        const MAX_ATTEMPTS: usize = 1_000_000;
        self.attempt(MAX_ATTEMPTS, attempt)
            .expect("an attempt succeeds")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_depend_on_the_seed_and_the_item() {
        let first = |seed, name| Seed(seed).rng(name).uniform(0.0, 1.0);
        assert_eq!(first(1, "a.b"), first(1, "a.b"));
        assert_ne!(first(1, "a.b"), first(2, "a.b"));
        assert_ne!(first(1, "a.b"), first(1, "b.a"));
        assert_ne!(Seed(1).next(), Seed(2).next());
    }

    #[test]
    fn numbers_are_the_same_on_every_machine() {
        let mut rng = Seed(7).rng("sphere.near_side");
        let numbers = [rng.index(1000), rng.index(1000), rng.index(1000)];
        assert_eq!(numbers, [99, 598, 640]);
    }
}
