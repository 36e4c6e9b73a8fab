//! Draws lights as they are seen from the point that they light: a picture of the directions around
//! one direction.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, dvec2};
use protocol::Value;
use protocol::light::lights::{FlatLight, ListedLight, SphericalLight};

use super::row::{RowComparison, last_direction};
use crate::drawing::Drawing;
use crate::drawing::canvas::{Canvas, Mark};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::numbers::short;
use crate::drawing::sheet::{Sheet, Symbol};
use crate::drawing::window::Window;

/// The number of parts that each edge is drawn in, since straight edges appear bent.
const PARTS: u32 = 6;
/// The number of corners that a sphere is drawn with.
const CORNERS: u32 = 24;
/// The height of the picture, in page units.
const HEIGHT: f64 = 220.0;
/// The maximum angle between the picture's centre and a mark that the picture should show.
const MAX_DEGREES: f64 = 100.0;

/// Draws the lights, and the expected and the submitted direction, or the direction whose density
/// is computed.
pub(super) fn draw(lights: &[ListedLight], row: &RowComparison) -> Option<Drawing> {
    let from = row.input.values().find_map(|value| {
        if let Value::Point(point) = value {
            Some(point.as_dvec3())
        } else {
            None
        }
    })?;
    let asked = last_direction(row.input.as_ref());
    let (wanted, got) = (row.wanted_direction(), row.wrong_direction());
    let toward = |light: &ListedLight| match light {
        ListedLight::Flat(light) => light.corner.as_dvec3() - from,
        ListedLight::Sphere(light) => light.center.as_dvec3() - from,
    };
    let center = asked.or(wanted).or(got);
    let view = View::new(from, center.or_else(|| lights.first().map(toward))?)?;
    let outlines = lights.iter().filter_map(|light| view.outline(light));
    let outlines: Vec<Outline> = outlines.collect();
    let marks = [
        (asked, Mark::Origin),
        (wanted, Mark::Right),
        (got, Mark::Wrong),
    ];
    let marks = marks.map(|(direction, mark)| (direction.and_then(|to| view.project(to)), mark));

    // The picture shows the marks and the light that is nearest to its centre.
    let nearest = outlines
        .iter()
        .min_by(|a, b| a.distance().total_cmp(&b.distance()));
    let points = nearest.iter().flat_map(|outline| outline.points.iter());
    let points = points.chain(marks.iter().filter_map(|(point, _)| point.as_ref()));
    let near = points.filter(|point| point.length() < MAX_DEGREES);
    let half = near.fold(1.0, |most: f64, point| most.max(point.abs().max_element()));

    let mut sheet = Sheet::default();
    sheet.title("the lights, as seen from the point");
    let panel = sheet.panel(HEIGHT);
    let window = Window::around(panel, [DVec2::splat(-half), DVec2::splat(half)]);
    for outline in &outlines {
        outline.draw(&mut sheet.canvas, &window);
    }
    for (point, mark) in marks {
        sheet.canvas.mark_pinned(&window, point, mark);
    }
    row.add_results(&mut sheet, [Mark::Right, Mark::Wrong].map(Symbol::Mark));
    let is_off = |point: DVec2| window.distance_outside(point) > 0.0;
    if got.is_some() && marks[2].0.is_none_or(is_off) {
        sheet.add_legend(Symbol::None, "your direction is outside the picture");
    }
    if asked.is_some() {
        sheet.add_legend(Symbol::Mark(Mark::Origin), "the direction");
    }
    for (is_lit, text) in [(true, "a light"), (false, "a light that faces away")] {
        let mut alike = outlines.iter().filter(|outline| outline.is_lit == is_lit);
        if alike.any(|outline| !outline.points.iter().all(|point| is_off(*point))) {
            sheet.add_legend(Symbol::Line(style(is_lit).0), text);
        }
    }
    let text = format!(
        "the picture is {}° high",
        short(window.world_length(HEIGHT))
    );
    sheet.add_legend(Symbol::None, &text);
    Some(sheet.finish("The lights as seen from the point", row.caption()))
}

fn style(is_lit: bool) -> (LineStyle, Fill) {
    if is_lit {
        (LineStyle::Outline, Fill::Tint(Ink::Text, 0.12))
    } else {
        (LineStyle::Behind, Fill::None)
    }
}

/// A view from a point in a direction.
struct View {
    from: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
}

impl View {
    fn new(from: DVec3, direction: DVec3) -> Option<View> {
        let forward = direction.try_normalize()?;
        let right = forward.cross(DVec3::Y).try_normalize();
        let right = right.unwrap_or(DVec3::X);
        Some(View {
            from,
            forward,
            right,
            up: right.cross(forward),
        })
    }

    /// Projects a direction. The distance from the centre is the angle to it, in degrees. Returns
    /// `None` for the opposite direction, which is everywhere on the border.
    fn project(&self, direction: DVec3) -> Option<DVec2> {
        let unit = direction.try_normalize()?;
        let angle = unit.angle_between(self.forward).to_degrees();
        let aside = dvec2(unit.dot(self.right), unit.dot(self.up));
        (angle < 179.0).then(|| angle * aside.normalize_or_zero())
    }

    /// Returns a light's outline, or `None` if a part of it is directly behind the viewer.
    fn outline(&self, light: &ListedLight) -> Option<Outline> {
        match light {
            ListedLight::Flat(light) => self.outline_of_flat(light),
            ListedLight::Sphere(light) => self.outline_of_sphere(light),
        }
    }

    /// Returns a sphere's outline, or `None` if the viewer is inside.
    fn outline_of_sphere(&self, light: &SphericalLight) -> Option<Outline> {
        let center = light.center.as_dvec3() - self.from;
        let sine = f64::from(light.radius) / center.length();
        let cosine = (sine < 1.0).then(|| (1.0 - sine * sine).sqrt())?;
        let forward = center.normalize();
        let (right, up) = forward.any_orthonormal_pair();
        let corner = |index: u32| {
            let turn = TAU * f64::from(index) / f64::from(CORNERS);
            let aside = turn.cos() * right + turn.sin() * up;
            self.project(cosine * forward + sine * aside)
        };
        Some(Outline {
            points: (0..CORNERS).map(corner).collect::<Option<Vec<DVec2>>>()?,
            is_lit: true,
        })
    }

    fn outline_of_flat(&self, light: &FlatLight) -> Option<Outline> {
        let corner = light.corner.as_dvec3();
        let [first, second] = light.edges.map(|edge| edge.as_dvec3());
        let mut corners = vec![corner, corner + first];
        if !light.is_triangle {
            corners.push(corner + first + second);
        }
        corners.push(corner + second);
        let mut points = Vec::new();
        for (index, corner) in corners.iter().enumerate() {
            let next = corners[(index + 1) % corners.len()];
            for part in 0..PARTS {
                let at = corner.lerp(next, f64::from(part) / f64::from(PARTS));
                points.push(self.project(at - self.from)?);
            }
        }
        let is_lit = first.cross(second).dot(self.from - corner) > 0.0;
        Some(Outline { points, is_lit })
    }
}

/// The outline of a light in the picture.
struct Outline {
    points: Vec<DVec2>,
    /// Whether the light emits toward the point.
    is_lit: bool,
}

impl Outline {
    /// Returns the distance between the centre of the picture and the middle of the light.
    fn distance(&self) -> f64 {
        let sum: DVec2 = self.points.iter().sum();
        sum.length() / self.points.len() as f64
    }

    fn draw(&self, canvas: &mut Canvas, window: &Window) {
        let (line, fill) = style(self.is_lit);
        let pinned = self.points.iter().map(|point| window.pin_to_border(*point));
        let inside = pinned.map(|pinned| pinned.filter(|(_, is_off)| !is_off));
        if let Some(page) = inside.map(|at| Some(at?.0)).collect::<Option<Vec<DVec2>>>() {
            // A single element keeps a drawing of many lights small.
            canvas.polygon(&page, line, fill);
            return;
        }
        let next = self.points.iter().cycle().skip(1);
        for (from, to) in self.points.iter().zip(next) {
            canvas.segment(window, [*from, *to], line);
        }
    }
}
