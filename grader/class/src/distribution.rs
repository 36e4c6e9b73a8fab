//! The distribution of a class's points.

use serde::Serialize;

/// The number of bins in a distribution.
pub const BINS: usize = 10;

/// The distribution of a class's points for the exam or a task.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Distribution {
    /// The maximum number of points for the exam or task.
    pub of: u32,
    /// The lowest number of points.
    pub least: u32,
    /// The lower quartile.
    pub lower_quartile: u32,
    /// The median.
    pub median: u32,
    /// The upper quartile.
    pub upper_quartile: u32,
    /// The highest number of points.
    pub most: u32,
    /// The mean, rounded to one decimal place.
    pub mean: f64,
    /// The number of submissions in each tenth of the range from 0 to `of`. Submissions with full
    /// points are counted in the last tenth.
    pub bins: [usize; BINS],
}

impl Distribution {
    /// Returns the distribution of `points`, or `None` if `points` is empty. `of` is the maximum.
    pub fn new(mut points: Vec<u32>, of: u32) -> Option<Self> {
        points.sort_unstable();
        let (&least, &most) = (points.first()?, points.last()?);
        let count = points.len();
        // Use the nearest-rank method, so that every quartile is equal to some submission's points.
        let at = |quarter: usize| points[(quarter * count).div_ceil(4).max(1) - 1];
        let mut bins = [0; BINS];
        for &points in &points {
            let bin = points as usize * BINS / of.max(1) as usize;
            bins[bin.min(BINS - 1)] += 1;
        }
        let sum: u32 = points.iter().sum();
        Some(Distribution {
            of,
            least,
            lower_quartile: at(1),
            median: at(2),
            upper_quartile: at(3),
            most,
            mean: (10.0 * f64::from(sum) / count as f64).round() / 10.0,
            bins,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_are_values_from_the_data() {
        let spread = Distribution::new(vec![100, 0, 55, 90, 55], 100).unwrap();
        assert_eq!((spread.least, spread.median, spread.most), (0, 55, 100));
        assert_eq!((spread.lower_quartile, spread.upper_quartile), (55, 90));
        assert_eq!(spread.mean, 60.0);
        assert_eq!(spread.bins, [1, 0, 0, 0, 0, 2, 0, 0, 0, 2]);
        assert_eq!(Distribution::new(Vec::new(), 100), None);
    }
}
