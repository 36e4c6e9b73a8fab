//! Draws all rows of a table about a matte surface on a disk, as seen from above the surface. The
//! projection keeps areas, so that the dots show the density of samples per solid angle.

use glam::{DVec2, DVec3};
use judging::exam::ExamQuestion;
use protocol::{Answer, Record};

use super::row::{RowComparison, angle_text, direction, first_direction};
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
    let wanted: Vec<Dot> = rows
        .iter()
        .map(|row| Dot::new(row, row.wanted.as_deref(), true))
        .collect();
    let got: Vec<Dot> = rows
        .iter()
        .map(|row| Dot::new(row, row.got_record(), row.is_right()))
        .collect();
    let values = || wanted.iter().chain(&got).filter_map(|dot| dot.value);
    // Values that are far too large don't shrink all others to nothing.
    let max = |dots: &[Dot]| {
        dots.iter()
            .filter_map(|dot| dot.value)
            .filter(|value| value.is_finite())
            .fold(0.0, f64::max)
    };
    let largest = max(&got).clamp(max(&wanted), 4.0 * max(&wanted));
    let is_below = |dot: &Dot| dot.direction.is_some_and(|direction| direction.z < -1e-6);
    let has_below = wanted.iter().chain(&got).any(is_below);

    let mut sheet = Sheet::default();
    let panels = sheet.panels(["wanted, from above", "got, from above"], 166.0);
    let edge = if has_below {
        project(DVec3::NEG_Z)
    } else {
        DVec2::X
    };
    for (panel, dots) in panels.into_iter().zip([&wanted, &got]) {
        let radius = edge.length();
        let window = Window::around(panel, [DVec2::splat(-radius), DVec2::splat(radius)]);
        let canvas = &mut sheet.canvas;
        let center = window.page_position(DVec2::ZERO);
        canvas.circle(
            center,
            window.page_length(radius),
            LineStyle::Grid,
            Fill::None,
        );
        let above = Fill::Tint(Ink::Text, 0.06);
        canvas.circle(center, window.page_length(1.0), LineStyle::Outline, above);
        for (index, dot) in dots.iter().enumerate() {
            dot.draw(canvas, &window, largest, index == row);
        }
    }
    let wrong = rows.iter().filter(|row| !row.is_right()).count();
    let what = if values().next().is_some() {
        "a dot's area is the value; a small ring is 0"
    } else {
        "the directions of all rows"
    };
    sheet.add_wanted(Symbol::Area(RIGHT), what);
    if answer.is_some() {
        let text = format!(
            "{wrong} of {count} rows {} wrong",
            if wrong == 1 { "is" } else { "are" }
        );
        sheet.add_got(Symbol::Area(WRONG), &text);
    }
    if let Some(out) = first_direction(shown.input.as_ref()) {
        let text = format!("the row above, whose out is {}", angle_text(out));
        sheet.add_legend(Symbol::Mark(Mark::Origin), &text);
    }
    let horizon = if has_below {
        "the horizon; directions outside this circle are below the surface"
    } else {
        "the horizon; the normal is in the middle"
    };
    sheet.add_legend(Symbol::Line(LineStyle::Outline), horizon);
    let title = "The rows of the table on a disk, seen from above the surface";
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
        let own = result.and_then(direction);
        Dot {
            direction: own.or_else(|| direction(row.input.as_ref()).filter(|_| result.is_some())),
            value: result.and_then(|result| row.judged_value(result)),
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
        let is_zero = self.value.is_some_and(|value| value.abs() <= 0.0);
        let (fill, line) = if self.is_right {
            (RIGHT, LineStyle::Grid)
        } else {
            (WRONG, LineStyle::Wrong)
        };
        let line = if is_zero && self.is_right {
            LineStyle::Outline
        } else {
            line
        };
        canvas.circle(at, radius, line, if is_zero { Fill::None } else { fill });
        if is_shown {
            canvas.circle(at, radius + 5.0, LineStyle::Outline, Fill::None);
        }
    }
}
