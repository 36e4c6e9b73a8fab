//! The primitives and boxes that a flaw is about, along the axis that tells least.

use glam::{DVec2, DVec3, dvec2};
use protocol::Shape;

use super::flaw::Flaw;
use super::{Placed, Task, below};
use crate::drawing::canvas::{Canvas, Mark};
use crate::drawing::ink::{Fill, Ink, Line};
use crate::drawing::sheet::{Sheet, Sign};
use crate::drawing::sphere;
use crate::drawing::window::Window;
use crate::drawing::words::point;
use crate::judge::tree::bounds::Bounds;
use crate::shown::Sweep;

/// More primitives than these are not drawn one by one.
const MOST: usize = 250;
/// More marks than these hide each other.
const MOST_MARKS: usize = 60;
/// A row of so few is drawn with the sides that they went to.
const FEW: usize = 32;

const NAMES: [&str; 3] = ["x", "y", "z"];

/// What there is to see of the flaw, and what it means.
pub(super) fn draw(
    sheet: &mut Sheet,
    task: &Task,
    sweep: Option<&Sweep>,
    placed: &[Placed],
    flaw: &Flaw,
) {
    match flaw {
        Flaw::TooSmall(node) | Flaw::TooLarge(node) => {
            boxes(sheet, task, &below(placed, node), node);
        }
        Flaw::Partition { lost, doubled } => partition(sheet, task, lost, doubled),
        Flaw::Cost(_) if task.shapes.len() <= FEW => {
            if let Some(plane) = sweep.and_then(|sweep| sweep.plane) {
                row(sheet, task, placed, plane);
            }
        }
        Flaw::Leaf(_) | Flaw::NotSplit(_) | Flaw::Split(_) | Flaw::Cost(_) | Flaw::None => {}
    }
}

/// Two of the axes.
#[derive(Clone, Copy)]
struct Plane(usize, usize);

impl Plane {
    fn see(self, point: DVec3) -> DVec2 {
        dvec2(point[self.0], point[self.1])
    }

    fn name(self) -> String {
        let (a, b) = (self.0, self.1);
        format!("{} to the right, {} up", NAMES[a], NAMES[b])
    }

    /// The one in which `axis` is seen, beside the longer of the two others.
    fn with(axis: usize, size: DVec3) -> Plane {
        let (p, q) = ((axis + 1) % 3, (axis + 2) % 3);
        let other = if size[p] >= size[q] { p } else { q };
        Plane(axis.min(other), axis.max(other))
    }
}

fn boxes(sheet: &mut Sheet, task: &Task, primitives: &[usize], node: &Placed) {
    let (needs, has) = (node.cell.needs, Bounds::of(node.cell.node));
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
    let plane = Plane::with(worst, needs.max - needs.min);
    let corners = |bounds: Bounds| [bounds.min, bounds.max].map(|corner| plane.see(corner));
    let (right, got) = (corners(needs), corners(has));
    let reach = 6.0 * right[0].distance(right[1]).max(1e-9);
    let near = got.into_iter().filter(|at| at.distance(right[0]) < reach);
    let seen: Vec<DVec2> = right.into_iter().chain(near).collect();

    sheet.title(&format!("node {}: {}", node.cell.place, plane.name()));
    let part = sheet.panel(sphere::height(&seen));
    let window = Window::around(part, seen);
    let canvas = &mut sheet.canvas;
    let shapes = primitives.iter().map(|&place| &task.shapes[place]);
    outlines(canvas, &window, plane, shapes);
    frame(canvas, &window, right, Line::Right);
    frame(canvas, &window, got, Line::Wrong);
    sheet.explain(
        Sign::Line(Line::Right),
        "wanted: around all that is below the node",
    );
    let min_max = [has.min, has.max].map(point);
    let words = format!("got: {} to {}", min_max[0], min_max[1]);
    sheet.explain(Sign::Line(Line::Wrong), &words);
}

fn frame(canvas: &mut Canvas, window: &Window, [min, max]: [DVec2; 2], line: Line) {
    let corners = [min, dvec2(max.x, min.y), max, dvec2(min.x, max.y)];
    for i in 0..4 {
        if let Some((from, to)) = window.clipped(corners[i], corners[(i + 1) % 4]) {
            canvas.line(from, to, line);
        }
    }
}

fn partition(sheet: &mut Sheet, task: &Task, lost: &[usize], doubled: &[usize]) {
    let mut all = Bounds::EMPTY;
    for shape in task.shapes {
        all.enclose(Bounds::around(shape));
    }
    let size = all.max - all.min;
    let longest = (0..3)
        .max_by(|&a, &b| size[a].total_cmp(&size[b]))
        .unwrap_or(0);
    let plane = Plane::with(longest, size);
    let seen = [all.min, all.max].map(|corner| plane.see(corner));
    sheet.title(&plane.name());
    let part = sheet.panel(sphere::height(&seen));
    let window = Window::around(part, seen);
    let canvas = &mut sheet.canvas;
    outlines(canvas, &window, plane, task.shapes.iter());
    let mut mark = |places: &[usize], mark: Mark| {
        for &place in places.iter().take(MOST_MARKS) {
            let bounds = Bounds::around(&task.shapes[place]);
            let middle = plane.see(0.5 * (bounds.min + bounds.max));
            canvas.mark(window.page(middle), mark);
        }
    };
    mark(lost, Mark::Wrong);
    mark(doubled, Mark::Origin);
    if !lost.is_empty() {
        sheet.explain(Sign::Mark(Mark::Wrong), "got: in no leaf");
    }
    if !doubled.is_empty() {
        sheet.explain(Sign::Mark(Mark::Origin), "got: in more than one leaf");
    }
}

/// A few primitives in a row: those of one side of the root above the line, the others below.
fn row(sheet: &mut Sheet, task: &Task, placed: &[Placed], (axis, at): (u8, f32)) {
    let axis = usize::from(axis.min(2));
    let place = |primitive: &usize| {
        let bounds = Bounds::around(&task.shapes[*primitive]);
        0.5 * (bounds.min[axis] + bounds.max[axis])
    };
    let sides: Vec<Vec<f64>> = placed
        .iter()
        .filter(|node| node.level == 1)
        .map(|node| below(placed, node).iter().map(place).collect())
        .collect();
    let all = sides.iter().flatten().map(|x| dvec2(*x, 0.0));
    sheet.title(&format!("the first split, along {}", NAMES[axis]));
    let part = sheet.panel(74.0);
    let window = Window::around(part, all.chain([dvec2(at.into(), 0.0)]));
    let canvas = &mut sheet.canvas;
    let y = 0.5 * (part.min.y + part.max.y);
    canvas.line(dvec2(part.min.x, y), dvec2(part.max.x, y), Line::Grid);
    for (side, up) in sides.iter().zip([-1.0, 1.0]) {
        for x in side.iter().map(|x| window.page(dvec2(*x, 0.0)).x) {
            let (from, to) = (dvec2(x - 1.5, y), dvec2(x + 1.5, y + 20.0 * up));
            canvas.area(from, to, Fill::Of(Ink::Wrong, 1.0));
        }
    }
    let x = window.page(dvec2(at.into(), 0.0)).x;
    canvas.line(dvec2(x, part.min.y), dvec2(x, part.max.y), Line::Right);
    sheet.explain(
        Sign::Line(Line::Right),
        "wanted: the best plane between two of them",
    );
    let counts: Vec<String> = sides.iter().map(|side| side.len().to_string()).collect();
    let words = format!("got: {}, one side up, the other down", counts.join(" and "));
    sheet.explain(Sign::Area(Fill::Of(Ink::Wrong, 1.0)), &words);
}

/// The primitives as they are seen, the first of many.
fn outlines<'a>(
    canvas: &mut Canvas,
    window: &Window,
    plane: Plane,
    shapes: impl Iterator<Item = &'a Shape>,
) {
    let fill = Fill::Of(Ink::Text, 0.12);
    let page = |at: DVec3| window.page(plane.see(at));
    let mut triangles = Vec::new();
    for shape in shapes.take(MOST) {
        match *shape {
            Shape::Triangle { vertices, .. } => {
                triangles.push(vertices.map(|vertex| page(vertex.position.as_dvec3())));
            }
            Shape::Facet { corners, .. } => {
                triangles.push(corners.map(|corner| page(corner.as_dvec3())));
            }
            Shape::Sphere { center, radius, .. } => {
                let radius = window.length(radius.into());
                canvas.circle(page(center.as_dvec3()), radius, Line::Grid, fill);
            }
        }
    }
    canvas.polygons(&triangles, Line::Grid, fill);
}
