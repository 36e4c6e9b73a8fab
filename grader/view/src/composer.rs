//! Composes the page's picture from the values of its pixels.

use std::thread;
use std::time::{Duration, Instant};

use framework::harness::view::{self, ViewMode};
use framework::render::film::Tone;
use glam::{UVec2, Vec3};
use grader::png_file;
use protocol::{Trace, Tree};
use view_probe::messages::MarkedTests;
use view_probe::rules::RULES;

use crate::model::layer::{Layer, PixelContent};
use crate::session::{Session, View};
use crate::shared_session::SharedSession;

/// Pairs of a picture's age and the interval between updates. The interval applies until the
/// picture reaches that age. A nearly complete picture changes little, and composing it takes time
/// away from drawing it.
const INTERVALS: [(Duration, Duration); 3] = [
    (Duration::from_millis(600), Duration::from_millis(100)),
    (Duration::from_secs(4), Duration::from_millis(500)),
    (Duration::MAX, Duration::from_secs(1)),
];
/// The colour of pixels where the code panicked.
const PANIC_COLOUR: [u8; 3] = [255, 0, 255];
/// The number of tests at the upper end of the colour scale.
const MOST_TESTS: f32 = 1000.0;
/// The minimum number of rule violations for the brightest colour.
const MOST_MARKS: f32 = 16.0;
/// The colour of each rule, in the order of [`Rule`](view_probe::rules::Rule). The colours can be
/// told apart by people with any type of colour vision. The page's legend uses the same colours.
const RULE_COLOURS: [Vec3; RULES] = [
    Vec3::new(0.95, 0.42, 0.05),
    Vec3::new(0.95, 0.87, 0.25),
    Vec3::new(0.3, 0.65, 0.95),
];

/// The colours of a picture's pixels, row by row from the top.
type Colours = Vec<[u8; 3]>;
/// A function that composes a picture and returns its size and colours.
type Composition = Box<dyn FnOnce() -> (UVec2, Colours)>;

/// Composes pictures until the process ends.
pub fn run(shared: &SharedSession) {
    let mut shown = None;
    let mut last = Instant::now();
    loop {
        shared.wait_for(|session, _| (session.is_dirty && session.has_picture()).then_some(()));
        let (age, is_complete) =
            shared.read(|session, now| (session.age(now), session.is_complete()));
        let interval = INTERVALS
            .iter()
            .find(|(until, _)| age < *until)
            .map_or(Duration::ZERO, |(_, interval)| *interval);
        // After a change, show the first and the last picture immediately.
        let is_new = shown != Some(shared.read(|session, _| session.key()));
        let wait = interval.saturating_sub(last.elapsed());
        if !is_new && !is_complete && !wait.is_zero() {
            thread::sleep(wait.min(Duration::from_millis(50)));
            continue;
        }
        let (key, is_complete, compose) = shared.update(|session, _| {
            session.is_dirty = false;
            (session.key(), session.is_complete(), composition(session))
        });
        shown = Some(key);
        let (film, bytes) = compose();
        let png = png_file::encode(film, bytes.as_flattened());
        last = Instant::now();
        shared.show_picture(png, key, is_complete);
    }
}

/// Returns a function that composes the picture and returns its size and colours. The function owns
/// a copy of the values, so drawing can continue while the function runs.
fn composition(session: &Session) -> Composition {
    let data = |colour| Tone::Data.to_bytes(colour);
    let of_radiance = |layer: &Layer<Vec3>| -> Composition {
        let (layer, stops) = (layer.clone(), session.shown.exposure);
        Box::new(move || {
            let tone = ToneTable::new(stops);
            paint(&layer, |_, sum, count| tone.to_bytes(sum / count as f32))
        })
    };
    let of_tests = |colour: fn(MarkedTests) -> Vec3| -> Composition {
        let tests = session.picture.tests.clone();
        Box::new(move || paint(&tests, |_, tests, _| data(colour(tests))))
    };
    let mode = match session.shown.view {
        View::Shaded => return of_radiance(&session.picture.light),
        View::Clay => return of_radiance(&session.picture.clay),
        View::Tests => return of_tests(test_count),
        View::Mistakes => return of_tests(mistakes),
        View::Normals => ViewMode::Normals,
        View::Depth => ViewMode::Depth,
        View::Uv => ViewMode::Uv,
        View::Bvh => ViewMode::Bvh,
    };
    let (tree, extent) = (session.tree.clone(), session.subject.extent);
    let hits = session.picture.hits.clone();
    Box::new(move || {
        let film = hits.tiles.film;
        let pixels = (0..film.y).flat_map(|y| (0..film.x).map(move |x| UVec2::new(x, y)));
        let hit = |pixel| match hits.shown(pixel) {
            Some(PixelContent::Value(hit, _)) => hit,
            Some(PixelContent::Panicked) | None => None,
        };
        let seen: Vec<Option<Trace>> = pixels.map(hit).collect();
        let nothing = Tree::default();
        let tree = tree.as_ref().map_or(&nothing, |model| &model.index.tree);
        let colours = view::picture(mode, &seen, tree, extent);
        paint(&hits, |pixel, _, _| data(colours[hits.tiles.index(pixel)]))
    })
}

/// Returns the size of a layer and the colours of its pixels, row by row from the top. `colour`
/// returns a pixel's colour, given its value and number of samples.
fn paint<T: Copy + Default>(
    layer: &Layer<T>,
    colour: impl Fn(UVec2, T, u32) -> [u8; 3],
) -> (UVec2, Colours) {
    let film = layer.tiles.film;
    let rows = (0..film.y).rev();
    let pixels = rows.flat_map(|y| (0..film.x).map(move |x| UVec2::new(x, y)));
    let colours = pixels.map(|pixel| match layer.shown(pixel) {
        Some(PixelContent::Value(value, count)) => colour(pixel, value, count),
        Some(PixelContent::Panicked) => PANIC_COLOUR,
        None => [0; 3],
    });
    (film, colours.collect())
}

/// Returns a test count's position on the scale from 1 to [`MOST_TESTS`]. The scale is fixed, so
/// that pictures can be compared, and logarithmic, so that it covers both a good tree and a plain
/// list of primitives.
fn share_of_scale(tests: MarkedTests) -> f32 {
    let total = tests.counts.total().max(1) as f32;
    (total.log2() / MOST_TESTS.log2()).min(1.0)
}

/// Returns the colour for the number of a ray's tests.
fn test_count(tests: MarkedTests) -> Vec3 {
    view::heat_colour((1000.0 * share_of_scale(tests)) as u32, 1000)
}

/// Returns the colour for a ray's mistakes. It is the colour of the rule that the ray breaks most
/// often: the more often it breaks this rule, the brighter the colour. A ray without mistakes is
/// grey: the more tests it needs, the lighter the grey.
fn mistakes(tests: MarkedTests) -> Vec3 {
    let marks = tests.marks.iter().zip(RULE_COLOURS);
    match marks.rev().max_by_key(|(count, _)| **count) {
        Some((count, colour)) if *count > 0 => {
            let share = ((*count as f32).log2() / MOST_MARKS.log2()).min(1.0);
            colour * (0.5 + 0.5 * share)
        }
        Some(_) | None => Vec3::splat(0.08 + 0.3 * share_of_scale(tests)),
    }
}

/// Converts radiance to bytes like [`Tone::Light`], but with a table, because composing a picture
/// would otherwise spend most of its time computing powers.
struct ToneTable {
    /// For each byte except 0, the smallest radiance that maps to it.
    thresholds: Vec<f32>,
}

impl ToneTable {
    fn new(stops: f32) -> Self {
        let tone = Tone::Light { stops };
        let byte = |bits: u32| tone.to_bytes(Vec3::splat(f32::from_bits(bits)))[0];
        // Non-negative floats are in the same order as their bits.
        let threshold = |wanted: u8| {
            let (mut low, mut high) = (0, f32::INFINITY.to_bits());
            while low < high {
                let middle = low.midpoint(high);
                if byte(middle) < wanted {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            f32::from_bits(low)
        };
        ToneTable {
            thresholds: (1..=255).map(threshold).collect(),
        }
    }

    fn to_bytes(&self, pixel: Vec3) -> [u8; 3] {
        let byte = |x: f32| self.thresholds.partition_point(|threshold| *threshold <= x) as u8;
        pixel.to_array().map(byte)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_are_no_light_have_the_bytes_of_the_framework() {
        for stops in [0.0, -2.5, 3.0] {
            let (table, tone) = (ToneTable::new(stops), Tone::Light { stops });
            for x in [-1.0, 0.0, 0.3, f32::NAN, f32::INFINITY] {
                let pixel = Vec3::new(x, x * x, 10.0 * x);
                let bytes = table.to_bytes(pixel);
                assert_eq!(bytes, tone.to_bytes(pixel), "{stops} {pixel}");
            }
        }
    }
}
