//! A ray and a sphere, in the plane through the ray and the center: there the sphere is a circle.

use glam::{DVec2, DVec3, dvec2};

use super::Drawing;
use super::canvas::{Anchor, Canvas};
use super::encounter::{Encounter, Focus};
use super::ink::{Fill, Ink, Line};
use super::sheet::Sheet;
use super::side::{self, Side};
use super::uv;
use super::window::{Window, extent};

/// The drawing.
pub(super) fn draw(encounter: &Encounter, center: DVec3, radius: f64) -> Drawing {
    let aside = center - encounter.ray.origin.as_dvec3();
    let side = Side::of(encounter, aside);
    let middle = side.see(center);
    let corner = DVec2::splat(radius);
    let shape = [middle - corner, middle + corner];
    let seen = side::landmarks(encounter, &side, &shape);

    let mut sheet = Sheet::default();
    let window = match encounter.focus {
        Focus::Uv => {
            let titles = ["through the ray and the center", "texture coordinates"];
            let [left, right] = sheet.panels(titles, 150.0);
            uv::square(&mut sheet.canvas, right, encounter, &[]);
            Window::around(left, shape)
        }
        Focus::Distance | Focus::Position | Focus::Normal | Focus::Origin | Focus::Material => {
            let part = sheet.panel(height(&seen));
            Window::around(part, seen)
        }
    };
    circle(&mut sheet.canvas, &window, middle, radius);
    side::ray(&mut sheet.canvas, &window, encounter);
    side::hits(&mut sheet.canvas, &window, encounter, &side);
    let got = encounter.got_point().map(|point| side.see(point));
    let is_seen = got.is_none_or(|at| window.pinned(at).is_some_and(|(_, is_off)| !is_off));
    side::explain(&mut sheet, encounter, is_seen);
    let title = "The ray and the sphere, in the plane through the ray and the center";
    sheet.finish(title, encounter.sentence())
}

/// The height of a panel over the whole width that shows these points well.
pub(super) fn height(seen: &[DVec2]) -> f64 {
    let size = extent(seen.iter().copied()).map_or(DVec2::ONE, |(min, max)| max - min);
    // A NaN, of nothing over nothing, becomes the least.
    (306.0 * size.y / size.x + 32.0).max(100.0).min(210.0)
}

fn circle(canvas: &mut Canvas, window: &Window, middle: DVec2, radius: f64) {
    let at = window.page(middle);
    let fill = Fill::Of(Ink::Text, 0.08);
    canvas.circle(at, window.length(radius), Line::Outline, fill);
    let arm = dvec2(3.0, 0.0);
    canvas.line(at - arm, at + arm, Line::Outline);
    canvas.line(at - arm.perp(), at + arm.perp(), Line::Outline);
    let below = at + dvec2(0.0, 16.0);
    canvas.text(below, Anchor::Middle, Ink::Faint, "center");
}
