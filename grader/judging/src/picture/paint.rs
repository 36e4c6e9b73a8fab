//! Paints depths, normals, texture coordinates, directions and radiance as colours.

use glam::{Vec2, Vec3};
use protocol::{Answer, ElementOutcome, Ray, Trace};

use crate::exam::{ExamQuestion, ExpectedRows, Key, Surface};
use crate::judge::{Aspect, Mismatch};

/// An sRGB colour.
pub type Colour = [u8; 3];

/// Colour of a ray that hits nothing.
const MISS_COLOUR: Vec3 = Vec3::new(0.13, 0.13, 0.16);
/// Colour of a missing answer, or of NaN and infinity. No valid value has this colour.
const INVALID_COLOUR: Vec3 = Vec3::new(1.0, 0.0, 1.0);
/// Factor by which differences are amplified.
pub(super) const DIFFERENCE_GAIN: f32 = 4.0;

/// A comparison of the expected and the submitted picture in one quantity, such as depth. The
/// colour of a pixel is the mean over its sample positions.
#[derive(Clone, Debug)]
pub struct LayerComparison {
    /// Human-readable name.
    pub name: &'static str,
    /// The expected picture.
    pub wanted: Vec<Colour>,
    /// The submitted picture.
    pub got: Vec<Colour>,
    /// The difference between the two, amplified four times. It is black where the judge found no
    /// error.
    pub difference: Vec<Colour>,
}

/// A submitted picture of one quantity, such as depth.
#[derive(Clone, Debug)]
pub struct Layer {
    /// Human-readable name.
    pub name: &'static str,
    /// The colour of each pixel, which is the mean over its positions.
    pub pixels: Vec<Colour>,
}

impl Layer {
    fn new(name: &'static str, pixels: Vec<Colour>) -> Self {
        Layer { name, pixels }
    }
}

/// The expected and the submitted picture of one quantity, with a colour for each sample position.
struct LayerSamples {
    name: &'static str,
    wanted: Vec<Vec3>,
    got: Vec<Vec3>,
}

/// Returns all layers of a picture. The one that shows the most serious error comes first.
pub(super) fn compare_layers(
    question: &ExamQuestion,
    answer: &Answer,
    mismatches: &[Option<Mismatch>],
    per_pixel: usize,
) -> Option<Vec<LayerComparison>> {
    let mut layers = match (&question.key, answer) {
        (Key::FirstHits { hits, .. }, Answer::Hits(got)) => first_hits(hits, got),
        (
            Key::Table {
                rows: ExpectedRows::Rays(directions),
                ..
            },
            Answer::Rays(rays),
        ) => vec![LayerSamples {
            name: "direction",
            wanted: directions.iter().map(|dir| signed_colour(*dir)).collect(),
            got: rays
                .iter()
                .map(|ray| paint_outcome(ray, |ray| signed_colour(ray.dir)))
                .collect(),
        }],
        (Key::Radiance { pixels, .. }, Answer::Picture(ElementOutcome::Value(got))) => {
            vec![LayerSamples {
                name: "light",
                wanted: pixels.iter().map(|pixel| srgb(*pixel)).collect(),
                got: got.iter().map(|pixel| srgb(*pixel)).collect(),
            }]
        }
        (
            Key::Table { .. } | Key::Tree { .. } | Key::FirstHits { .. } | Key::Radiance { .. },
            _,
        ) => return None,
    };
    let most_serious = mismatches
        .iter()
        .flatten()
        .map(|mismatch| mismatch.aspect)
        .min();
    let shown = most_serious.map_or("normal", layer_showing);
    layers.sort_by_key(|layer| layer.name != shown);
    let view = |layer: &LayerSamples| compare_layer(layer, mismatches, per_pixel);
    Some(layers.iter().map(view).collect())
}

/// Returns the submitted layers, painted as [`compare_layers`] paints a picture without errors.
pub(super) fn submitted_layers(
    question: &ExamQuestion,
    answer: &Answer,
    per_pixel: usize,
) -> Option<Vec<Layer>> {
    Some(match (&question.key, answer) {
        (Key::FirstHits { hits, .. }, Answer::Hits(got)) => {
            let grey = depth_greys(hits);
            let paint = |colour: &dyn Fn(&Trace) -> Vec3| {
                let hit = |hit: &Option<Trace>| hit.as_ref().map_or(MISS_COLOUR, colour);
                means(got, per_pixel, |outcome| paint_outcome(outcome, hit))
            };
            vec![
                Layer::new("normal", paint(&|hit| signed_colour(hit.normal))),
                Layer::new("depth", paint(&|hit| grey(hit.distance))),
                Layer::new("uv", paint(&|hit| uv_colour(hit.uv))),
            ]
        }
        (Key::Table { .. }, Answer::Rays(rays)) => {
            let direction =
                |ray: &ElementOutcome<Ray>| paint_outcome(ray, |ray| signed_colour(ray.dir));
            vec![Layer::new("direction", means(rays, per_pixel, direction))]
        }
        (Key::Radiance { .. }, Answer::Picture(ElementOutcome::Value(got))) => {
            vec![Layer::new(
                "light",
                means(got, per_pixel, |pixel| srgb(*pixel)),
            )]
        }
        (
            Key::Table { .. } | Key::Tree { .. } | Key::FirstHits { .. } | Key::Radiance { .. },
            _,
        ) => return None,
    })
}

/// Returns whether a surface is visible at each position of the expected picture.
pub(super) fn has_surface(question: &ExamQuestion) -> Vec<bool> {
    match &question.key {
        Key::FirstHits { hits, .. } => hits.iter().map(Option::is_some).collect(),
        Key::Table { rows, .. } => (0..rows.count()).map(|row| rows.is_present(row)).collect(),
        Key::Radiance { pixels, .. } => vec![true; pixels.len()],
        Key::Tree { .. } => Vec::new(),
    }
}

/// Returns the name of the layer that shows errors of this aspect.
fn layer_showing(aspect: Aspect) -> &'static str {
    match aspect {
        Aspect::NoAnswer | Aspect::HitOrMiss | Aspect::Normal => "normal",
        Aspect::Depth => "depth",
        Aspect::Uv => "uv",
        Aspect::Direction => "direction",
        Aspect::Radiance => "light",
    }
}

fn first_hits(
    hits: &[Option<Surface>],
    got: &[ElementOutcome<Option<Trace>>],
) -> Vec<LayerSamples> {
    let grey = depth_greys(hits);
    let layer =
        |name, of_key: &dyn Fn(&Surface) -> Vec3, of_got: &dyn Fn(&Trace) -> Vec3| LayerSamples {
            name,
            wanted: hits
                .iter()
                .map(|hit| hit.as_ref().map_or(MISS_COLOUR, of_key))
                .collect(),
            got: got
                .iter()
                .map(|outcome| {
                    paint_outcome(outcome, |hit| hit.as_ref().map_or(MISS_COLOUR, of_got))
                })
                .collect(),
        };
    vec![
        layer("normal", &|hit| signed_colour(hit.normal), &|hit| {
            signed_colour(hit.normal)
        }),
        layer("depth", &|hit| grey(hit.depth), &|hit| grey(hit.distance)),
        layer("uv", &|hit| uv_colour(hit.uv), &|hit| uv_colour(hit.uv)),
    ]
}

/// Returns a function from depth to grey, where the nearest depth is white.
fn depth_greys(hits: &[Option<Surface>]) -> impl Fn(f32) -> Vec3 {
    let depths = hits.iter().flatten().map(|surface| surface.depth);
    let (near, far) = depths.fold((f32::INFINITY, 0.0), |(near, far), depth| {
        (depth.min(near), depth.max(far))
    });
    move |depth: f32| {
        valid_colour(Vec3::splat(
            1.0 - 0.8 * (depth - near) / (far - near).max(1e-6),
        ))
    }
}

fn paint_outcome<T>(outcome: &ElementOutcome<T>, paint: impl Fn(&T) -> Vec3) -> Vec3 {
    match outcome {
        ElementOutcome::Value(value) => paint(value),
        ElementOutcome::Panicked(_) | ElementOutcome::Skipped => INVALID_COLOUR,
    }
}

/// Returns the colour of a vector whose components are between -1 and 1.
fn signed_colour(vector: Vec3) -> Vec3 {
    valid_colour(vector * 0.5 + 0.5)
}

fn uv_colour(uv: Vec2) -> Vec3 {
    valid_colour(Vec3::new(uv.x, uv.y, 0.35))
}

/// Converts linear light to sRGB (IEC 61966-2-1).
fn srgb(light: Vec3) -> Vec3 {
    let channel = |light: f32| match light {
        _ if light <= 0.003_130_8 => 12.92 * light,
        _ => 1.055 * light.powf(1.0 / 2.4) - 0.055,
    };
    valid_colour(Vec3::from(valid_colour(light).to_array().map(channel)))
}

fn valid_colour(colour: Vec3) -> Vec3 {
    if colour.is_finite() {
        colour.clamp(Vec3::ZERO, Vec3::ONE)
    } else {
        INVALID_COLOUR
    }
}

fn compare_layer(
    layer: &LayerSamples,
    mismatches: &[Option<Mismatch>],
    per_pixel: usize,
) -> LayerComparison {
    let differences = layer.wanted.iter().zip(&layer.got).zip(mismatches);
    let differences: Vec<Vec3> = differences
        .map(|((wanted, got), mismatch)| match mismatch {
            // At an edge, an answer that differs from the expected one may also be correct.
            None => Vec3::ZERO,
            Some(_) => ((*got - *wanted).abs() * DIFFERENCE_GAIN).min(Vec3::ONE),
        })
        .collect();
    LayerComparison {
        name: layer.name,
        wanted: pixels(&layer.wanted, per_pixel),
        got: pixels(&layer.got, per_pixel),
        difference: pixels(&differences, per_pixel),
    }
}

fn pixels(positions: &[Vec3], per_pixel: usize) -> Vec<Colour> {
    means(positions, per_pixel, |colour| *colour)
}

/// Returns the mean colour of each pixel over its positions.
fn means<T>(positions: &[T], per_pixel: usize, paint: impl Fn(&T) -> Vec3) -> Vec<Colour> {
    let mean = |pixel: &[T]| pixel.iter().map(&paint).sum::<Vec3>() / per_pixel as f32;
    let bytes = |colour: Vec3| {
        colour
            .to_array()
            .map(|channel| (channel * 255.0).round() as u8)
    };
    positions
        .chunks(per_pixel)
        .map(|pixel| bytes(mean(pixel)))
        .collect()
}
