//! Paints depths, normals, texture coordinates, directions and radiance as colours.

use glam::{Vec2, Vec3};
use protocol::{Answer, ElementOutcome, Ray, Trace};

use crate::exam::{ExamQuestion, ExpectedRows, Key, Surface};
use crate::judge::{Aspect, Mismatch};

/// An sRGB colour.
pub type Colour = [u8; 3];

/// Colour for rays that hit nothing.
const MISS_COLOUR: Vec3 = Vec3::new(0.13, 0.13, 0.16);
/// Colour for missing answers, NaN and infinity. No valid value has this colour.
const INVALID_COLOUR: Vec3 = Vec3::new(1.0, 0.0, 1.0);
/// Amplification of differences.
pub(super) const DIFFERENCE_GAIN: f32 = 4.0;

/// A comparison of the expected and the submitted picture for one quantity, such as depth. A
/// pixel's colour is the mean over its sample positions.
#[derive(Clone, Debug)]
pub struct LayerComparison {
    /// Human-readable name.
    pub name: &'static str,
    /// The expected picture.
    pub wanted: Vec<Colour>,
    /// The submitted picture.
    pub got: Vec<Colour>,
    /// The difference between the expected and the submitted picture, amplified by a factor of
    /// four. It is black where the judge found no error.
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

/// A picture of one quantity, with a colour for each sample position.
struct LayerSamples {
    name: &'static str,
    colours: Vec<Vec3>,
}

/// Returns all layers of a picture, starting with the one that shows the most serious error.
pub(super) fn compare_layers(
    question: &ExamQuestion,
    answer: &Answer,
    mismatches: &[Option<Mismatch>],
    per_pixel: usize,
) -> Option<Vec<LayerComparison>> {
    let pairs = wanted_layers(&question.key).into_iter();
    let mut pairs: Vec<_> = pairs.zip(got_layers(&question.key, answer)?).collect();
    let most_serious = mismatches
        .iter()
        .flatten()
        .map(|mismatch| mismatch.aspect)
        .min();
    let shown = most_serious.map_or("normal", layer_showing);
    pairs.sort_by_key(|(wanted, _)| wanted.name != shown);
    let pairs = pairs.iter();
    Some(
        pairs
            .map(|(wanted, got)| compare_layer(wanted, got, mismatches, per_pixel))
            .collect(),
    )
}

/// Returns the submitted layers, painted as [`compare_layers`] paints a picture without errors.
pub(super) fn submitted_layers(
    question: &ExamQuestion,
    answer: &Answer,
    per_pixel: usize,
) -> Option<Vec<Layer>> {
    let layers = got_layers(&question.key, answer)?.into_iter();
    let layer = |LayerSamples { name, colours }| Layer {
        name,
        pixels: pixels(&colours, per_pixel),
    };
    Some(layers.map(layer).collect())
}

/// Paints the expected picture, if any.
fn wanted_layers(key: &Key) -> Vec<LayerSamples> {
    match key {
        Key::FirstHits { hits, .. } => hit_layers(hits, hits.iter().copied().map(Some)),
        Key::Table {
            rows: ExpectedRows::Rays(directions),
            ..
        } => one_layer(
            "direction",
            directions.iter().map(|dir| signed_colour(*dir)),
        ),
        Key::Radiance { pixels, .. } => one_layer("light", pixels.iter().map(|it| srgb(*it))),
        Key::Table { .. } | Key::Tree { .. } | Key::SpreadEvenly { .. } => Vec::new(),
    }
}

/// Paints the submitted picture. Returns `None` if the answer isn't a picture.
fn got_layers(key: &Key, answer: &Answer) -> Option<Vec<LayerSamples>> {
    Some(match (key, answer) {
        (Key::FirstHits { hits, .. }, Answer::Hits(got)) => {
            let surface = |hit: &Option<Trace>| hit.as_ref().map(Surface::from);
            let got = got.iter().map(|outcome| outcome.value().map(surface));
            hit_layers(hits, got)
        }
        (Key::Table { .. }, Answer::Rays(rays)) => {
            let colour = |ray: &Ray| signed_colour(ray.dir);
            let rays = rays.iter().map(ElementOutcome::value);
            one_layer(
                "direction",
                rays.map(|ray| ray.map_or(INVALID_COLOUR, colour)),
            )
        }
        (Key::Radiance { .. }, Answer::Picture(ElementOutcome::Value(got))) => {
            one_layer("light", got.iter().map(|pixel| srgb(*pixel)))
        }
        (
            Key::Table { .. }
            | Key::Tree { .. }
            | Key::FirstHits { .. }
            | Key::Radiance { .. }
            | Key::SpreadEvenly { .. },
            _,
        ) => return None,
    })
}

fn one_layer(name: &'static str, colours: impl Iterator<Item = Vec3>) -> Vec<LayerSamples> {
    let colours = colours.collect();
    vec![LayerSamples { name, colours }]
}

/// Returns whether a surface is visible at each position of the expected picture.
pub(super) fn has_surface(question: &ExamQuestion) -> Vec<bool> {
    match &question.key {
        Key::FirstHits { hits, .. } => hits.iter().map(Option::is_some).collect(),
        Key::Table { rows, .. } => (0..rows.count()).map(|row| rows.is_present(row)).collect(),
        Key::Radiance { pixels, .. } => vec![true; pixels.len()],
        Key::Tree { .. } | Key::SpreadEvenly { .. } => Vec::new(),
    }
}

/// Returns the name of the layer that shows errors in this aspect.
fn layer_showing(aspect: Aspect) -> &'static str {
    match aspect {
        Aspect::NoAnswer | Aspect::HitOrMiss | Aspect::Normal => "normal",
        Aspect::Depth => "depth",
        Aspect::Uv => "uv",
        Aspect::Direction => "direction",
        Aspect::Radiance => "light",
    }
}

/// Paints first hits. `None` stands for a missing answer. The scale for depths is computed from the
/// expected hits, `of_key`.
fn hit_layers(
    of_key: &[Option<Surface>],
    hits: impl Iterator<Item = Option<Option<Surface>>>,
) -> Vec<LayerSamples> {
    let grey = depth_greys(of_key);
    let hits: Vec<Option<Option<Surface>>> = hits.collect();
    let layer = |name, colour: &dyn Fn(Surface) -> Vec3| {
        let colours = hits.iter().map(|hit| match hit {
            None => INVALID_COLOUR,
            Some(hit) => hit.map_or(MISS_COLOUR, colour),
        });
        LayerSamples {
            name,
            colours: colours.collect(),
        }
    };
    vec![
        layer("normal", &|hit| signed_colour(hit.normal)),
        layer("depth", &|hit| grey(hit.depth)),
        layer("uv", &|hit| uv_colour(hit.uv)),
    ]
}

/// Returns a function that maps depths to shades of grey. The nearest depth is white.
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
    wanted: &LayerSamples,
    got: &LayerSamples,
    mismatches: &[Option<Mismatch>],
    per_pixel: usize,
) -> LayerComparison {
    let differences = wanted.colours.iter().zip(&got.colours).zip(mismatches);
    let differences: Vec<Vec3> = differences
        .map(|((wanted, got), mismatch)| match mismatch {
            // At an edge, an answer can differ from the expected one and still be correct.
            None => Vec3::ZERO,
            Some(_) => ((*got - *wanted).abs() * DIFFERENCE_GAIN).min(Vec3::ONE),
        })
        .collect();
    LayerComparison {
        name: wanted.name,
        wanted: pixels(&wanted.colours, per_pixel),
        got: pixels(&got.colours, per_pixel),
        difference: pixels(&differences, per_pixel),
    }
}

/// Returns the mean colour of each pixel over its positions.
fn pixels(positions: &[Vec3], per_pixel: usize) -> Vec<Colour> {
    let mean = |pixel: &[Vec3]| pixel.iter().sum::<Vec3>() / per_pixel as f32;
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
