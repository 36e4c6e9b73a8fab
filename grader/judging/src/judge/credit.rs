//! How much of an item's points an answer earns, in ten-thousandths: no rounding but the last.

/// So many wrong positions cost nothing, of however few: honest formulas differ in the last bits.
pub(super) const TOLERATED_POSITIONS: usize = 2;

/// A part of the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Credit(u32);

impl Credit {
    /// Everything is right.
    pub const FULL: Credit = Credit(10_000);
    /// Half of it.
    pub const HALF: Credit = Credit(5_000);
    /// Nothing counts.
    pub const NONE: Credit = Credit(0);

    /// How many of so many positions may be wrong for nothing.
    pub(super) fn tolerated(of: usize) -> usize {
        TOLERATED_POSITIONS.max(of / 10_000)
    }

    /// What so many wrong positions of so many leave, by steps: none but stragglers, cracks,
    /// edges, large parts. Never by a similarity score, which small edits move for nothing.
    pub fn by_count(wrong: usize, of: usize) -> Self {
        if of == 0 {
            Credit::NONE
        } else if wrong <= Credit::tolerated(of) {
            Credit::FULL
        } else if wrong * 500 <= of {
            Credit(7_500)
        } else if wrong * 50 <= of {
            Credit::HALF
        } else if wrong * 5 <= of {
            Credit(2_500)
        } else {
            Credit::NONE
        }
    }

    /// The sum of parts, each with its weight in hundredths, which add up to 100.
    pub fn weighted(parts: impl IntoIterator<Item = (u32, Credit)>) -> Self {
        let sum = parts.into_iter().map(|(weight, share)| weight * share.0);
        Credit(sum.sum::<u32>() / 100)
    }

    /// The points out of `points`, rounded down.
    pub fn apply(self, points: u32) -> u32 {
        points * self.0 / 10_000
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_wrong_positions_are_free_and_zero_positions_earn_nothing() {
        assert_eq!(Credit::by_count(2, 20_480), Credit::FULL);
        assert_eq!(Credit::by_count(3, 20_480), Credit(7_500));
        assert_eq!(Credit::by_count(20_480 / 5 + 1, 20_480), Credit::NONE);
        assert_eq!(Credit::by_count(0, 0), Credit::NONE);
    }

    #[test]
    fn points_are_rounded_down_once() {
        let share = Credit::weighted([(40, Credit::FULL), (30, Credit(7_500)), (30, Credit::FULL)]);
        assert_eq!(share, Credit(9_250));
        assert_eq!(share.apply(4), 3);
        assert_eq!(Credit::FULL.apply(4), 4);
    }
}
