//! Draws the primitives and boxes involved in a flaw, projected onto the plane spanned by two axes.

use glam::{DVec2, DVec3, dvec2};
use judging::drawing_data::UpperLevels;
use judging::judge::tree::TreeCriteria;
use judging::judge::tree::bounds::Bounds;
use judging::judge::tree::defect::TreeDefect;
use judging::judge::tree::reached_nodes::ReachedNode;
use protocol::Shape;

use super::flaw::Flaw;
use super::{from_left, primitives_below};
use crate::drawing::canvas::{Canvas, Mark, rectangle};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::numbers::point;
use crate::drawing::plane::{AXIS_NAMES, Plane};
use crate::drawing::shapes;
use crate::drawing::sheet::{Sheet, Symbol};
use crate::drawing::window::Window;

/// The maximum number of primitives to draw individually.
const MAX_PRIMITIVES: usize = 250;
/// The maximum number of marks. More marks would hide each other.
const MAX_MARKS: usize = 60;
/// The first split is only drawn if there are at most this many primitives.
const MAX_ROW_PRIMITIVES: usize = 32;

/// Draws the flaw and its legend, if the flaw can be drawn.
pub(super) fn draw(
    sheet: &mut Sheet,
    criteria: &TreeCriteria,
    sweep: Option<&UpperLevels>,
    nodes: &[ReachedNode],
    flaw: &Flaw,
) {
    match (&flaw.defect, &flaw.node) {
        (Some(TreeDefect::BoxTooSmall(_) | TreeDefect::BoxTooLarge(_)), Some(node)) => {
            draw_boxes(sheet, criteria.shapes, &primitives_below(nodes, node), node);
        }
        (Some(TreeDefect::Partition { .. }), _) => draw_partition(sheet, criteria, flaw),
        (Some(TreeDefect::Cost { .. }) | None, _) if criteria.sweep_cost.is_some() => {
            let plane = sweep.and_then(|sweep| sweep.plane);
            let is_small = criteria.shapes.len() <= MAX_ROW_PRIMITIVES;
            if let Some(plane) = plane.filter(|_| is_small) {
                draw_row(sheet, criteria, nodes, plane);
            }
        }
        _ => {}
    }
}

/// Returns the plane spanned by `axis` and whichever of the other two axes has the larger `size`.
fn plane_containing(axis: usize, size: DVec3) -> Plane {
    let (p, q) = ((axis + 1) % 3, (axis + 2) % 3);
    Plane::of(axis, if size[p] >= size[q] { p } else { q })
}

/// Returns the axis with the largest value.
fn largest(value: impl Fn(usize) -> f64) -> usize {
    let axis = (0..3).max_by(|&a, &b| value(a).total_cmp(&value(b)));
    axis.unwrap_or(0)
}

fn draw_boxes(sheet: &mut Sheet, shapes: &[Shape], below: &[usize], node: &ReachedNode) {
    let (needs, has) = (node.tight_bounds, Bounds::of_node(node.node));
    let out = |axis: usize| {
        let out = [needs.min - has.min, needs.max - has.max].map(|out| out[axis].abs());
        // A box with a NaN coordinate is treated as infinitely wrong.
        let [below, above] = out.map(|out| if out.is_nan() { f64::INFINITY } else { out });
        below.max(above)
    };
    let plane = plane_containing(largest(out), needs.max - needs.min);
    let corners = |bounds: Bounds| [bounds.min, bounds.max].map(|corner| plane.project(corner));
    let (right, got) = (corners(needs), corners(has));
    let reach = 6.0 * right[0].distance(right[1]).max(1e-9);
    let near = got.into_iter().filter(|at| at.distance(right[0]) < reach);
    let seen: Vec<DVec2> = right.into_iter().chain(near).collect();

    sheet.title(&format!("node {}: {}", node.index, plane.name()));
    let window = sheet.window(seen);
    let canvas = &mut sheet.canvas;
    let shapes = below.iter().map(|&index| &shapes[index]);
    draw_outlines(canvas, &window, plane, shapes);
    draw_frame(canvas, &window, right, LineStyle::Right);
    draw_frame(canvas, &window, got, LineStyle::Wrong);
    let wanted = "the tightest box around the contents";
    sheet.add_wanted(Symbol::Line(LineStyle::Right), wanted);
    let corners = format!("{} to {}", point(has.min), point(has.max));
    sheet.add_got(Symbol::Line(LineStyle::Wrong), &corners);
}

fn draw_frame(canvas: &mut Canvas, window: &Window, [min, max]: [DVec2; 2], line: LineStyle) {
    let corners = rectangle(min, max);
    for i in 0..4 {
        canvas.segment(window, [corners[i], corners[(i + 1) % 4]], line);
    }
}

fn draw_partition(sheet: &mut Sheet, criteria: &TreeCriteria, flaw: &Flaw) {
    let mut all = Bounds::EMPTY;
    for shape in criteria.shapes {
        all.enclose(Bounds::of_shape(shape));
    }
    let size = all.max - all.min;
    let plane = plane_containing(largest(|axis| size[axis]), size);
    let seen = [all.min, all.max]
        .map(|corner| plane.project(corner))
        .to_vec();
    sheet.title(&plane.name());
    let window = sheet.window(seen);
    let canvas = &mut sheet.canvas;
    draw_outlines(canvas, &window, plane, criteria.shapes.iter());
    let mut mark = |indices: &[usize], mark: Mark| {
        for &index in indices.iter().take(MAX_MARKS) {
            let bounds = Bounds::of_shape(&criteria.shapes[index]);
            let middle = plane.project(bounds.center());
            canvas.mark(window.page_position(middle), mark);
        }
    };
    mark(&flaw.missing, Mark::Wrong);
    mark(&flaw.duplicated, Mark::Origin);
    if !flaw.missing.is_empty() {
        sheet.add_got(Symbol::Mark(Mark::Wrong), "in no leaf");
    }
    if !flaw.duplicated.is_empty() {
        sheet.add_got(Symbol::Mark(Mark::Origin), "in more than one leaf");
    }
}

/// Draws the first split along one axis, with one child's primitives above the line and the other's
/// below.
fn draw_row(
    sheet: &mut Sheet,
    criteria: &TreeCriteria,
    nodes: &[ReachedNode],
    (axis, at): (u8, f32),
) {
    let axis = usize::from(axis.min(2));
    let center_along_axis =
        |primitive: &usize| Bounds::of_shape(&criteria.shapes[*primitive]).center()[axis];
    let centers = |node| -> Vec<f64> {
        let below = primitives_below(nodes, node);
        below.iter().map(center_along_axis).collect()
    };
    let children = from_left(nodes).filter(|node| node.level == 1);
    let sides: Vec<Vec<f64>> = children.map(centers).collect();
    let all = sides.iter().flatten().map(|x| dvec2(*x, 0.0));
    sheet.title(&format!("the first split, along {}", AXIS_NAMES[axis]));
    let panel = sheet.panel(74.0);
    let window = Window::around(panel, all.chain([dvec2(at.into(), 0.0)]));
    let canvas = &mut sheet.canvas;
    let y = 0.5 * (panel.min.y + panel.max.y);
    canvas.line(
        dvec2(panel.min.x, y),
        dvec2(panel.max.x, y),
        LineStyle::Grid,
    );
    for (side, up) in sides.iter().zip([-1.0, 1.0]) {
        for x in side.iter().map(|x| window.page_position(dvec2(*x, 0.0)).x) {
            let (from, to) = (dvec2(x - 1.5, y), dvec2(x + 1.5, y + 20.0 * up));
            canvas.area(from, to, Fill::Tint(Ink::Wrong, 1.0));
        }
    }
    let x = window.page_position(dvec2(at.into(), 0.0)).x;
    canvas.line(
        dvec2(x, panel.min.y),
        dvec2(x, panel.max.y),
        LineStyle::Right,
    );
    sheet.add_wanted(Symbol::Line(LineStyle::Right), "the best splitting plane");
    let counts: Vec<String> = sides.iter().map(|side| side.len().to_string()).collect();
    let text = format!(
        "{} primitives, one child above, the other below",
        counts.join(" and ")
    );
    sheet.add_got(Symbol::Area(Fill::Tint(Ink::Wrong, 1.0)), &text);
}

/// Draws the outlines of the first [`MAX_PRIMITIVES`] primitives.
fn draw_outlines<'a>(
    canvas: &mut Canvas,
    window: &Window,
    plane: Plane,
    all: impl Iterator<Item = &'a Shape>,
) {
    let fill = Fill::Tint(Ink::Text, 0.12);
    let page = |at: DVec3| window.page_position(plane.project(at));
    let mut triangles = Vec::new();
    for shape in all.take(MAX_PRIMITIVES) {
        if let &Shape::Sphere { center, radius, .. } = shape {
            let radius = window.page_length(radius.into());
            canvas.circle(page(center.as_dvec3()), radius, LineStyle::Grid, fill);
        } else {
            triangles.push(shapes::corners(shape).map(page));
        }
    }
    canvas.polygons(&triangles, LineStyle::Grid, fill);
}
