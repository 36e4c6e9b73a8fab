//! Composes the page's picture from the values of its pixels.

use std::thread;
use std::time::{Duration, Instant};

use framework::harness::view::{self, ViewMode};
use framework::render::film::Tone;
use glam::{UVec2, Vec3};
use grader::png_file;
use protocol::{Trace, Tree};
use view_probe::messages::TestCounts;

use crate::model::layer::{Layer, Shown};
use crate::session::{Session, View};
use crate::shared_session::SharedSession;

/// The time between two pictures, initially and later. A nearly complete picture changes little,
/// and composing it takes time away from drawing it.
const INTERVALS: [(Duration, Duration); 3] = [
    (Duration::from_millis(600), Duration::from_millis(100)),
    (Duration::from_secs(4), Duration::from_millis(500)),
    (Duration::MAX, Duration::from_secs(1)),
];
/// The colour of pixels whose code panicked.
const PANIC_COLOUR: [u8; 3] = [255, 0, 255];

/// The colours of a picture's pixels, row by row from the top.
type Colours = Vec<[u8; 3]>;

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
        // Show the first picture after a change and the last one immediately.
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

/// Returns a function that returns the size of the picture and its colours. It owns a copy of the
/// values, so that drawing continues while it composes them.
fn composition(session: &Session) -> Box<dyn FnOnce() -> (UVec2, Colours)> {
    let data = |colour| Tone::Data.to_bytes(colour);
    let mode = match session.shown.view {
        View::Shaded => {
            let (light, stops) = (session.light.clone(), session.shown.exposure);
            return Box::new(move || {
                let tone = ToneTable::new(stops);
                paint(&light, |_, sum, count| tone.to_bytes(sum / count as f32))
            });
        }
        View::Tests => {
            let tests = session.tests.clone();
            return Box::new(move || {
                let most = tests.values().flatten().map(TestCounts::total).max();
                let most = most.unwrap_or(0).max(1);
                paint(&tests, |_, counts, _| {
                    data(view::heat_colour(counts.total(), most))
                })
            });
        }
        View::Clay => {
            let (hits, eye) = (session.hits.clone(), session.camera().placement.position);
            let colour = move |hit| data(clay(hit, eye));
            return Box::new(move || paint(&hits, |_, hit, _| hit.map_or([0; 3], colour)));
        }
        View::Normals => ViewMode::Normals,
        View::Depth => ViewMode::Depth,
        View::Uv => ViewMode::Uv,
        View::Bvh => ViewMode::Bvh,
    };
    let (tree, extent) = (session.tree.clone(), session.subject.extent);
    let hits = session.hits.clone();
    Box::new(move || {
        let film = hits.tiles.film;
        let pixels = (0..film.y).flat_map(|y| (0..film.x).map(move |x| UVec2::new(x, y)));
        let hit = |pixel| match hits.shown(pixel) {
            Some(Shown::Value(hit, _)) => hit,
            Some(Shown::Panicked) | None => None,
        };
        let seen: Vec<Option<Trace>> = pixels.map(hit).collect();
        let nothing = Tree::default();
        let tree = tree.as_ref().map_or(&nothing, |model| &model.tree);
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
        Some(Shown::Value(value, count)) => colour(pixel, value, count),
        Some(Shown::Panicked) => PANIC_COLOUR,
        None => [0; 3],
    });
    (film, colours.collect())
}

/// Returns the colour of a hit as if everything was made of clay and lit from the camera: the more
/// the surface is turned away, the darker. Normals that point away are shown in blue.
fn clay(hit: Trace, eye: Vec3) -> Vec3 {
    let toward_eye = (eye - hit.position).normalize_or_zero();
    let cosine = hit.normal.normalize_or_zero().dot(toward_eye);
    let colour = if cosine < 0.0 {
        Vec3::new(0.45, 0.6, 0.95)
    } else {
        Vec3::new(0.92, 0.86, 0.78)
    };
    (0.12 + 0.88 * cosine.abs()) * colour
}

/// Converts radiance to bytes like [`Tone::Light`], but with a table, because computing powers
/// would take most of the time of composing a picture.
struct ToneTable {
    /// For each byte except 0, the smallest radiance that maps to it.
    thresholds: Vec<f32>,
}

impl ToneTable {
    fn new(stops: f32) -> Self {
        let tone = Tone::Light { stops };
        let byte = |bits: u32| tone.to_bytes(Vec3::splat(f32::from_bits(bits)))[0];
        // Non-negative floats are in the order of their bits.
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
    use glam::Vec2;

    use super::*;

    #[test]
    fn clay_is_lighter_where_it_faces_the_camera() {
        let hit = |normal| Trace {
            distance: 5.0,
            position: Vec3::ZERO,
            normal,
            uv: Vec2::ZERO,
            origin: Vec3::Z,
            shape: 0,
        };
        let eye = Vec3::new(0.0, 0.0, 5.0);
        let luminance = |normal| clay(hit(normal), eye).element_sum();
        assert!(
            luminance(Vec3::Z) > luminance(Vec3::ONE) && luminance(Vec3::ONE) > luminance(Vec3::X)
        );
        let away = clay(hit(Vec3::NEG_Z), eye);
        assert!(away.z > away.x, "a normal that points away is blue");
        assert!(clay(hit(Vec3::NAN), eye).is_finite());
    }
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
