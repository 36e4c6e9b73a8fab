//! Composes the picture on the page from the values of its pixels.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use framework::harness::view::{self, ViewMode};
use framework::render::film::Tone;
use glam::{UVec2, Vec3};
use protocol::{Trace, Tree};
use view_probe::messages::TestCounts;

use crate::model::layer::{Layer, Shown};
use crate::model::tree::TreeModel;
use crate::session::{Key, Session, View};
use crate::studio::Studio;

/// The time between two pictures, at first and later. A picture that is nearly complete changes
/// little, and composing it takes time from drawing it.
const INTERVALS: [(Duration, Duration); 3] = [
    (Duration::from_millis(600), Duration::from_millis(100)),
    (Duration::from_secs(4), Duration::from_millis(500)),
    (Duration::MAX, Duration::from_secs(1)),
];
/// The colour of pixels whose code panicked.
const PANIC_COLOUR: [u8; 3] = [255, 0, 255];

/// A composed picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The PNG file.
    pub png: Vec<u8>,
    /// The key of the pixels.
    pub key: Key,
    /// Whether it has all samples.
    pub is_complete: bool,
}

/// The values of a picture, copied so that drawing goes on while it is composed.
struct Snapshot {
    key: Key,
    is_complete: bool,
    film: UVec2,
    values: Values,
    exposure: f32,
}

enum Values {
    Light(Layer<Vec3>),
    Hits(Layer<Option<Trace>>, ViewMode, Option<Arc<TreeModel>>, f32),
    Clay(Layer<Option<Trace>>, Vec3),
    Tests(Layer<TestCounts>),
}

/// Composes pictures until the process ends.
pub fn run(studio: &Studio) {
    let mut shown = None;
    let mut last = Instant::now();
    loop {
        studio.wait_for_dirt();
        let (age, is_complete) =
            studio.read(|session, now| (session.age(now), session.is_complete()));
        let interval = INTERVALS
            .iter()
            .find(|(until, _)| age < *until)
            .map_or(Duration::ZERO, |(_, interval)| *interval);
        // The first picture after a change is shown at once, and so is the last.
        let is_new = shown != Some(studio.read(|session, _| session.key()));
        let wait = interval.saturating_sub(last.elapsed());
        if !is_new && !is_complete && !wait.is_zero() {
            thread::sleep(wait.min(Duration::from_millis(50)));
            continue;
        }
        let snapshot = studio.update(|session, _| {
            session.is_dirty = false;
            snapshot(session)
        });
        shown = Some(snapshot.key);
        let png = encode(snapshot.film, &snapshot.bytes());
        last = Instant::now();
        studio.show_picture(Picture {
            png,
            key: snapshot.key,
            is_complete: snapshot.is_complete,
        });
    }
}

fn snapshot(session: &Session) -> Snapshot {
    let values = match session.view {
        View::Shaded => Values::Light(session.light.clone()),
        View::Tests => Values::Tests(session.tests.clone()),
        View::Clay => Values::Clay(session.hits.clone(), session.camera().placement.position),
        View::Normals => hits(session, ViewMode::Normals),
        View::Depth => hits(session, ViewMode::Depth),
        View::Uv => hits(session, ViewMode::Uv),
        View::Bvh => hits(session, ViewMode::Bvh),
    };
    Snapshot {
        key: session.key(),
        is_complete: session.is_complete(),
        film: session.light.film(),
        values,
        exposure: session.exposure,
    }
}

fn hits(session: &Session, mode: ViewMode) -> Values {
    Values::Hits(
        session.hits.clone(),
        mode,
        session.tree.clone(),
        session.subject.extent,
    )
}

impl Snapshot {
    /// Returns the bytes of the picture, row by row from the top.
    fn bytes(&self) -> Vec<u8> {
        let stops = self.exposure;
        match &self.values {
            Values::Light(layer) => {
                let tone = ToneTable::new(stops);
                self.each(|pixel| {
                    layer.shown(pixel).map(|shown| match shown {
                        Shown::Value(sum, count) => tone.to_bytes(sum / count as f32),
                        Shown::Panicked => PANIC_COLOUR,
                    })
                })
            }
            Values::Hits(layer, mode, tree, extent) => {
                let pixels = self.pixels().map(|pixel| match layer.shown(pixel) {
                    Some(Shown::Value(hit, _)) => hit,
                    Some(Shown::Panicked) | None => None,
                });
                let pixels: Vec<Option<Trace>> = pixels.collect();
                let nothing = Tree::default();
                let tree = tree.as_ref().map_or(&nothing, |model| &model.tree);
                let colours = view::picture(*mode, &pixels, tree, *extent);
                self.each(|pixel| match layer.shown(pixel)? {
                    Shown::Value(..) => {
                        let index = pixel.y * self.film.x + pixel.x;
                        Some(Tone::Data.to_bytes(colours[index as usize]))
                    }
                    Shown::Panicked => Some(PANIC_COLOUR),
                })
            }
            Values::Clay(layer, eye) => self.each(|pixel| match layer.shown(pixel)? {
                Shown::Value(hit, _) => Some(Tone::Data.to_bytes(clay(hit?, *eye))),
                Shown::Panicked => Some(PANIC_COLOUR),
            }),
            Values::Tests(layer) => {
                let total = |counts: TestCounts| counts.boxes.saturating_add(counts.primitives);
                let most = layer
                    .values()
                    .flatten()
                    .map(total)
                    .max()
                    .unwrap_or(0)
                    .max(1);
                self.each(|pixel| match layer.shown(pixel)? {
                    Shown::Value(counts, _) => {
                        Some(Tone::Data.to_bytes(view::heat_colour(total(counts), most)))
                    }
                    Shown::Panicked => Some(PANIC_COLOUR),
                })
            }
        }
    }

    fn pixels(&self) -> impl Iterator<Item = UVec2> {
        let film = self.film;
        (0..film.y).flat_map(move |y| (0..film.x).map(move |x| UVec2::new(x, y)))
    }

    fn each(&self, colour: impl Fn(UVec2) -> Option<[u8; 3]>) -> Vec<u8> {
        let rows = (0..self.film.y).rev();
        rows.flat_map(|y| (0..self.film.x).map(move |x| UVec2::new(x, y)))
            .flat_map(|pixel| colour(pixel).unwrap_or_default())
            .collect()
    }
}

/// Returns the colour of a hit as if everything were made of clay, and lit from the camera: the more
/// the surface is turned away, the darker. A normal that points away is shown in blue.
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

/// The conversion of radiance to bytes, as [`Tone::Light`] does it, but with a table: powers take
/// most of the time of composing a picture.
struct ToneTable {
    /// For each byte but 0, the smallest radiance that becomes it.
    thresholds: Vec<f32>,
}

impl ToneTable {
    fn new(stops: f32) -> Self {
        let tone = Tone::Light { stops };
        let byte = |bits: u32| tone.to_bytes(Vec3::splat(f32::from_bits(bits)))[0];
        // Floats that are not negative are in the order of their bits.
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

/// Encodes a picture as PNG. Speed counts more than size, because pictures are sent often, mostly
/// within one machine.
fn encode(film: UVec2, bytes: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, film.x, film.y);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::Fastest);
    let mut writer = encoder.write_header().expect("writing to memory succeeds");
    writer
        .write_image_data(bytes)
        .expect("writing to memory succeeds");
    writer.finish().expect("writing to memory succeeds");
    file
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
            material: 0,
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
    fn the_table_gives_the_same_bytes_as_the_framework() {
        for stops in [0.0, -2.5, 3.0] {
            let (table, tone) = (ToneTable::new(stops), Tone::Light { stops });
            for step in 0..20_000_u16 {
                let x = 1.1 * f32::from(step) / 20_000.0 * 2.0_f32.powf(-stops);
                let pixel = Vec3::new(x, x * x, 10.0 * x);
                assert_eq!(
                    table.to_bytes(pixel),
                    tone.to_bytes(pixel),
                    "{stops} {pixel}"
                );
            }
            for x in [-1.0, f32::NAN, f32::INFINITY, 0.0] {
                let pixel = Vec3::splat(x);
                assert_eq!(table.to_bytes(pixel), tone.to_bytes(pixel), "{stops} {x}");
            }
        }
    }
}
