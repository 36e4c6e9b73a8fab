//! The steps of one path, and what they say about each of its bounces.

use std::fmt;

use glam::{UVec2, Vec3};
use serde::{Deserialize, Serialize};

/// A question that the path tracer asked about the scene, and the answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// The path hits a surface.
    Hit {
        /// The name of the surface in a sentence, such as "a mirror".
        surface: &'static str,
        /// The position.
        position: Vec3,
        /// The radiance that the surface emits toward the start of the ray.
        emitted: Vec3,
    },
    /// The path hits nothing.
    Miss,
    /// The radiance of the environment.
    Environment {
        /// The radiance.
        radiance: Vec3,
        /// The direction that it comes from.
        direction: Vec3,
    },
    /// The radiance that reaches the surface straight from a light or the environment.
    Light {
        /// The radiance.
        radiance: Vec3,
        /// The direction that it comes from.
        direction: Vec3,
        /// Whether directions toward this light are sampled, so that its pdf isn't zero.
        is_sampled: bool,
    },
    /// The density with which directions toward the lights are sampled.
    LightPdf {
        /// The density.
        pdf: f32,
        /// The direction.
        direction: Vec3,
    },
    /// The surface scatters the path.
    Scatter {
        /// The direction, in the surface's frame.
        direction: Vec3,
        /// The attenuation.
        attenuation: Vec3,
        /// The density of the direction.
        pdf: Option<f32>,
    },
    /// The surface scatters nothing.
    Absorbed,
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Step::Hit {
                surface,
                position,
                emitted,
            } => write!(
                f,
                "hit: {surface} at {position:.4}, which emits {emitted:.4}"
            ),
            Step::Miss => f.write_str("no hit"),
            Step::Environment {
                radiance,
                direction,
            } => write!(f, "environment: {radiance:.4} from {direction:.4}"),
            Step::Light {
                radiance,
                direction,
                ..
            } => write!(f, "light: {radiance:.4} from {direction:.4}"),
            Step::LightPdf { pdf, direction } => {
                write!(f, "light pdf: {pdf:.4} toward {direction:.4}")
            }
            Step::Scatter {
                direction,
                attenuation,
                pdf,
            } => {
                let pdf = pdf.map_or("no pdf".to_owned(), |pdf| format!("pdf {pdf:.4}"));
                write!(
                    f,
                    "scatter: {direction:.4} in the surface's frame, attenuation {attenuation:.4}, {pdf}"
                )
            }
            Step::Absorbed => f.write_str("scatter: nothing"),
        }
    }
}

/// A point of a path: a surface that it hits, or the environment where it leaves the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounce {
    /// How many times the path has been scattered before.
    pub number: u32,
    /// The index of the first step at this point.
    pub first_step: u32,
    /// The name of the surface in a sentence, or "nothing".
    pub surface: String,
    /// The product of the attenuations of all earlier bounces. The path tracer's own throughput is
    /// also divided by the probabilities of Russian roulette, which are only known to its code.
    pub throughput: Vec3,
    /// The light that the path itself finds here: the light that the surface emits, or the
    /// environment.
    pub found: Vec3,
    /// Whether a correct path counts this light: if it comes from the camera, a mirror or glass.
    pub is_found_counted: bool,
    /// The light that reaches the surface from the directions that were sampled for direct light.
    pub lights: Vec<ArrivingLight>,
    /// The attenuation, if the surface scatters the path.
    pub attenuation: Option<Vec3>,
    /// The density of the scattered direction. Mirrors and glass have none.
    pub pdf: Option<f32>,
    /// The values that no correct code returns.
    pub bad_values: Vec<BadValue>,
}

/// Light that reaches a surface from a direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ArrivingLight {
    /// The radiance.
    pub radiance: Vec3,
    /// The density with which directions toward the lights are sampled, if the path tracer asked
    /// for it.
    pub pdf: Option<f32>,
}

/// A kind of value that no correct code returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BadValue {
    /// A density is NaN or infinite.
    PdfNotFinite,
    /// A density is negative.
    PdfNegative,
    /// The density of a scattered direction is zero.
    PdfZero,
    /// The density of a direction toward the lights is zero, but light arrives from there.
    LightPdfZero,
    /// An attenuation or a scattered direction is NaN or infinite.
    ScatteredNotFinite,
}

impl BadValue {
    /// The number of kinds.
    pub const COUNT: usize = 5;
}

impl fmt::Display for BadValue {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            BadValue::PdfNotFinite => "a pdf is NaN or infinite",
            BadValue::PdfNegative => "a pdf is negative",
            BadValue::PdfZero => "the path continues in a direction whose pdf is 0",
            BadValue::LightPdfZero => "light arrives from a direction whose light pdf is 0",
            BadValue::ScatteredNotFinite => {
                "an attenuation or a scattered direction is NaN or infinite"
            }
        })
    }
}

/// The first path with each kind of bad value, in the order of [`BadValue`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FirstBadValues([Option<BadPath>; BadValue::COUNT]);

/// A path with a bad value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BadPath {
    /// The kind of value.
    pub kind: BadValue,
    /// The pixel.
    pub pixel: UVec2,
    /// The number of the bounce.
    pub bounce: u32,
}

impl FirstBadValues {
    /// Adds the bad values of one path.
    pub fn add_path(&mut self, pixel: UVec2, steps: &[Step]) {
        for Bounce {
            number, bad_values, ..
        } in bounces(steps)
        {
            for kind in bad_values {
                self.add(BadPath {
                    kind,
                    pixel,
                    bounce: number,
                });
            }
        }
    }

    /// Adds a path, unless there already is one with the same kind of value.
    pub fn add(&mut self, path: BadPath) {
        self.0[path.kind as usize].get_or_insert(path);
    }

    /// Returns the paths.
    pub fn paths(&self) -> impl Iterator<Item = BadPath> {
        self.0.into_iter().flatten()
    }
}

/// Splits the steps of a path into its bounces.
pub fn bounces(steps: &[Step]) -> Vec<Bounce> {
    let mut bounces: Vec<Bounce> = Vec::new();
    let mut start = 0;
    for end in 1..=steps.len() {
        let is_next = matches!(steps.get(end), None | Some(Step::Hit { .. } | Step::Miss));
        if is_next {
            bounces.push(bounce(start, &steps[start..end], bounces.last()));
            start = end;
        }
    }
    bounces
}

/// Returns what these steps say about one bounce.
fn bounce(first_step: usize, steps: &[Step], before: Option<&Bounce>) -> Bounce {
    let attenuation = before.and_then(|before| before.attenuation);
    let mut bounce = Bounce {
        number: before.map_or(0, |before| before.number + u32::from(attenuation.is_some())),
        first_step: u32::try_from(first_step).unwrap_or(u32::MAX),
        surface: "nothing".to_owned(),
        throughput: before.map_or(Vec3::ONE, |before| {
            before.throughput * attenuation.unwrap_or(Vec3::ONE)
        }),
        found: Vec3::ZERO,
        is_found_counted: before.is_none_or(|before| before.pdf.is_none()),
        lights: Vec::new(),
        attenuation: None,
        pdf: None,
        bad_values: Vec::new(),
    };
    for step in steps {
        match *step {
            Step::Hit {
                surface, emitted, ..
            } => {
                bounce.surface = surface.to_owned();
                bounce.found = emitted;
            }
            Step::Environment { radiance, .. } => bounce.found = radiance,
            Step::Light {
                radiance,
                direction,
                ..
            } => {
                let pdf = light_pdf(steps, direction);
                bounce.lights.push(ArrivingLight { radiance, pdf });
            }
            Step::Scatter {
                attenuation, pdf, ..
            } => {
                bounce.attenuation = Some(attenuation);
                bounce.pdf = pdf;
            }
            Step::LightPdf { .. } | Step::Miss | Step::Absorbed => {}
        }
        if let Some(bad) = bad_value(step, steps)
            && !bounce.bad_values.contains(&bad)
        {
            bounce.bad_values.push(bad);
        }
    }
    bounce
}

/// Returns the density of a direction toward the lights, if these steps contain it.
fn light_pdf(steps: &[Step], toward: Vec3) -> Option<f32> {
    steps.iter().find_map(|step| match *step {
        Step::LightPdf { pdf, direction } if direction == toward => Some(pdf),
        _ => None,
    })
}

fn bad_value(step: &Step, steps: &[Step]) -> Option<BadValue> {
    let of_pdf = |pdf: f32| match pdf {
        pdf if !pdf.is_finite() => Some(BadValue::PdfNotFinite),
        pdf if pdf < 0.0 => Some(BadValue::PdfNegative),
        _ => None,
    };
    match *step {
        Step::LightPdf { pdf, .. } => of_pdf(pdf),
        Step::Light {
            radiance,
            direction,
            is_sampled: true,
        } if radiance != Vec3::ZERO && light_pdf(steps, direction) == Some(0.0) => {
            Some(BadValue::LightPdfZero)
        }
        Step::Scatter {
            direction,
            attenuation,
            pdf,
        } => {
            if !direction.is_finite() || !attenuation.is_finite() {
                return Some(BadValue::ScatteredNotFinite);
            }
            let is_zero = pdf == Some(0.0) && attenuation != Vec3::ZERO;
            pdf.and_then(of_pdf)
                .or(is_zero.then_some(BadValue::PdfZero))
        }
        Step::Hit { .. }
        | Step::Miss
        | Step::Environment { .. }
        | Step::Light { .. }
        | Step::Absorbed => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HIT: Step = Step::Hit {
        surface: "a wall",
        position: Vec3::ZERO,
        emitted: Vec3::ZERO,
    };

    fn scatter(attenuation: f32, pdf: Option<f32>) -> Step {
        Step::Scatter {
            direction: Vec3::Z,
            attenuation: Vec3::splat(attenuation),
            pdf,
        }
    }

    #[test]
    fn the_throughput_is_the_product_of_the_attenuations_before() {
        let steps = [
            HIT,
            scatter(0.5, Some(0.3)),
            HIT,
            scatter(0.25, None),
            Step::Miss,
            Step::Environment {
                radiance: Vec3::ONE,
                direction: Vec3::Y,
            },
        ];
        let bounces = bounces(&steps);
        let throughputs: Vec<f32> = bounces.iter().map(|bounce| bounce.throughput.x).collect();
        assert_eq!(throughputs, [1.0, 0.5, 0.125]);
        let first: Vec<u32> = bounces.iter().map(|bounce| bounce.first_step).collect();
        assert_eq!(first, [0, 2, 4]);
        let counted: Vec<bool> = bounces.iter().map(|it| it.is_found_counted).collect();
        assert_eq!(counted, [true, false, true]);
        assert_eq!((bounces[2].number, bounces[2].found), (2, Vec3::ONE));
        assert!(bounces.iter().all(|bounce| bounce.bad_values.is_empty()));
    }

    #[test]
    fn each_kind_of_bad_value_is_found() {
        let light = |pdf, is_sampled| {
            let direction = Vec3::Y;
            let radiance = Vec3::ONE;
            [
                Step::Light {
                    radiance,
                    direction,
                    is_sampled,
                },
                Step::LightPdf { pdf, direction },
            ]
        };
        for (steps, expected) in [
            (vec![scatter(0.5, Some(-0.1))], Some(BadValue::PdfNegative)),
            (
                vec![scatter(0.5, Some(f32::NAN))],
                Some(BadValue::PdfNotFinite),
            ),
            (vec![scatter(0.5, Some(0.0))], Some(BadValue::PdfZero)),
            (vec![scatter(0.0, Some(0.0))], None),
            (
                vec![scatter(f32::NAN, None)],
                Some(BadValue::ScatteredNotFinite),
            ),
            (light(0.0, true).to_vec(), Some(BadValue::LightPdfZero)),
            // Directions to a uniform sky are never sampled.
            (light(0.0, false).to_vec(), None),
            (light(2.0, true).to_vec(), None),
            (light(-2.0, true).to_vec(), Some(BadValue::PdfNegative)),
        ] {
            let steps = [vec![HIT], steps].concat();
            let found = bounces(&steps)[0].bad_values.clone();
            assert_eq!(found, Vec::from_iter(expected), "{steps:?}");
            let mut first = FirstBadValues::default();
            for x in [3, 4] {
                first.add_path(UVec2::new(x, 0), &steps);
            }
            let paths = first.paths().map(|path| (path.kind, path.pixel.x));
            assert!(paths.eq(expected.map(|kind| (kind, 3))));
        }
    }
}
