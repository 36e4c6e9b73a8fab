//! Colours for what can not be seen by itself: depths, normals, texture coordinates, directions.

use glam::{Vec2, Vec3};
use protocol::{Answer, Outcome, Ray, Trace};

use crate::exam::{Asked, Key, Surface};
use crate::judge::{Aspect, Blemish};

/// Red, green and blue, ready for a screen.
pub type Colour = [u8; 3];

/// Where nothing is hit.
const NOTHING: Vec3 = Vec3::new(0.13, 0.13, 0.16);
/// Where there is no answer, or none of numbers. No quantity has this colour.
const NO_NUMBER: Vec3 = Vec3::new(1.0, 0.0, 1.0);
/// So much stronger than it is, a difference is painted.
pub(super) const STRONGER: f32 = 4.0;

/// One quantity, a colour for each pixel: the mean over its positions.
#[derive(Clone, Debug)]
pub struct View {
    /// What people call it.
    pub name: &'static str,
    /// What is right.
    pub wanted: Vec<Colour>,
    /// What came.
    pub got: Vec<Colour>,
    /// How far apart the two are, four times as strong; black where the judge found nothing wrong.
    pub difference: Vec<Colour>,
}

/// One quantity of what came alone.
#[derive(Clone, Debug)]
pub struct Plate {
    /// What people call it.
    pub name: &'static str,
    /// A colour for each pixel, the mean over its positions.
    pub pixels: Vec<Colour>,
}

impl Plate {
    fn of(name: &'static str, pixels: Vec<Colour>) -> Self {
        Plate { name, pixels }
    }
}

/// One quantity, a colour for each position.
struct Layer {
    name: &'static str,
    wanted: Vec<Vec3>,
    got: Vec<Vec3>,
}

/// All views of a picture, the one that shows the gravest fault first.
pub(super) fn views(
    asked: &Asked,
    answer: &Answer,
    blemishes: &[Option<Blemish>],
    per_pixel: usize,
) -> Option<Vec<View>> {
    let mut layers = match (&asked.key, answer) {
        (Key::FirstHits { hits, .. }, Answer::Hits(got)) => first_hits(hits, got),
        (Key::Rays { directions, .. }, Answer::Rays(rays)) => vec![Layer {
            name: "direction",
            wanted: directions.iter().map(|dir| signed(*dir)).collect(),
            got: rays
                .iter()
                .map(|ray| of(ray, |ray| signed(ray.dir)))
                .collect(),
        }],
        (Key::Radiance { pixels, .. }, Answer::Picture(Outcome::Value(got))) => vec![Layer {
            name: "light",
            wanted: pixels.iter().map(|pixel| screen(*pixel)).collect(),
            got: got.iter().map(|pixel| screen(*pixel)).collect(),
        }],
        (
            Key::Rays { .. }
            | Key::Hits { .. }
            | Key::Spans { .. }
            | Key::Tree { .. }
            | Key::FirstHits { .. }
            | Key::Radiance { .. },
            _,
        ) => return None,
    };
    let gravest = blemishes
        .iter()
        .flatten()
        .map(|blemish| blemish.aspect)
        .min();
    let shown = gravest.map_or("normal", shown_by);
    layers.sort_by_key(|layer| layer.name != shown);
    let view = |layer: &Layer| view(layer, blemishes, per_pixel);
    Some(layers.iter().map(view).collect())
}

/// What came, quantity by quantity, as [`views`] paints it where nothing is wrong.
pub(super) fn received(asked: &Asked, answer: &Answer, per_pixel: usize) -> Option<Vec<Plate>> {
    Some(match (&asked.key, answer) {
        (Key::FirstHits { hits, .. }, Answer::Hits(got)) => {
            let grey = greys(hits);
            let paint = |colour: &dyn Fn(&Trace) -> Vec3| {
                let hit = |hit: &Option<Trace>| hit.as_ref().map_or(NOTHING, colour);
                means(got, per_pixel, |outcome| of(outcome, hit))
            };
            vec![
                Plate::of("normal", paint(&|hit| signed(hit.normal))),
                Plate::of("depth", paint(&|hit| grey(hit.distance))),
                Plate::of("uv", paint(&|hit| texture(hit.uv))),
            ]
        }
        (Key::Rays { .. }, Answer::Rays(rays)) => {
            let direction = |ray: &Outcome<Ray>| of(ray, |ray| signed(ray.dir));
            vec![Plate::of("direction", means(rays, per_pixel, direction))]
        }
        (Key::Radiance { .. }, Answer::Picture(Outcome::Value(got))) => {
            vec![Plate::of(
                "light",
                means(got, per_pixel, |pixel| screen(*pixel)),
            )]
        }
        (
            Key::Rays { .. }
            | Key::Hits { .. }
            | Key::Spans { .. }
            | Key::Tree { .. }
            | Key::FirstHits { .. }
            | Key::Radiance { .. },
            _,
        ) => return None,
    })
}

/// Whether there is something to be seen at each position of the right picture.
pub(super) fn something(asked: &Asked) -> Vec<bool> {
    match &asked.key {
        Key::FirstHits { hits, .. } => hits.iter().map(Option::is_some).collect(),
        Key::Rays { directions, .. } => vec![true; directions.len()],
        Key::Radiance { pixels, .. } => vec![true; pixels.len()],
        Key::Hits { .. } | Key::Spans { .. } | Key::Tree { .. } => Vec::new(),
    }
}

/// The name of the view in which such a fault is seen.
fn shown_by(aspect: Aspect) -> &'static str {
    match aspect {
        Aspect::NoAnswer | Aspect::HitOrMiss | Aspect::Normal => "normal",
        Aspect::Depth => "depth",
        Aspect::Uv => "uv",
        Aspect::Direction => "direction",
        Aspect::Radiance => "light",
    }
}

fn first_hits(hits: &[Option<Surface>], got: &[Outcome<Option<Trace>>]) -> Vec<Layer> {
    let grey = greys(hits);
    let layer = |name, of_key: &dyn Fn(&Surface) -> Vec3, of_got: &dyn Fn(&Trace) -> Vec3| Layer {
        name,
        wanted: hits
            .iter()
            .map(|hit| hit.as_ref().map_or(NOTHING, of_key))
            .collect(),
        got: got
            .iter()
            .map(|outcome| of(outcome, |hit| hit.as_ref().map_or(NOTHING, of_got)))
            .collect(),
    };
    vec![
        layer("normal", &|hit| signed(hit.normal), &|hit| {
            signed(hit.normal)
        }),
        layer("depth", &|hit| grey(hit.depth), &|hit| grey(hit.distance)),
        layer("uv", &|hit| texture(hit.uv), &|hit| texture(hit.uv)),
    ]
}

/// Depths, the nearest white.
fn greys(hits: &[Option<Surface>]) -> impl Fn(f32) -> Vec3 {
    let depths = hits.iter().flatten().map(|surface| surface.depth);
    let (near, far) = depths.fold((f32::INFINITY, 0.0), |(near, far), depth| {
        (depth.min(near), depth.max(far))
    });
    move |depth: f32| {
        number(Vec3::splat(
            1.0 - 0.8 * (depth - near) / (far - near).max(1e-6),
        ))
    }
}

fn of<T>(outcome: &Outcome<T>, paint: impl Fn(&T) -> Vec3) -> Vec3 {
    match outcome {
        Outcome::Value(value) => paint(value),
        Outcome::Panicked(_) | Outcome::GivenUp => NO_NUMBER,
    }
}

/// Components from -1 to 1.
fn signed(vector: Vec3) -> Vec3 {
    number(vector * 0.5 + 0.5)
}

fn texture(uv: Vec2) -> Vec3 {
    number(Vec3::new(uv.x, uv.y, 0.35))
}

/// Light, as screens want it: IEC 61966-2-1.
fn screen(light: Vec3) -> Vec3 {
    let channel = |light: f32| match light {
        _ if light <= 0.003_130_8 => 12.92 * light,
        _ => 1.055 * light.powf(1.0 / 2.4) - 0.055,
    };
    number(Vec3::from(number(light).to_array().map(channel)))
}

fn number(colour: Vec3) -> Vec3 {
    match colour.is_finite() {
        true => colour.clamp(Vec3::ZERO, Vec3::ONE),
        false => NO_NUMBER,
    }
}

fn view(layer: &Layer, blemishes: &[Option<Blemish>], per_pixel: usize) -> View {
    let apart = layer.wanted.iter().zip(&layer.got).zip(blemishes);
    let apart: Vec<Vec3> = apart
        .map(|((wanted, got), blemish)| match blemish {
            // Where an edge runs through a position, what differs may be right as well.
            None => Vec3::ZERO,
            Some(_) => ((*got - *wanted).abs() * STRONGER).min(Vec3::ONE),
        })
        .collect();
    View {
        name: layer.name,
        wanted: pixels(&layer.wanted, per_pixel),
        got: pixels(&layer.got, per_pixel),
        difference: pixels(&apart, per_pixel),
    }
}

fn pixels(positions: &[Vec3], per_pixel: usize) -> Vec<Colour> {
    means(positions, per_pixel, |colour| *colour)
}

/// Each pixel's mean over its positions.
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
