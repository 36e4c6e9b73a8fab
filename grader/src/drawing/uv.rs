//! Draws texture coordinates in the square from (0, 0) to (1, 1).

use glam::{DVec2, dvec2};

use super::canvas::{Anchor, Canvas, Mark};
use super::hit_comparison::HitComparison;
use super::ink::{Fill, Ink, LineStyle};
use super::window::{Panel, Window};

/// Draws the square with the expected and the submitted texture coordinates. If `corners` isn't
/// empty, also draws the texture coordinates of a triangle's corners.
pub(super) fn draw_square(
    canvas: &mut Canvas,
    panel: Panel,
    comparison: &HitComparison,
    corners: &[DVec2],
) {
    let around = Panel {
        min: panel.min + dvec2(8.0, 0.0),
        max: panel.max - dvec2(0.0, 10.0),
    };
    let window = Window::around(around, [DVec2::ZERO, DVec2::ONE]);
    let [low, high] = [DVec2::ZERO, DVec2::ONE].map(|corner| window.page_position(corner));
    canvas.rectangle(low, high, LineStyle::Grid, Fill::None);
    for (at, anchor, text) in [
        (low + dvec2(-3.0, 13.0), Anchor::End, "0"),
        (dvec2(high.x, low.y + 13.0), Anchor::Middle, "u = 1"),
        (dvec2(low.x - 3.0, high.y + 4.0), Anchor::End, "v=1"),
    ] {
        canvas.text(at, anchor, Ink::Faint, text);
    }

    let outline = corners.iter().map(|corner| window.page_position(*corner));
    let outline: Vec<DVec2> = outline.collect();
    if outline.len() > 2 {
        canvas.polygon(&outline, LineStyle::Outline, Fill::Tint(Ink::Text, 0.06));
    }
    for (at, label) in outline.iter().zip(["p0", "p1", "p2"]) {
        canvas.text(*at + dvec2(4.0, -4.0), Anchor::Start, Ink::Text, label);
    }
    let wanted = comparison.wanted.map(|hit| hit.uv);
    let got = comparison.got_hit().map(|hit| hit.uv);
    for (uv, mark) in [(wanted, Mark::Right), (got, Mark::Wrong)] {
        let at = uv.map(|uv| window.page_position(uv.as_dvec2()));
        if let Some(at) = at.filter(|at| at.is_finite()) {
            canvas.mark(at.clamp(panel.min + 7.0, panel.max - 7.0), mark);
        }
    }
}
