//! The value of a pixel as text.

use glam::{UVec2, Vec2, Vec3};
use protocol::Trace;
use view_probe::messages::{Quantity, TestCounts};

use super::Session;
use crate::model::layer::PixelContent;

impl Session {
    /// Returns the value of a pixel in the current view, or `None` if it hasn't been drawn yet.
    pub fn value_at(&self, pixel: UVec2) -> Option<String> {
        let pixel = pixel.min(self.shown.film - 1);
        match self.shown.view.layer() {
            Quantity::Light => of_radiance(self.picture.light.shown(pixel)?),
            Quantity::Clay => of_radiance(self.picture.clay.shown(pixel)?),
            Quantity::Hit => text(self.picture.hits.shown(pixel)?, |hit, _| {
                hit.map_or("no hit".to_owned(), |hit| of_hit(&hit))
            }),
            Quantity::Tests => text(self.picture.tests.shown(pixel)?, |tests, _| {
                let TestCounts { boxes, primitives } = tests.counts;
                let marked: u32 = tests.marks.iter().sum();
                format!("{boxes} box tests, {primitives} primitive tests, {marked} wrong steps")
            }),
        }
    }
}

fn text<T>(shown: PixelContent<T>, of_value: impl FnOnce(T, u32) -> String) -> Option<String> {
    Some(match shown {
        PixelContent::Value(value, count) => of_value(value, count),
        PixelContent::Panicked => "no value: see the messages".to_owned(),
    })
}

/// Returns the mean of a pixel's samples, given their sum.
fn of_radiance(shown: PixelContent<Vec3>) -> Option<String> {
    text(shown, |sum, count| {
        format!("radiance {}", of_vector(sum / count as f32))
    })
}

fn of_hit(hit: &Trace) -> String {
    let Trace {
        distance,
        normal,
        uv: Vec2 { x: u, y: v },
        shape,
        ..
    } = *hit;
    let normal = of_vector(normal);
    format!("distance {distance:.3}, normal {normal}, uv ({u:.2}, {v:.2}), shape {shape}")
}

fn of_vector(vector: Vec3) -> String {
    let Vec3 { x, y, z } = vector;
    format!("({x:.2}, {y:.2}, {z:.2})")
}
