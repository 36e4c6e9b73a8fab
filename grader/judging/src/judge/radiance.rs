//! Compares rendered pictures with the key. Both use common random numbers: the framework draws its
//! random numbers from the same stream that was used to record the key, so no tolerance for noise
//! is needed.

use std::iter;

use glam::Vec3;
use protocol::ElementOutcome;

use crate::describe;
use crate::judge::{
    Aspect, Comparison, Credit, Deviation, Failure, FailureKind, Judgement, Measurement, Position,
    Threshold, deviation,
};
use crate::symptom::Side;
use crate::types::in_units_of;

/// A pixel is wrong if a channel differs by more than this fraction of the brightest channel of the
/// expected pixel.
pub(super) const RELATIVE_TOLERANCE: f32 = 0.01;
/// Minimum brightness for computing a tolerance. For darker pixels, this brightness is used
/// instead.
const MIN_BRIGHTNESS: f32 = 0.01;

/// A rendered picture and its key.
pub(super) struct Radiance<'a> {
    pub(super) pixels: &'a [Vec3],
    pub(super) max_wrong_pixels: u32,
    pub(super) answer: &'a ElementOutcome<Vec<Vec3>>,
}

impl Comparison for Radiance<'_> {
    fn judge(&self) -> Judgement {
        judge(self.pixels, self.max_wrong_pixels, self.answer)
    }

    fn measure(&self) -> Vec<Measurement> {
        let Some(pixels) = self.deviations() else {
            return deviation::worst_by_threshold([Deviation::WRONG]);
        };
        vec![Measurement::of_positions(
            pixels.collect(),
            self.max_wrong_pixels as usize,
            Threshold::RadiancePixels,
        )]
    }

    fn positions(&self) -> Option<Vec<Position>> {
        let pixels = self.deviations()?;
        let position = |pixel| Some(iter::once((Aspect::Radiance, pixel)).collect());
        Some(pixels.map(position).collect())
    }
}

impl Radiance<'_> {
    /// Returns the deviation of each pixel, or `None` if the number of pixels differs from the
    /// key's.
    fn deviations(&self) -> Option<impl Iterator<Item = Deviation>> {
        let got = self.answer.value()?;
        let pixels = got.iter().zip(self.pixels);
        let deviations = pixels.map(|(got, wanted)| pixel_deviation(*got, *wanted));
        (got.len() == self.pixels.len()).then_some(deviations)
    }
}

fn judge(pixels: &[Vec3], allowed: u32, answer: &ElementOutcome<Vec<Vec3>>) -> Judgement {
    let fail = |element, kind, count| {
        Judgement::wrong(Failure {
            element,
            kind,
            count,
        })
    };
    let got = match answer {
        ElementOutcome::Value(got) => got,
        ElementOutcome::Panicked(panic) => {
            return fail(0, FailureKind::Panicked(panic.clone()), None);
        }
        ElementOutcome::Skipped => return Judgement::protocol("skipped"),
    };
    if got.len() != pixels.len() {
        return Judgement::protocol("the number of pixels differs from the number asked for");
    }
    let off: Vec<usize> = (0..pixels.len())
        .filter(|&i| !pixel_deviation(got[i], pixels[i]).is_right())
        .collect();
    if off.len() <= allowed as usize {
        return Judgement::RIGHT;
    }
    let kind = FailureKind::Wrong {
        what: "radiance".to_owned(),
        side: got[off[0]].is_nan().then_some(Side::NotANumber),
        got: describe::point(got[off[0]]),
        wanted: describe::point(pixels[off[0]]),
    };
    let judgement = fail(off[0], kind, Some((off.len(), pixels.len())));
    Judgement {
        credit: if off.len() * 20 <= pixels.len() {
            Credit::HALF
        } else {
            Credit::NONE
        },
        ..judgement
    }
}

fn pixel_deviation(got: Vec3, wanted: Vec3) -> Deviation {
    let limit = RELATIVE_TOLERANCE * wanted.max_element().max(MIN_BRIGHTNESS);
    // Each channel is measured separately, because `f32::max` ignores NaN.
    let errors = (got - wanted).abs().to_array();
    let errors = errors.map(|error| in_units_of(limit.into(), error.into()));
    Deviation::new(Threshold::Radiance, errors.into_iter().fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture_with(n: usize, wrong: Vec3) -> ElementOutcome<Vec<Vec3>> {
        let mut pixels = vec![Vec3::ONE; 100];
        pixels[..n].fill(wrong);
        ElementOutcome::Value(pixels)
    }

    #[test]
    fn few_wrong_pixels_are_free_and_more_cost_half() {
        let key = vec![Vec3::ONE; 100];
        let credit = |n| judge(&key, 2, &picture_with(n, Vec3::ZERO)).credit;
        assert_eq!(credit(2), Credit::FULL);
        assert_eq!(credit(3), Credit::HALF);
        assert_eq!(credit(6), Credit::NONE);
    }

    #[test]
    fn one_percent_is_tolerated_and_nan_is_not() {
        let key = vec![Vec3::ONE; 100];
        let credit = |wrong| judge(&key, 2, &picture_with(100, wrong)).credit;
        assert_eq!(credit(Vec3::splat(1.009)), Credit::FULL);
        assert_eq!(credit(Vec3::new(1.0, 1.0, f32::NAN)), Credit::NONE);
        assert_eq!(credit(Vec3::splat(f32::INFINITY)), Credit::NONE);
    }

    #[test]
    fn the_least_brightness_is_tolerated_in_the_dark() {
        let key = vec![Vec3::ZERO; 100];
        let credit = |wrong| judge(&key, 2, &picture_with(100, Vec3::splat(wrong))).credit;
        let limit = RELATIVE_TOLERANCE * MIN_BRIGHTNESS;
        assert_eq!(credit(0.9 * limit), Credit::FULL);
        assert_eq!(credit(1.1 * limit), Credit::NONE);
    }
}
