//! Credit: the fraction of an item's points that an answer earns, in ten-thousandths. Only the
//! final points are rounded.

/// Number of wrong positions that are tolerated even in a small picture. Correct formulas may
/// differ in the last bits, which can leave cracks between triangles.
pub(super) const TOLERATED_POSITIONS: usize = 5;

/// A fraction of an item's points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Credit(u32);

impl Credit {
    /// All points.
    pub const FULL: Credit = Credit(10_000);
    /// Half of the points.
    pub const HALF: Credit = Credit(5_000);
    /// No points.
    pub const NONE: Credit = Credit(0);

    /// Returns the number of positions, out of `of`, that may be wrong without reducing the credit.
    pub(super) fn tolerated(of: usize) -> usize {
        TOLERATED_POSITIONS.max(of / 10_000)
    }

    /// Returns the credit if `wrong` out of `of` positions are wrong. The steps distinguish
    /// rounding, cracks, wrong edges and large wrong areas. Credit depends on the number of wrong
    /// positions rather than on a similarity score, which could be raised by small changes that fix
    /// nothing.
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

    /// Returns the weighted sum of credits. The weights are in hundredths and must add up to 100.
    pub fn weighted(parts: impl IntoIterator<Item = (u32, Credit)>) -> Self {
        let sum = parts.into_iter().map(|(weight, credit)| weight * credit.0);
        Credit(sum.sum::<u32>() / 100)
    }

    /// Returns this fraction of `points`, rounded down.
    pub fn apply(self, points: u32) -> u32 {
        points * self.0 / 10_000
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_wrong_positions_are_free_and_zero_positions_earn_nothing() {
        assert_eq!(Credit::by_count(5, 20_480), Credit::FULL);
        assert_eq!(Credit::by_count(6, 20_480), Credit(7_500));
        assert_eq!(Credit::by_count(20_480 / 5 + 1, 20_480), Credit::NONE);
        assert_eq!(Credit::by_count(0, 0), Credit::NONE);
    }

    #[test]
    fn each_step_includes_its_last_position() {
        for (wrong, credit) in [
            (5, 10_000),
            (6, 7_500),
            (20, 7_500),
            (21, 5_000),
            (200, 5_000),
            (201, 2_500),
            (2_000, 2_500),
            (2_001, 0),
        ] {
            assert_eq!(Credit::by_count(wrong, 10_000), Credit(credit), "{wrong}");
        }
        assert_eq!(Credit::by_count(50, 500_000), Credit::FULL);
        assert_eq!(Credit::by_count(51, 500_000), Credit(7_500));
    }

    #[test]
    fn points_are_rounded_down_once() {
        let credit =
            Credit::weighted([(40, Credit::FULL), (30, Credit(7_500)), (30, Credit::FULL)]);
        assert_eq!(credit, Credit(9_250));
        assert_eq!(credit.apply(4), 3);
        assert_eq!(Credit::FULL.apply(4), 4);
    }
}
