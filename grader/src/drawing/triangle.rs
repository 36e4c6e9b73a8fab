//! Draws a ray and a triangle as seen from two directions: along the ray, where the ray appears as
//! a point inside or outside the triangle, and from the side, where the triangle's plane appears as
//! a line.

use glam::{DVec2, DVec3, dvec2};
use protocol::Vertex;

use super::Drawing;
use super::canvas::{Anchor, Canvas, Mark};
use super::hit_comparison::{Focus, HitComparison};
use super::ink::{Fill, Ink, LineStyle};
use super::sheet::Sheet;
use super::side::SideView;
use super::uv;
use super::window::{Panel, Window};

/// Draws a ray and a triangle.
pub(super) fn draw(comparison: &HitComparison, vertices: &[Vertex; 3]) -> Drawing {
    let corners = vertices.map(|vertex| vertex.position.as_dvec3());
    let [p0, p1, p2] = corners;
    // In a plane that contains the ray and the normal, the triangle is seen edge-on. A degenerate
    // triangle has no normal, so use the first edge instead.
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
    let window = Window::around(right, side.landmarks(&seen));
    if is_uv {
        let uvs = vertices.map(|vertex| vertex.uv.as_dvec2());
        uv::draw_square(&mut sheet.canvas, right, comparison, &uvs);
    } else {
        draw_outline(&mut sheet.canvas, &window, seen);
        side.draw_ray(&mut sheet.canvas, &window);
        side.draw_hits(&mut sheet.canvas, &window);
    }
    side.draw_legend(&mut sheet, &window);
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
        let got = comparison.got_point();
        let got = got.map(|point| side.project_along_ray(point));
        canvas.mark_pinned(&window, got, Mark::Wrong);
    }
}

fn draw_outline(canvas: &mut Canvas, window: &Window, corners: [DVec2; 3]) {
    let page = corners.map(|corner| window.page_position(corner));
    canvas.polygon(&page, LineStyle::Outline, Fill::Tint(Ink::Text, 0.08));
    for (label, name) in label_positions(page).into_iter().zip(["p0", "p1", "p2"]) {
        canvas.text(label, Anchor::Middle, Ink::Faint, name);
    }
}

/// The size of a label, with some space around it.
const LABEL: DVec2 = dvec2(16.0, 12.0);

/// Returns the positions of the corners' labels. They are placed away from the centre so that they
/// don't cover an edge, and they never overlap, even if corners coincide.
fn label_positions(corners: [DVec2; 3]) -> Vec<DVec2> {
    /// Offsets to try, as multiples of the label's size. Two labels can block at most four of them.
    const STEPS: [DVec2; 9] = [
        dvec2(0.0, 0.0),
        dvec2(-1.0, 0.0),
        dvec2(1.0, 0.0),
        dvec2(0.0, -1.0),
        dvec2(0.0, 1.0),
        dvec2(-2.0, 0.0),
        dvec2(2.0, 0.0),
        dvec2(0.0, -2.0),
        dvec2(0.0, 2.0),
    ];
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    let mut labels: Vec<DVec2> = Vec::new();
    for corner in corners {
        let outward = (corner - middle).normalize_or_zero();
        let label = corner + 11.0 * outward + dvec2(0.0, 4.0);
        let is_free = |at: &DVec2| labels.iter().all(|other| !overlap(*other, *at));
        let mut positions = STEPS.into_iter().map(|step| label + step * LABEL);
        labels.push(positions.find(is_free).unwrap_or(label));
    }
    labels
}

fn overlap(a: DVec2, b: DVec2) -> bool {
    (a - b).abs().cmplt(0.99 * LABEL).all()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn corner() -> impl Strategy<Value = DVec2> {
        // Use a coarse grid, so that corners often coincide or are near each other.
        (0_i32..8, 0_i32..8).prop_map(|(x, y)| dvec2(f64::from(x), f64::from(y)) * 4.0)
    }

    proptest! {
        #[test]
        fn labels_never_overlap(a in corner(), b in corner(), c in corner()) {
            let labels = label_positions([a, b, c]);
            prop_assert!(!overlap(labels[0], labels[1]), "{labels:?}");
            prop_assert!(!overlap(labels[0], labels[2]), "{labels:?}");
            prop_assert!(!overlap(labels[1], labels[2]), "{labels:?}");
        }
    }
}
