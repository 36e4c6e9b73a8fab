//! A ray and a triangle, seen from two directions: along the ray, where the ray is a point inside
//! or outside the triangle, and from the side, where the triangle's plane is a line.

use glam::{DVec2, DVec3, dvec2};
use protocol::Vertex;

use super::Drawing;
use super::canvas::{Anchor, Canvas, Mark};
use super::hit_comparison::{Focus, HitComparison};
use super::ink::{Fill, Ink, LineStyle};
use super::sheet::Sheet;
use super::side::{self, SideView};
use super::uv;
use super::window::{Panel, Window};

/// Draws a ray and a triangle.
pub(super) fn draw(comparison: &HitComparison, vertices: &[Vertex; 3]) -> Drawing {
    let corners = vertices.map(|vertex| vertex.position.as_dvec3());
    let [p0, p1, p2] = corners;
    // In a plane that contains the ray and the normal, the triangle is seen edge-on. A degenerate
    // triangle has no normal, so the first edge is used in its place.
    let normal = (p1 - p0).cross(p2 - p0).try_normalize();
    let side = SideView::new(comparison, normal.unwrap_or(p1 - p0));

    let mut sheet = Sheet::default();
    let is_uv = comparison.focus == Focus::Uv;
    let beside = if is_uv {
        "texture coordinates"
    } else {
        "from the side"
    };
    let [left, right] = sheet.panels(["seen along the ray", beside], 168.0);
    draw_along_ray(&mut sheet.canvas, left, comparison, &side, corners);
    let seen = corners.map(|corner| side.project(corner));
    let window = Window::around(right, side::landmarks(comparison, &side, &seen));
    if is_uv {
        let uvs = vertices.map(|vertex| vertex.uv.as_dvec2());
        uv::draw_square(&mut sheet.canvas, right, comparison, &uvs);
    } else {
        draw_outline(&mut sheet.canvas, &window, seen);
        side::draw_ray(&mut sheet.canvas, &window, comparison);
        side::draw_hits(&mut sheet.canvas, &window, comparison, &side);
    }
    side::draw_legend(&mut sheet, comparison, &side, &window);
    let title = "The ray and the triangle, seen along the ray and from the side";
    sheet.finish(title, comparison.caption())
}

fn draw_along_ray(
    canvas: &mut Canvas,
    panel: Panel,
    comparison: &HitComparison,
    side: &SideView,
    corners: [DVec3; 3],
) {
    let seen = corners.map(|corner| side.project_along_ray(corner));
    let window = Window::around(panel, seen.into_iter().chain([DVec2::ZERO]));
    draw_outline(canvas, &window, seen);
    canvas.mark(window.page_position(DVec2::ZERO), Mark::Origin);
    if comparison.focus == Focus::Position {
        let got = comparison
            .got_point()
            .map(|point| side.project_along_ray(point));
        if let Some((at, _)) = got.and_then(|at| window.pin_to_border(at)) {
            canvas.mark(at, Mark::Wrong);
        }
    }
}

fn draw_outline(canvas: &mut Canvas, window: &Window, corners: [DVec2; 3]) {
    let page = corners.map(|corner| window.page_position(corner));
    canvas.polygon(&page, LineStyle::Outline, Fill::Tint(Ink::Text, 0.08));
    let middle = (page[0] + page[1] + page[2]) / 3.0;
    let mut labels: Vec<DVec2> = Vec::new();
    for (at, name) in page.into_iter().zip(["p0", "p1", "p2"]) {
        // The labels are moved away from the centre, so that none covers an edge or another label.
        let outward = (at - middle).normalize_or_zero();
        let mut label = at + 11.0 * outward + dvec2(0.0, 4.0);
        let is_taken = |other: &DVec2| (*other - label).abs().cmplt(dvec2(15.0, 11.0)).all();
        if labels.iter().any(is_taken) {
            label.x -= 17.0 * outward.x.signum();
        }
        labels.push(label);
        canvas.text(label, Anchor::Middle, Ink::Faint, name);
    }
}
