//! Draws a correct path in a room, with the throughput at each hit and the light that the path adds
//! there. Students can print the same numbers in their own loop.

use glam::{DVec2, DVec3, Vec3, dvec2};
use judging::drawing_data::{PathHit, PathStep};
use protocol::Ray;

use super::row::RowComparison;
use crate::drawing::Drawing;
use crate::drawing::canvas::{Anchor, Mark};
use crate::drawing::ink::{Ink, LineStyle};
use crate::drawing::numbers::point;
use crate::drawing::plane::AXIS_NAMES;
use crate::drawing::sheet::{Sheet, Symbol};

/// The maximum number of hits that are described in the legend.
const MAX_DESCRIBED: usize = 8;

/// Draws a path from the origin of its ray. Returns `None` for a path without steps.
pub(super) fn draw(ray: &Ray, steps: &[PathStep], row: &RowComparison) -> Option<Drawing> {
    let last = steps.last()?;
    let hits = steps.iter().map(|step| step.position.as_dvec3());
    let points: Vec<DVec3> = std::iter::once(ray.origin.as_dvec3()).chain(hits).collect();
    let axis = shortest_side(&points);
    let seen: Vec<DVec2> = points.iter().map(|point| project(axis, *point)).collect();

    let mut sheet = Sheet::default();
    let axis = AXIS_NAMES[axis];
    sheet.title(&format!("a correct path, seen along the {axis}-axis"));
    let window = sheet.window(seen.clone());
    for pair in seen.windows(2) {
        let arrow = [pair[0], pair[1]];
        sheet.canvas.arrow(&window, arrow, LineStyle::Ray);
    }
    sheet
        .canvas
        .mark_pinned(&window, seen.first().copied(), Mark::Origin);
    for (number, at) in (1..).zip(&seen[1..]) {
        let label = window.page_position(*at) + dvec2(7.0, -5.0);
        sheet
            .canvas
            .text(label, Anchor::Start, Ink::Text, &number.to_string());
    }
    for (number, step) in (1..).zip(steps).take(MAX_DESCRIBED) {
        let throughput = point(step.throughput.as_dvec3());
        let text = format!("{number}. {}, throughput {throughput}", name(step.hit));
        sheet.add_legend(Symbol::None, &text);
        sheet.add_legend(Symbol::None, &format!("adds {}", light(step)));
    }
    if steps.len() > MAX_DESCRIBED {
        let count = steps.len() - MAX_DESCRIBED;
        let text = format!("{count} more hits, and the last one adds {}", light(last));
        sheet.add_legend(Symbol::None, &text);
    }
    row.add_results(&mut sheet, [Symbol::None, Symbol::None]);
    Some(sheet.finish("A correct path, with its weights", row.caption()))
}

fn name(hit: PathHit) -> &'static str {
    match hit {
        PathHit::Nothing => "no hit",
        PathHit::Matte => "matte",
        PathHit::Mirror => "mirror",
        PathHit::Glass => "glass",
        PathHit::Light => "light",
    }
}

fn light(step: &PathStep) -> String {
    if step.light == Vec3::ZERO {
        return "nothing".to_owned();
    }
    point(step.light.as_dvec3())
}

/// Returns the axis of the shortest side of the box around these points.
fn shortest_side(points: &[DVec3]) -> usize {
    let min = points.iter().copied().reduce(DVec3::min);
    let max = points.iter().copied().reduce(DVec3::max);
    let size = max.unwrap_or_default() - min.unwrap_or_default();
    let mut sides = size.to_array().into_iter();
    let axis = sides.position(|side| side == size.min_element());
    axis.unwrap_or(2)
}

/// Projects a point along an axis. The y-axis points up, unless the view is along it: then −z does.
fn project(axis: usize, DVec3 { x, y, z }: DVec3) -> DVec2 {
    match axis {
        0 => dvec2(-z, y),
        1 => dvec2(x, -z),
        _ => dvec2(x, y),
    }
}
