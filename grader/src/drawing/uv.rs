//! Texture coordinates: the square from (0, 0) to (1, 1).

use glam::{DVec2, dvec2};

use super::canvas::{Anchor, Canvas, Mark};
use super::encounter::{Encounter, Got};
use super::ink::{Fill, Ink, Line};
use super::window::{Part, Window};

/// The square, with the coordinates of a triangle's corners if there is one, and both answers.
pub(super) fn square(canvas: &mut Canvas, part: Part, encounter: &Encounter, corners: &[DVec2]) {
    let around = Part {
        min: part.min + dvec2(8.0, 0.0),
        max: part.max - dvec2(0.0, 10.0),
    };
    let window = Window::around(around, [DVec2::ZERO, DVec2::ONE]);
    let (low, high) = (window.page(DVec2::ZERO), window.page(DVec2::ONE));
    canvas.rectangle(low, high, Line::Grid, Fill::None);
    let name = |canvas: &mut Canvas, at: DVec2, anchor, words| {
        canvas.text(at, anchor, Ink::Faint, words);
    };
    name(canvas, low + dvec2(-3.0, 13.0), Anchor::End, "0");
    name(canvas, dvec2(high.x, low.y + 13.0), Anchor::Middle, "u = 1");
    name(canvas, dvec2(low.x - 3.0, high.y + 4.0), Anchor::End, "v=1");

    let outline: Vec<DVec2> = corners.iter().map(|corner| window.page(*corner)).collect();
    if outline.len() > 2 {
        canvas.polygon(&outline, Line::Outline, Fill::Of(Ink::Text, 0.06));
    }
    for (at, label) in outline.iter().zip(["p0", "p1", "p2"]) {
        canvas.text(*at + dvec2(4.0, -4.0), Anchor::Start, Ink::Text, label);
    }
    let wanted = encounter.wanted.map(|met| met.uv);
    let got = match encounter.got {
        Got::Hit(met) => Some(met.uv),
        Got::Miss | Got::NoAnswer => None,
    };
    for (uv, mark) in [(wanted, Mark::Right), (got, Mark::Wrong)] {
        let at = uv.map(|uv| window.page(uv)).filter(|at| at.is_finite());
        if let Some(at) = at {
            canvas.mark(at.clamp(part.min + 7.0, part.max - 7.0), mark);
        }
    }
}
