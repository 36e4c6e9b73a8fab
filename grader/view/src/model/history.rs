//! The history of a pixel: its samples one by one, with the running mean and variance.

use framework::render::film::luminance;
use framework::render::renderer::InvalidSample;
use glam::Vec3;
use protocol::Panic;
use serde::Serialize;
use view_probe::messages::PathSample;

/// A sample of a pixel, and the statistics of all samples up to this one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SampleRow {
    /// The radiance. It is zero if the sample is discarded, as in the picture.
    pub radiance: Vec3,
    /// The luminance of the radiance.
    pub luminance: f64,
    /// The mean radiance.
    pub mean: [f64; 3],
    /// The mean luminance.
    pub mean_luminance: f64,
    /// The estimated variance of the luminance. A single sample has none.
    pub variance: Option<f64>,
    /// The standard error of the mean luminance: σ / √n.
    pub standard_error: Option<f64>,
    /// The bad values in the sample, one sentence each.
    pub problems: Vec<String>,
}

/// Computes the history of a pixel.
pub fn history(samples: &[PathSample]) -> Vec<SampleRow> {
    let mut of_luminance = RunningMoments::default();
    let mut of_channels = [RunningMoments::default(); 3];
    let row = |sample: &PathSample| {
        let (radiance, problem) = match &sample.outcome {
            Ok(Ok(radiance)) => (*radiance, None),
            Ok(Err(InvalidSample::Hit)) => (
                Vec3::ZERO,
                Some("black because a hit is unusable".to_owned()),
            ),
            Ok(Err(InvalidSample::Radiance)) => {
                let text = "black because `radiance` returned NaN or infinity";
                (Vec3::ZERO, Some(text.to_owned()))
            }
            Err(Panic { message, location }) => (
                Vec3::ZERO,
                Some(format!("panicked: {message} ({location})")),
            ),
        };
        let bad_values = sample.bad_values.paths();
        let bad_values = bad_values.map(|bad| format!("{}, at bounce {}", bad.kind, bad.bounce));
        let luminance = f64::from(luminance(radiance));
        of_luminance.add(luminance);
        for (moments, value) in of_channels.iter_mut().zip(radiance.to_array()) {
            moments.add(value.into());
        }
        SampleRow {
            radiance,
            luminance,
            mean: of_channels.map(|moments| moments.mean),
            mean_luminance: of_luminance.mean,
            variance: of_luminance.variance(),
            standard_error: of_luminance.standard_error(),
            problems: problem.into_iter().chain(bad_values).collect(),
        }
    };
    samples.iter().map(row).collect()
}

/// The mean and variance of the numbers so far. See Welford, "Note on a Method for Calculating
/// Corrected Sums of Squares and Products", Technometrics 4(3), 1962: a sum of squares would lose
/// all digits of a small variance.
#[derive(Clone, Copy, Debug, Default)]
struct RunningMoments {
    count: u32,
    mean: f64,
    /// The sum of the squared differences from the mean.
    squares: f64,
}

impl RunningMoments {
    fn add(&mut self, value: f64) {
        self.count += 1;
        let from_old = value - self.mean;
        self.mean += from_old / f64::from(self.count);
        self.squares += from_old * (value - self.mean);
    }

    fn variance(&self) -> Option<f64> {
        (self.count > 1).then(|| self.squares / f64::from(self.count - 1))
    }

    fn standard_error(&self) -> Option<f64> {
        Some((self.variance()? / f64::from(self.count)).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use framework::render::path_steps::{BadPath, BadValue, FirstBadValues};
    use glam::UVec2;

    use super::*;

    #[test]
    fn the_running_mean_and_variance_are_those_of_the_samples_so_far() {
        // Far from zero, the squares have no digits left for the variance.
        let values = [2.0, 4.0, 4.0, 10.0].map(|value| 1e8 + value);
        let mut moments = RunningMoments::default();
        let of_each = values.map(|value| {
            moments.add(value);
            (moments.mean - 1e8, moments.variance())
        });
        let expected = [
            (2.0, None),
            (3.0, Some(2.0)),
            (10.0 / 3.0, Some(4.0 / 3.0)),
            (5.0, Some(12.0)),
        ];
        for ((mean, variance), (expected_mean, expected_variance)) in of_each.iter().zip(expected) {
            assert!((mean - expected_mean).abs() < 1e-6, "{of_each:?}");
            let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
            let is_equal = variance.zip(expected_variance).map(|(a, b)| near(a, b));
            assert_eq!(is_equal, expected_variance.map(|_| true), "{of_each:?}");
        }
        let error = moments.standard_error().unwrap();
        assert!((error - 3_f64.sqrt()).abs() < 1e-6, "{error}");
    }

    #[test]
    fn a_discarded_sample_counts_as_black_and_says_why() {
        let mut samples = [
            Ok(Vec3::splat(3.0)),
            Err(InvalidSample::Radiance),
            Err(InvalidSample::Hit),
        ]
        .map(|outcome| PathSample {
            outcome: Ok(outcome),
            bad_values: FirstBadValues::default(),
        });
        samples[1].bad_values.add(BadPath {
            kind: BadValue::PdfNegative,
            pixel: UVec2::ZERO,
            bounce: 2,
        });
        let rows = history(&samples);
        let means = rows.iter().map(|row| row.mean[1]);
        assert!(means.eq([3.0, 1.5, 1.0]));
        let problems: Vec<String> = rows.iter().map(|row| row.problems.join("; ")).collect();
        assert_eq!(
            problems,
            [
                "",
                "black because `radiance` returned NaN or infinity; a pdf is negative, at bounce 2",
                "black because a hit is unusable",
            ]
        );
    }
}
