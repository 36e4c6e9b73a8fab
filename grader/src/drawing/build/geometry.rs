//! The primitives and boxes that a flaw is about, along the axis that tells least.

use glam::{DVec2, DVec3, dvec2};
use protocol::Shape;

use super::flaw::Flaw;
use super::{BuildCase, NodePosition, primitives_below};
use crate::drawing::canvas::{Canvas, Mark};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::numbers::point;
use crate::drawing::sheet::{Sheet, Symbol};
use crate::drawing::sphere;
use crate::drawing::window::Window;
use crate::drawing_data::Sweep;
use crate::judge::tree::bounds::Bounds;

/// More primitives than these are not drawn one by one.
const MAX_PRIMITIVES: usize = 250;
/// More marks than these hide each other.
const MAX_MARKS: usize = 60;
/// A row of so few is drawn with the sides that they went to.
const MAX_ROW_PRIMITIVES: usize = 32;

const AXIS_NAMES: [&str; 3] = ["x", "y", "z"];

/// What there is to see of the flaw, and what it means.
pub(super) fn draw(
    sheet: &mut Sheet,
    task: &BuildCase,
    sweep: Option<&Sweep>,
    placed: &[NodePosition],
    flaw: &Flaw,
) {
    match flaw {
        Flaw::TooSmall(node) | Flaw::TooLarge(node) => {
            draw_boxes(sheet, task, &primitives_below(placed, node), node);
        }
        Flaw::Partition {
            missing: lost,
            duplicated: doubled,
        } => draw_partition(sheet, task, lost, doubled),
        Flaw::Cost(_) if task.shapes.len() <= MAX_ROW_PRIMITIVES => {
            if let Some(plane) = sweep.and_then(|sweep| sweep.plane) {
                draw_row(sheet, task, placed, plane);
            }
        }
        Flaw::LeafTooLarge(_)
        | Flaw::NotSplit(_)
        | Flaw::NeedlessSplit(_)
        | Flaw::Cost(_)
        | Flaw::None => {}
    }
}

/// Two of the axes.
#[derive(Clone, Copy)]
struct Plane(usize, usize);

impl Plane {
    fn project(self, point: DVec3) -> DVec2 {
        dvec2(point[self.0], point[self.1])
    }

    fn name(self) -> String {
        let (a, b) = (self.0, self.1);
        format!("{} to the right, {} up", AXIS_NAMES[a], AXIS_NAMES[b])
    }

    /// The one in which `axis` is seen, beside the longer of the two others.
    fn containing(axis: usize, size: DVec3) -> Plane {
        let (p, q) = ((axis + 1) % 3, (axis + 2) % 3);
        let other = if size[p] >= size[q] { p } else { q };
        Plane(axis.min(other), axis.max(other))
    }
}

fn draw_boxes(sheet: &mut Sheet, task: &BuildCase, primitives: &[usize], node: &NodePosition) {
    let (needs, has) = (node.cell.tight_bounds, Bounds::of_node(node.cell.node));
    let out = |axis: usize| {
        let below = (needs.min[axis] - has.min[axis]).abs();
        let above = (needs.max[axis] - has.max[axis]).abs();
        // What is not a number is the worst.
        let out = below.max(above);
        if below.is_nan() || above.is_nan() {
            f64::INFINITY
        } else {
            out
        }
    };
    let worst = (0..3)
        .max_by(|&a, &b| out(a).total_cmp(&out(b)))
        .unwrap_or(0);
    let plane = Plane::containing(worst, needs.max - needs.min);
    let corners = |bounds: Bounds| [bounds.min, bounds.max].map(|corner| plane.project(corner));
    let (right, got) = (corners(needs), corners(has));
    let reach = 6.0 * right[0].distance(right[1]).max(1e-9);
    let near = got.into_iter().filter(|at| at.distance(right[0]) < reach);
    let seen: Vec<DVec2> = right.into_iter().chain(near).collect();

    sheet.title(&format!("node {}: {}", node.cell.index, plane.name()));
    let part = sheet.panel(sphere::panel_height(&seen));
    let window = Window::around(part, seen);
    let canvas = &mut sheet.canvas;
    let shapes = primitives.iter().map(|&place| &task.shapes[place]);
    draw_outlines(canvas, &window, plane, shapes);
    draw_frame(canvas, &window, right, LineStyle::Right);
    draw_frame(canvas, &window, got, LineStyle::Wrong);
    sheet.add_legend(
        Symbol::Line(LineStyle::Right),
        "wanted: around all that is below the node",
    );
    let min_max = [has.min, has.max].map(point);
    let words = format!("got: {} to {}", min_max[0], min_max[1]);
    sheet.add_legend(Symbol::Line(LineStyle::Wrong), &words);
}

fn draw_frame(canvas: &mut Canvas, window: &Window, [min, max]: [DVec2; 2], line: LineStyle) {
    let corners = [min, dvec2(max.x, min.y), max, dvec2(min.x, max.y)];
    for i in 0..4 {
        if let Some((from, to)) = window.clip_segment(corners[i], corners[(i + 1) % 4]) {
            canvas.line(from, to, line);
        }
    }
}

fn draw_partition(sheet: &mut Sheet, task: &BuildCase, lost: &[usize], doubled: &[usize]) {
    let mut all = Bounds::EMPTY;
    for shape in task.shapes {
        all.enclose(Bounds::of_shape(shape));
    }
    let size = all.max - all.min;
    let longest = (0..3)
        .max_by(|&a, &b| size[a].total_cmp(&size[b]))
        .unwrap_or(0);
    let plane = Plane::containing(longest, size);
    let seen = [all.min, all.max].map(|corner| plane.project(corner));
    sheet.title(&plane.name());
    let part = sheet.panel(sphere::panel_height(&seen));
    let window = Window::around(part, seen);
    let canvas = &mut sheet.canvas;
    draw_outlines(canvas, &window, plane, task.shapes.iter());
    let mut mark = |places: &[usize], mark: Mark| {
        for &place in places.iter().take(MAX_MARKS) {
            let bounds = Bounds::of_shape(&task.shapes[place]);
            let middle = plane.project(0.5 * (bounds.min + bounds.max));
            canvas.mark(window.to_page(middle), mark);
        }
    };
    mark(lost, Mark::Wrong);
    mark(doubled, Mark::Origin);
    if !lost.is_empty() {
        sheet.add_legend(Symbol::Mark(Mark::Wrong), "got: in no leaf");
    }
    if !doubled.is_empty() {
        sheet.add_legend(Symbol::Mark(Mark::Origin), "got: in more than one leaf");
    }
}

/// A few primitives in a row: those of one side of the root above the line, the others below.
fn draw_row(sheet: &mut Sheet, task: &BuildCase, placed: &[NodePosition], (axis, at): (u8, f32)) {
    let axis = usize::from(axis.min(2));
    let place = |primitive: &usize| {
        let bounds = Bounds::of_shape(&task.shapes[*primitive]);
        0.5 * (bounds.min[axis] + bounds.max[axis])
    };
    let sides: Vec<Vec<f64>> = placed
        .iter()
        .filter(|node| node.level == 1)
        .map(|node| primitives_below(placed, node).iter().map(place).collect())
        .collect();
    let all = sides.iter().flatten().map(|x| dvec2(*x, 0.0));
    sheet.title(&format!("the first split, along {}", AXIS_NAMES[axis]));
    let part = sheet.panel(74.0);
    let window = Window::around(part, all.chain([dvec2(at.into(), 0.0)]));
    let canvas = &mut sheet.canvas;
    let y = 0.5 * (part.min.y + part.max.y);
    canvas.line(dvec2(part.min.x, y), dvec2(part.max.x, y), LineStyle::Grid);
    for (side, up) in sides.iter().zip([-1.0, 1.0]) {
        for x in side.iter().map(|x| window.to_page(dvec2(*x, 0.0)).x) {
            let (from, to) = (dvec2(x - 1.5, y), dvec2(x + 1.5, y + 20.0 * up));
            canvas.area(from, to, Fill::Tint(Ink::Wrong, 1.0));
        }
    }
    let x = window.to_page(dvec2(at.into(), 0.0)).x;
    canvas.line(dvec2(x, part.min.y), dvec2(x, part.max.y), LineStyle::Right);
    sheet.add_legend(
        Symbol::Line(LineStyle::Right),
        "wanted: the best plane between two of them",
    );
    let counts: Vec<String> = sides.iter().map(|side| side.len().to_string()).collect();
    let words = format!("got: {}, one side up, the other down", counts.join(" and "));
    sheet.add_legend(Symbol::Area(Fill::Tint(Ink::Wrong, 1.0)), &words);
}

/// The primitives as they are seen, the first of many.
fn draw_outlines<'a>(
    canvas: &mut Canvas,
    window: &Window,
    plane: Plane,
    shapes: impl Iterator<Item = &'a Shape>,
) {
    let fill = Fill::Tint(Ink::Text, 0.12);
    let page = |at: DVec3| window.to_page(plane.project(at));
    let mut triangles = Vec::new();
    for shape in shapes.take(MAX_PRIMITIVES) {
        match *shape {
            Shape::Triangle { vertices, .. } => {
                triangles.push(vertices.map(|vertex| page(vertex.position.as_dvec3())));
            }
            Shape::FlatTriangle { corners, .. } => {
                triangles.push(corners.map(|corner| page(corner.as_dvec3())));
            }
            Shape::Sphere { center, radius, .. } => {
                let radius = window.to_page_length(radius.into());
                canvas.circle(page(center.as_dvec3()), radius, LineStyle::Grid, fill);
            }
        }
    }
    canvas.polygons(&triangles, LineStyle::Grid, fill);
}
