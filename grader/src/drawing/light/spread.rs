//! Draws how many directions are in each cell of the sphere, where every cell has the same area.

use glam::dvec2;
use judging::judge::cell_counts;
use protocol::{ElementOutcome, LocalDirection};

use crate::drawing::Drawing;
use crate::drawing::canvas::{Anchor, WIDTH};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::numbers::{direction_difference, short};
use crate::drawing::sheet::{Sheet, Symbol};

/// The height of a cell on the page.
const CELL_HEIGHT: f64 = 22.0;
/// The opacity of a cell with the expected count.
const EXPECTED_TINT: f64 = 0.25;

/// Draws the number of directions in each cell. `shown` is the index of the direction that the page
/// shows, whose length may be wrong.
pub(super) fn draw(answer: &[ElementOutcome<LocalDirection>], shown: usize) -> Drawing {
    let counts = cell_counts(answer);
    let rows = counts.len();
    let columns = counts[0].len();
    let expected = answer.len() as f64 / (rows * columns) as f64;
    let share = |count: u32| EXPECTED_TINT * f64::from(count) / expected.max(1e-9);

    let mut sheet = Sheet::default();
    sheet.title("the number of directions in each cell of the sphere");
    let left = 40.0;
    let width = (WIDTH - 1.0 - left) / columns as f64;
    // The first band is at the bottom of the sphere, and is drawn at the bottom.
    for (row, counts) in counts.iter().rev().enumerate() {
        let y = sheet.y + CELL_HEIGHT * row as f64;
        for (column, count) in counts.iter().enumerate() {
            let min = dvec2(left + width * column as f64, y);
            let max = min + dvec2(width, CELL_HEIGHT);
            let fill = Fill::Tint(Ink::Wrong, share(*count).min(0.9));
            sheet.canvas.rectangle(min, max, LineStyle::Grid, fill);
            let at = 0.5 * (min + max) + dvec2(0.0, 4.5);
            let text = count.to_string();
            sheet.canvas.text(at, Anchor::Middle, Ink::Text, &text);
        }
    }
    let foot = sheet.y + CELL_HEIGHT * rows as f64;
    let (beside, below) = (left - 4.0, foot + 14.0);
    for (x, y, anchor, label) in [
        (beside, sheet.y + 12.0, Anchor::End, "y = 1"),
        (beside, foot - 3.0, Anchor::End, "-1"),
        (left, below, Anchor::Start, "φ = 0"),
        (WIDTH - 1.0, below, Anchor::End, "φ = 2π"),
    ] {
        let canvas = &mut sheet.canvas;
        canvas.text(dvec2(x, y), anchor, Ink::Faint, label);
    }
    sheet.y = foot + 20.0;
    let all = counts.iter().flatten().copied();
    let least = all.clone().min().unwrap_or(0);
    let most = all.max().unwrap_or(0);
    let wanted = format!("about {} in every cell", short(expected));
    sheet.add_wanted(Symbol::None, &wanted);
    let got = format!("{least} to {most}; a stronger shade means more");
    let fill = Fill::Tint(Ink::Wrong, 2.0 * EXPECTED_TINT);
    sheet.add_got(Symbol::Area(fill), &got);
    let text = "every cell covers the same area of the sphere";
    sheet.add_legend(Symbol::None, text);

    let direction = answer.get(shown).and_then(ElementOutcome::value);
    let length = direction.map(|one| (one.direction.length() - 1.0).abs());
    let caption = match direction {
        // This is also the case for NaN.
        Some(LocalDirection { direction }) if !length.is_some_and(|error| error <= 1e-3) => {
            direction_difference("direction", *direction, *direction)
        }
        Some(_) | None => format!(
            "The cells contain {least} to {most} of the {} directions; each should contain about {}.",
            answer.len(),
            short(expected)
        ),
    };
    sheet.finish("The directions in each cell of the sphere", caption)
}
