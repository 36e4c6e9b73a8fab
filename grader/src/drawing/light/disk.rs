//! Draws all rows of a table about a matte surface on a disk, as seen from above the surface. The
//! projection keeps areas, so that the dots show the density of samples per solid angle.

use std::f64::consts::SQRT_2;

use glam::{DVec2, DVec3};
use judging::exam::ExamQuestion;
use protocol::{Answer, Record, Value};

use super::row::{RowComparison, angle_text, directions, last_direction};
use crate::drawing::Drawing;
use crate::drawing::canvas::{Canvas, Mark};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::sheet::{Sheet, Symbol};
use crate::drawing::window::Window;

/// The radius of the largest dot, in page units.
const MAX_RADIUS: f64 = 9.0;
/// The fill of dots that are right.
const RIGHT: Fill = Fill::Tint(Ink::Right, 0.75);
/// The fill of dots that are wrong.
const WRONG: Fill = Fill::Tint(Ink::Wrong, 0.3);

/// Draws the expected directions of all rows beside the submitted ones, or the expected values
/// beside the submitted ones at each row's direction. `row` is the row that the page shows.
pub(super) fn draw(
    question: &ExamQuestion,
    row: usize,
    answer: Option<&Answer>,
) -> Option<Drawing> {
    let count = question.question.count();
    let rows = (0..count).map(|row| RowComparison::new(question, row, answer));
    let rows: Vec<RowComparison> = rows.collect::<Option<_>>()?;
    let shown = rows.get(row)?;
    let dots = rows.iter().map(|row| {
        let wanted = Dot::new(row, row.wanted.as_deref(), true);
        (wanted, Dot::new(row, row.got, row.is_right()))
    });
    let (wanted, got): (Vec<Dot>, Vec<Dot>) = dots.unzip();
    let max = |dots: &[Dot]| {
        let values = dots.iter().filter_map(|dot| dot.value);
        values.filter(|value| value.is_finite()).fold(0.0, f64::max)
    };
    // Values that are far too large don't shrink all others to nothing.
    let largest = max(&got).clamp(max(&wanted), 4.0 * max(&wanted));
    let is_below = |dot: &Dot| dot.direction.is_some_and(|direction| direction.z < -1e-6);
    let has_below = wanted.iter().chain(&got).any(is_below);
    let edge = if has_below { SQRT_2 } else { 1.0 };

    let mut sheet = Sheet::default();
    let right = answer.map_or("got: no answer", |_| "got, from above");
    let panels = sheet.panels(["wanted, from above", right], 166.0);
    for (panel, dots) in panels.into_iter().zip([&wanted, &got]) {
        let window = Window::around(panel, [DVec2::splat(-edge), DVec2::splat(edge)]);
        let canvas = &mut sheet.canvas;
        let center = window.page_position(DVec2::ZERO);
        let radius = window.page_length(edge);
        canvas.circle(center, radius, LineStyle::Grid, Fill::None);
        let above = Fill::Tint(Ink::Text, 0.06);
        canvas.circle(center, window.page_length(1.0), LineStyle::Outline, above);
        for (index, dot) in dots.iter().enumerate() {
            dot.draw(canvas, &window, largest, index == row);
        }
    }
    let (what, symbols) = if wanted.iter().any(|dot| dot.value.is_some()) {
        let judged = shown.judged;
        let what = format!("a dot's area shows its {judged}; a small ring means 0");
        (what, [RIGHT, WRONG].map(Symbol::Area))
    } else {
        let what = format!("the directions of {count} samples");
        (what, [Mark::Right, Mark::Wrong].map(Symbol::Mark))
    };
    sheet.add_wanted(symbols[0], &what);
    if answer.is_some() {
        let wrong = rows.iter().filter(|row| !row.is_right()).count();
        let are = if wrong == 1 { "is" } else { "are" };
        sheet.add_got(symbols[1], &format!("{wrong} of these {count} {are} wrong"));
    }
    let out = directions(shown.input.as_ref()).next()?;
    let text = format!("the question above, where out is {}", angle_text(out));
    sheet.add_legend(Symbol::Mark(Mark::Origin), &text);
    let horizon = if has_below {
        "the horizon; directions outside this circle are below the surface"
    } else {
        "the horizon; the normal is in the middle"
    };
    sheet.add_legend(Symbol::Line(LineStyle::Outline), horizon);
    let title = "All calls on a disk, seen from above the surface";
    Some(sheet.finish(title, shown.caption()))
}

/// Projects the sphere onto a disk, with the normal in the middle and the horizon at radius 1. Areas
/// are kept, up to a factor (Lambert's azimuthal projection).
fn project(direction: DVec3) -> DVec2 {
    let unit = direction.normalize_or_zero();
    let along = unit.truncate().try_normalize().unwrap_or(DVec2::X);
    (1.0 - unit.z).max(0.0).sqrt() * along
}

/// One row's dot in one of the panels.
struct Dot {
    direction: Option<DVec3>,
    /// The value that is judged, if it isn't the direction itself.
    value: Option<f64>,
    is_right: bool,
}

impl Dot {
    /// Creates a dot for a result. It is at the result's own direction, if it has one.
    fn new(row: &RowComparison, result: Option<&dyn Record>, is_right: bool) -> Dot {
        let of_input = last_direction(row.input.as_ref()).filter(|_| result.is_some());
        Dot {
            direction: result.and_then(last_direction).or(of_input),
            value: result.and_then(|result| number(result, row.judged)),
            is_right,
        }
    }

    fn draw(&self, canvas: &mut Canvas, window: &Window, largest: f64, is_shown: bool) {
        let Some(direction) = self.direction.filter(|direction| direction.is_finite()) else {
            return;
        };
        let at = window.page_position(project(direction));
        let radius = match self.value {
            None => 4.0,
            Some(value) if value > 0.0 => {
                (MAX_RADIUS * (value / largest).sqrt()).clamp(2.0, 2.0 * MAX_RADIUS)
            }
            Some(_) => 2.5,
        };
        let (fill, line) = match (self.is_right, self.value) {
            (true, Some(0.0)) => (Fill::None, LineStyle::Outline),
            (true, _) => (RIGHT, LineStyle::Grid),
            (false, Some(0.0)) => (Fill::None, LineStyle::Wrong),
            (false, _) => (WRONG, LineStyle::Wrong),
        };
        match (self.value, self.is_right) {
            (Some(_), _) => canvas.circle(at, radius, line, fill),
            (None, true) => canvas.mark(at, Mark::Right),
            (None, false) => canvas.mark(at, Mark::Wrong),
        }
        if is_shown {
            canvas.circle(at, radius + 5.0, LineStyle::Outline, Fill::None);
        }
    }
}

/// Returns a number for the field with this name, or `None` if it is a direction or its length. No
/// density counts as 0, and a colour as the mean of its channels.
fn number(record: &dyn Record, name: &str) -> Option<f64> {
    let index = record.names().iter().position(|other| *other == name)?;
    let value = record.value(index);
    if let Value::Density(number) = value {
        Some(number.into())
    } else if let Value::OptionalDensity(density) = value {
        Some(density.map_or(0.0, f64::from))
    } else if let Value::Color(color) = value {
        Some(color.as_dvec3().element_sum() / 3.0)
    } else {
        None
    }
}
