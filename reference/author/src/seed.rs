//! Where chance comes from: a seed and a name, the same on every machine.

use glam::{DVec3, dvec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What all questions of an exam follow from.
#[derive(Clone, Copy, Debug)]
pub struct Seed(pub u64);

impl Seed {
    /// Random numbers for one item. Each item has its own, so that a change of one leaves the
    /// others as they were.
    pub fn rng(self, item: &str) -> Rng {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&self.0.to_le_bytes());
        for (i, byte) in item.bytes().enumerate() {
            let place: &mut u8 = &mut key[8 + i % 24];
            *place = place.rotate_left(3) ^ byte;
        }
        Rng(ChaCha8Rng::from_seed(key))
    }
}

/// Random numbers, drawn one after the other.
#[derive(Debug)]
pub struct Rng(ChaCha8Rng);

impl Rng {
    /// A number in `[min, max)`.
    pub fn uniform(&mut self, min: f64, max: f64) -> f64 {
        self.0.random_range(min..max)
    }

    /// A whole number below `n`, which is above zero.
    pub fn index(&mut self, n: usize) -> usize {
        self.0.random_range(0..n)
    }

    /// Heads or tails.
    pub fn coin(&mut self) -> bool {
        self.0.random_bool(0.5)
    }

    /// −1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.coin() { 1.0 } else { -1.0 }
    }

    /// A point in the cube from `-half` to `half` along each axis.
    pub fn point(&mut self, half: f64) -> DVec3 {
        dvec3(
            self.uniform(-half, half),
            self.uniform(-half, half),
            self.uniform(-half, half),
        )
    }

    /// A direction of length one, all equally likely.
    pub fn direction(&mut self) -> DVec3 {
        // From the unit ball, by rejection: no trigonometry.
        loop {
            let point = self.point(1.0);
            let length = point.length();
            if (0.1..=1.0).contains(&length) {
                return point / length;
            }
        }
    }

    /// A direction of length one at a right angle to `dir`.
    pub fn perpendicular_to(&mut self, dir: DVec3) -> DVec3 {
        loop {
            let across = self.direction().reject_from(dir);
            if across.length() > 0.1 {
                return across.normalize();
            }
        }
    }

    /// The same elements in another order.
    pub fn shuffled<T>(&mut self, mut list: Vec<T>) -> Vec<T> {
        // Fisher and Yates.
        for i in (1..list.len()).rev() {
            list.swap(i, self.index(i + 1));
        }
        list
    }

    /// What `attempt` makes, asked again until it makes something.
    ///
    /// Questions are found by rejection: drawn, and drawn again where an honest answer in single
    /// precision could differ from the true one.
    pub fn retry<T>(&mut self, mut attempt: impl FnMut(&mut Rng) -> Option<T>) -> T {
        const PATIENCE: usize = 1_000_000;
        (0..PATIENCE)
            .find_map(|_| attempt(self))
            .expect("a question of this kind exists")
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
    }

    #[test]
    fn numbers_are_the_same_on_every_machine() {
        let mut draw = Seed(7).rng("sphere.near_side");
        let whole = [draw.index(1000), draw.index(1000), draw.index(1000)];
        assert_eq!(whole, [99, 598, 640]);
    }
}
