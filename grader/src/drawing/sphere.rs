//! Draws a ray and a sphere in the plane through the ray and the sphere's centre, in which the
//! sphere appears as a circle.

use glam::{DVec2, DVec3, dvec2};

use super::Drawing;
use super::canvas::{Anchor, Canvas};
use super::hit_comparison::{Focus, HitComparison};
use super::ink::{Fill, Ink, LineStyle};
use super::sheet::Sheet;
use super::side::SideView;
use super::uv;
use super::window::Window;

/// Draws a ray and a sphere.
pub(super) fn draw(comparison: &HitComparison, center: DVec3, radius: f64) -> Drawing {
    let aside = center - comparison.ray.origin.as_dvec3();
    let side = SideView::new(comparison, aside);
    let middle = side.project(center);
    let corner = DVec2::splat(radius);
    let shape = [middle - corner, middle + corner];
    let seen = side.landmarks(&shape);

    let mut sheet = Sheet::default();
    let window = if comparison.focus == Focus::Uv {
        let titles = ["from the side", "texture coordinates"];
        let [left, right] = sheet.panels(titles, 150.0);
        uv::draw_square(&mut sheet.canvas, right, comparison, &[]);
        Window::around(left, seen)
    } else {
        sheet.window(seen)
    };
    draw_circle(&mut sheet.canvas, &window, middle, radius);
    side.draw_ray(&mut sheet.canvas, &window);
    side.draw_hits(&mut sheet.canvas, &window);
    side.draw_legend(&mut sheet, &window);
    let title = "The ray and the sphere, in the plane through the ray and the centre";
    sheet.finish(title, comparison.caption())
}

fn draw_circle(canvas: &mut Canvas, window: &Window, middle: DVec2, radius: f64) {
    let at = window.page_position(middle);
    let fill = Fill::Tint(Ink::Text, 0.08);
    canvas.circle(at, window.page_length(radius), LineStyle::Outline, fill);
    let arm = dvec2(3.0, 0.0);
    canvas.line(at - arm, at + arm, LineStyle::Outline);
    canvas.line(at - arm.perp(), at + arm.perp(), LineStyle::Outline);
    // The label goes above the centre, since the ray passes below it.
    let above = at - dvec2(0.0, 7.0);
    canvas.text(above, Anchor::Middle, Ink::Faint, "center");
}
