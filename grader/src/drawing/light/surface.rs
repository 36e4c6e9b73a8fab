//! Draws directions at a surface in two views: from the side, where the plane of incidence is the
//! page, and from above.

use glam::{DVec2, DVec3, dvec2};
use protocol::Value;

use super::row::{RowComparison, angle_text, directions};
use crate::drawing::Drawing;
use crate::drawing::canvas::{Anchor, Canvas, Mark};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::sheet::{Sheet, Symbol};
use crate::drawing::window::{Panel, Window};

/// The upper right corner of both views, which leaves space for labels beyond the unit circle.
const EXTENT: DVec2 = DVec2::splat(1.12);
/// The fill of the inside of glass.
const GLASS: Fill = Fill::Tint(Ink::Text, 0.12);

/// Draws the direction to where the path came from, the expected direction and the submitted one.
pub(super) fn draw(row: &RowComparison) -> Option<Drawing> {
    let out = directions(row.input.as_ref()).next()?;
    // `out` leads to the left in both views.
    let right = (-out.with_z(0.0)).try_normalize().unwrap_or(DVec3::X);
    // Points up in the view from above.
    let up = DVec3::Z.cross(right);
    let mut subject = row.subject.values();
    let is_glass = subject.any(|value| matches!(value, Value::Ratio(_)));

    let mut sheet = Sheet::default();
    let panels = sheet.panels(["from the side", "from above"], 166.0);
    let windows = panels.map(|panel| Window::around(panel, [-EXTENT, EXTENT]));
    draw_surface(&mut sheet.canvas, panels[0], &windows[0], is_glass);
    let horizon = windows[1].page_length(1.0);
    let center = windows[1].page_position(DVec2::ZERO);
    let canvas = &mut sheet.canvas;
    canvas.circle(center, horizon, LineStyle::Grid, Fill::None);

    let arrows = Arrows {
        out,
        wanted: row.wanted_direction(),
        got: row.wrong_direction(),
    };
    let along = |direction: DVec3| direction.dot(right);
    arrows.draw(canvas, &windows[0], |to| dvec2(along(to), to.z));
    arrows.draw(canvas, &windows[1], |to| dvec2(along(to), to.dot(up)));

    let text = format!("out, {}", angle_text(out));
    sheet.add_legend(Symbol::Line(LineStyle::Ray), &text);
    let lines = [LineStyle::Right, LineStyle::Wrong];
    row.add_results(&mut sheet, lines.map(Symbol::Line));
    let title = "Directions at the surface, from the side and from above";
    Some(sheet.finish(title, row.caption()))
}

/// Draws the surface and its normal from the side.
fn draw_surface(canvas: &mut Canvas, panel: Panel, window: &Window, is_glass: bool) {
    let center = window.page_position(DVec2::ZERO);
    let [left, right] = [panel.min, panel.max].map(|corner| dvec2(corner.x, center.y));
    if is_glass {
        canvas.area(left, panel.max, GLASS);
        let at = panel.max - dvec2(5.0, 6.0);
        canvas.text(at, Anchor::End, Ink::Faint, "glass");
    }
    canvas.line(left, right, LineStyle::Outline);
    let top = window.page_position(DVec2::Y);
    canvas.line(center, top, LineStyle::Behind);
    let at = top + dvec2(5.0, 6.0);
    canvas.text(at, Anchor::Start, Ink::Faint, "normal");
}

/// The directions to draw as arrows from the same point.
struct Arrows {
    out: DVec3,
    wanted: Option<DVec3>,
    got: Option<DVec3>,
}

impl Arrows {
    fn draw(&self, canvas: &mut Canvas, window: &Window, project: impl Fn(DVec3) -> DVec2) {
        let mut arrow = |direction: DVec3, aside: f64, line| {
            // Keeps very short and very long arrows visible.
            let length = direction.length();
            let seen = project(direction * length.clamp(0.4, 1.2) / length);
            let foot = window.world_length(aside) * seen.perp().normalize_or_zero();
            canvas.arrow(window, [foot, foot + seen], line);
        };
        arrow(self.out, 0.0, LineStyle::Ray);
        if let Some(wanted) = self.wanted {
            arrow(wanted, 0.0, LineStyle::Right);
        }
        if let Some(got) = self.got {
            // Arrows that would cover each other are drawn side by side.
            let is_same_way = [self.wanted, Some(self.out)]
                .into_iter()
                .flatten()
                .any(|other| got.angle_between(other) < 0.1);
            arrow(got, if is_same_way { 6.0 } else { 0.0 }, LineStyle::Wrong);
        }
        let tip = project(self.out);
        let beyond = tip.try_normalize().unwrap_or(DVec2::NEG_X);
        let label = window.page_position(tip + window.world_length(14.0) * beyond);
        let label = label + dvec2(0.0, 4.0);
        canvas.text(label, Anchor::Middle, Ink::Text, "out");
        canvas.mark(window.page_position(DVec2::ZERO), Mark::Origin);
    }
}
