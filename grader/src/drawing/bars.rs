//! Draws intervals as bars, one below the other, above an axis of distances along a ray.

use glam::dvec2;
use protocol::Interval;

use super::canvas::{Anchor, Canvas, WIDTH};
use super::ink::{Fill, Ink, LineStyle};
use super::numbers::short;
use super::sheet::Sheet;

/// The height of a row.
const ROW_HEIGHT: f64 = 20.0;
/// Half the height of a bar.
const HALF_BAR: f64 = 5.0;
/// The left end of the axis. The names of the rows are to the left of it.
const LEFT: f64 = 58.0;
const RIGHT: f64 = WIDTH - 12.0;

/// The style of a bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BarStyle {
    /// A neutral interval, shown for comparison.
    Plain,
    /// The range of the ray.
    Range,
    /// The expected interval.
    Right,
    /// The submitted interval.
    Wrong,
}

impl BarStyle {
    /// Returns the colour, the outline and the opacity of the fill.
    fn look(self) -> (Ink, LineStyle, f64) {
        match self {
            BarStyle::Plain => (Ink::Text, LineStyle::Grid, 0.18),
            BarStyle::Range => (Ink::Text, LineStyle::Grid, 0.4),
            BarStyle::Right => (Ink::Right, LineStyle::Right, 0.6),
            BarStyle::Wrong => (Ink::Wrong, LineStyle::Wrong, 0.15),
        }
    }
}

/// A row of the diagram: its name, its interval, and the text to show if the interval is empty.
#[derive(Clone, Debug)]
pub(super) struct BarRow {
    name: &'static str,
    style: BarStyle,
    span: Option<Interval>,
    empty_text: String,
}

impl BarRow {
    /// Creates a row.
    pub(super) fn new(
        name: &'static str,
        style: BarStyle,
        span: Option<Interval>,
        empty_text: &str,
    ) -> BarRow {
        BarRow {
            name,
            style,
            span,
            empty_text: empty_text.to_owned(),
        }
    }
}

/// A horizontal axis of distances along a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    first: f64,
    last: f64,
    left: f64,
    right: f64,
}

impl Axis {
    /// Creates an axis that covers all of these distances, except values of 1e9 or more, which are
    /// treated as infinite. On the page, the axis extends from `left` to the right edge.
    pub(super) fn over(left: f64, distances: impl IntoIterator<Item = f64>) -> Axis {
        let finite = distances.into_iter().filter(|t| t.abs() < 1e9);
        let (first, last) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), t| {
            (t.min(min), t.max(max))
        });
        let (first, last) = if first <= last {
            (first, last)
        } else {
            (0.0, 1.0)
        };
        let margin = match last - first {
            0.0 => 1.0,
            size => 0.12 * size,
        };
        Axis {
            first: first - margin,
            last: last + margin,
            left,
            right: RIGHT,
        }
    }

    /// Converts a distance to an x coordinate on the page. A distance outside the axis is clamped
    /// to the nearer end. The result is never NaN.
    pub(super) fn page_position(&self, t: f64) -> f64 {
        let share = (t - self.first) / (self.last - self.first);
        if share.is_nan() {
            return self.left;
        }
        self.left + share.clamp(0.0, 1.0) * (self.right - self.left)
    }

    /// Returns whether the axis covers this distance.
    pub(super) fn contains(&self, t: f64) -> bool {
        self.first <= t && t <= self.last
    }

    /// Draws the axis's line with a few labelled ticks.
    pub(super) fn draw(&self, canvas: &mut Canvas, y: f64) {
        canvas.line(
            dvec2(self.left, y),
            dvec2(self.right, y),
            LineStyle::Outline,
        );
        let step = tick_step((self.last - self.first) / 5.0);
        let first = (self.first / step).ceil();
        for tick in 0..12 {
            let t = (first + f64::from(tick)) * step;
            if !self.contains(t) {
                break;
            }
            let x = self.page_position(t);
            canvas.line(dvec2(x, y), dvec2(x, y + 4.0), LineStyle::Outline);
            let at = dvec2(x, y + 17.0);
            canvas.text(at, Anchor::Middle, Ink::Faint, &short(t));
        }
    }
}

/// Returns the smallest number that is at least `least` and is 1, 2 or 5 times a power of ten.
fn tick_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|step| step * power);
    steps
        .into_iter()
        .find(|step| *step >= least)
        .unwrap_or(10.0 * power)
}

/// Draws the rows and, below them, an axis that covers `distances`.
pub(super) fn draw(sheet: &mut Sheet, rows: &[BarRow], distances: impl IntoIterator<Item = f64>) {
    let (canvas, y) = (&mut sheet.canvas, sheet.y);
    let axis = Axis::over(LEFT, distances);
    let foot = y + ROW_HEIGHT * rows.len() as f64;
    // Draws lines through all rows at both ends of the expected interval.
    let right = rows.iter().find(|row| row.style == BarStyle::Right);
    if let Some(span) = right.and_then(|row| row.span) {
        for t in [span.min, span.max].map(f64::from) {
            if axis.contains(t) {
                let x = axis.page_position(t);
                canvas.line(dvec2(x, y), dvec2(x, foot), LineStyle::Grid);
            }
        }
    }
    for (i, row) in rows.iter().enumerate() {
        draw_row(canvas, &axis, y + ROW_HEIGHT * i as f64, row);
    }
    axis.draw(canvas, foot + 2.0);
    sheet.y = foot + 24.0;
}

fn draw_row(canvas: &mut Canvas, axis: &Axis, y: f64, row: &BarRow) {
    let (ink, line, share) = row.style.look();
    let name = dvec2(LEFT - 8.0, y + 14.5);
    canvas.text(name, Anchor::End, ink, row.name);
    let middle = y + 0.5 * ROW_HEIGHT;
    let Some(span) = row.span.filter(|span| !span.is_empty()) else {
        let at = dvec2(LEFT + 4.0, y + 14.5);
        canvas.text(at, Anchor::Start, ink, &row.empty_text);
        return;
    };
    let (min, max) = (f64::from(span.min), f64::from(span.max));
    let (from, to) = (axis.page_position(min), axis.page_position(max));
    // Keeps an interval visible even if it is a single point.
    let to = to.max(from + 1.5);
    let corner = |x: f64, up: f64| dvec2(x, middle + up * HALF_BAR);
    let fill = Fill::Tint(ink, share);
    canvas.rectangle(corner(from, -1.0), corner(to, 1.0), line, fill);
    // Draws arrowheads where the interval continues beyond the axis.
    let goes_on = [(min < axis.first, from, -1.0), (max > axis.last, to, 1.0)];
    for (goes_on, x, dir) in goes_on {
        if goes_on {
            let tip = dvec2(x + 8.0 * dir, middle);
            canvas.polygon(&[tip, corner(x, -1.0), corner(x, 1.0)], line, fill);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_covers_the_finite_distances_and_clamps_the_rest() {
        let axis = Axis::over(40.0, [2.0, 4.0, f64::INFINITY, f64::NAN, 1e30]);
        assert!(axis.contains(2.0) && axis.contains(4.0) && !axis.contains(9.0));
        assert_eq!(axis.page_position(f64::NEG_INFINITY), 40.0);
        assert_eq!(axis.page_position(f64::INFINITY), RIGHT);
        assert_eq!(axis.page_position(f64::NAN), 40.0);
        assert!((axis.page_position(3.0) - 0.5 * (40.0 + RIGHT)).abs() < 1e-9);
    }

    #[test]
    fn tick_steps_are_round() {
        assert_eq!([0.3, 1.0, 1.1, 6.0].map(tick_step), [0.5, 1.0, 2.0, 10.0]);
    }
}
