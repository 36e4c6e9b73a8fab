//! How much of an item's points an answer earns, in ten-thousandths: no rounding but the last.

/// So many wrong positions cost nothing, of however few: honest formulas differ in the last bits.
pub(super) const STRAGGLERS: usize = 2;

/// A part of the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Share(u32);

impl Share {
    /// Everything is right.
    pub const ALL: Share = Share(10_000);
    /// Half of it.
    pub const HALF: Share = Share(5_000);
    /// Nothing counts.
    pub const NONE: Share = Share(0);

    /// How many of so many positions may be wrong for nothing.
    pub(super) fn stragglers(of: usize) -> usize {
        STRAGGLERS.max(of / 10_000)
    }

    /// What so many wrong positions of so many leave, by steps: none but stragglers, cracks,
    /// edges, large parts. Never by a similarity score, which small edits move for nothing.
    pub fn by_count(wrong: usize, of: usize) -> Self {
        if of == 0 {
            Share::NONE
        } else if wrong <= Share::stragglers(of) {
            Share::ALL
        } else if wrong * 500 <= of {
            Share(7_500)
        } else if wrong * 50 <= of {
            Share::HALF
        } else if wrong * 5 <= of {
            Share(2_500)
        } else {
            Share::NONE
        }
    }

    /// The sum of parts, each with its weight in hundredths, which add up to 100.
    pub fn weighted(parts: impl IntoIterator<Item = (u32, Share)>) -> Self {
        let sum = parts.into_iter().map(|(weight, share)| weight * share.0);
        Share(sum.sum::<u32>() / 100)
    }

    /// The points out of `points`, rounded down.
    pub fn of(self, points: u32) -> u32 {
        points * self.0 / 10_000
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_stragglers_cost_nothing_and_no_position_earns_nothing() {
        assert_eq!(Share::by_count(2, 20_480), Share::ALL);
        assert_eq!(Share::by_count(3, 20_480), Share(7_500));
        assert_eq!(Share::by_count(20_480 / 5 + 1, 20_480), Share::NONE);
        assert_eq!(Share::by_count(0, 0), Share::NONE);
    }

    #[test]
    fn points_are_rounded_down_once() {
        let share = Share::weighted([(40, Share::ALL), (30, Share(7_500)), (30, Share::ALL)]);
        assert_eq!(share, Share(9_250));
        assert_eq!(share.of(4), 3);
        assert_eq!(Share::ALL.of(4), 4);
    }
}
