//! The path-traced picture, paired: the framework drew every random number from the same stream
//! as when the key was recorded, so no noise has to be forgiven.

use glam::Vec3;
use protocol::Outcome;

use crate::describe;
use crate::judge::measure::in_units_of;
use crate::judge::{
    Aspect, Blemish, Comparison, Deviation, Failure, How, Judgement, Measured, Share, Threshold,
    deviation,
};

/// A pixel is off if a channel differs by more than this part of its brightest channel.
pub(super) const RELATIVE: f32 = 0.01;
/// What is darker than this is compared as if it were this bright.
const DARKEST: f32 = 0.01;

/// A path-traced picture.
pub(super) struct Radiance<'a> {
    pub(super) pixels: &'a [Vec3],
    pub(super) allowed: u32,
    pub(super) answer: &'a Outcome<Vec<Vec3>>,
}

impl Comparison for Radiance<'_> {
    fn judge(&self) -> Judgement {
        judge(self.pixels, self.allowed, self.answer)
    }

    fn measure(&self) -> Vec<Measured> {
        match self.answer {
            Outcome::Value(got) if got.len() == self.pixels.len() => {
                let pixels = got.iter().zip(self.pixels);
                let places = pixels.map(|(got, wanted)| pixel(*got, *wanted)).collect();
                let allowed = self.allowed as usize;
                vec![Measured::counted(
                    places,
                    allowed,
                    Threshold::RadiancePixels,
                )]
            }
            Outcome::Value(_) | Outcome::Panicked(_) | Outcome::GivenUp => {
                deviation::worst([Deviation::WRONG])
            }
        }
    }

    fn blemishes(&self) -> Option<Vec<Option<Blemish>>> {
        let got = match self.answer {
            Outcome::Value(got) => got,
            Outcome::Panicked(_) | Outcome::GivenUp => return None,
        };
        let blemish = |(got, wanted): (&Vec3, &Vec3)| {
            let off = pixel(*got, *wanted);
            (!off.is_right()).then_some(Blemish {
                aspect: Aspect::Radiance,
                off: off.value,
            })
        };
        let is_whole = got.len() == self.pixels.len();
        is_whole.then(|| got.iter().zip(self.pixels).map(blemish).collect())
    }
}

fn judge(pixels: &[Vec3], allowed: u32, answer: &Outcome<Vec<Vec3>>) -> Judgement {
    let fail = |element, how, count| {
        Judgement::wrong(Failure {
            element,
            how,
            count,
        })
    };
    let got = match answer {
        Outcome::Value(got) => got,
        Outcome::Panicked(panic) => return fail(0, How::Panicked(panic.clone()), None),
        Outcome::GivenUp => return Judgement::protocol("given up"),
    };
    if got.len() != pixels.len() {
        return Judgement::protocol("another number of pixels than asked for");
    }
    let off: Vec<usize> = (0..pixels.len())
        .filter(|&i| !pixel(got[i], pixels[i]).is_right())
        .collect();
    if off.len() <= allowed as usize {
        return Judgement::RIGHT;
    }
    let how = How::Wrong {
        what: "radiance".to_owned(),
        got: describe::point(got[off[0]]),
        wanted: describe::point(pixels[off[0]]),
    };
    let judgement = fail(off[0], how, Some((off.len(), pixels.len())));
    Judgement {
        share: if off.len() * 20 <= pixels.len() {
            Share::HALF
        } else {
            Share::NONE
        },
        ..judgement
    }
}

fn pixel(got: Vec3, wanted: Vec3) -> Deviation {
    let limit = RELATIVE * wanted.max_element().max(DARKEST);
    // Each by itself: the largest of numbers with a NaN among them may be a number.
    let errors = (got - wanted).abs().to_array();
    let errors = errors.map(|error| in_units_of(limit.into(), error.into()));
    Deviation::of(Threshold::Radiance, errors.into_iter().fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(n: usize, wrong: Vec3) -> Outcome<Vec<Vec3>> {
        let mut pixels = vec![Vec3::ONE; 100];
        pixels[..n].fill(wrong);
        Outcome::Value(pixels)
    }

    #[test]
    fn a_few_pixels_may_be_off_and_some_more_cost_half() {
        let key = vec![Vec3::ONE; 100];
        let share = |n| judge(&key, 2, &with(n, Vec3::ZERO)).share;
        assert_eq!(share(2), Share::ALL);
        assert_eq!(share(3), Share::HALF);
        assert_eq!(share(6), Share::NONE);
    }

    #[test]
    fn one_percent_is_forgiven_and_nan_is_not() {
        let key = vec![Vec3::ONE; 100];
        let share = |wrong| judge(&key, 2, &with(100, wrong)).share;
        assert_eq!(share(Vec3::splat(1.009)), Share::ALL);
        assert_eq!(share(Vec3::new(1.0, 1.0, f32::NAN)), Share::NONE);
        assert_eq!(share(Vec3::splat(f32::INFINITY)), Share::NONE);
    }
}
