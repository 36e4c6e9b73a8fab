//! Draws a ray through many primitives. The primitives would hide each other, so only distances
//! along the ray are drawn.

use judging::describe;
use protocol::Interval;

use super::Drawing;
use super::bars::{self, BarRow, BarStyle};
use super::hit_comparison::{HitComparison, hit_text};
use super::ink::LineStyle;
use super::sheet::{Sheet, Symbol};

/// Draws the ray's range, the part of it before the expected hit, and the part before the submitted
/// hit.
pub(super) fn draw(comparison: &HitComparison) -> Drawing {
    let range = comparison.ray.range;
    let before = |distance: f32| Interval::new(range.min, distance);
    let (got, got_text) = match comparison.got {
        Some(Some(hit)) => (Some(before(hit.distance)), describe::number(hit.distance)),
        Some(None) => (None, "no hit".to_owned()),
        None => (None, "no answer".to_owned()),
    };
    let wanted = comparison.wanted.map(|hit| before(hit.distance));
    let rows = [
        BarRow::new("range", BarStyle::Range, Some(range), "none"),
        BarRow::new("wanted", BarStyle::Right, wanted, "no hit"),
        BarRow::new("got", BarStyle::Wrong, got, &got_text),
    ];
    let ends = [wanted, got].into_iter().flatten();
    let ends = ends.map(|span| f64::from(span.max));
    let distances = ends.chain([range.min, range.max].map(f64::from));

    let mut sheet = Sheet::default();
    sheet.title("along the ray, up to the hit");
    bars::draw(&mut sheet, &rows, distances);
    if let Some(hit) = comparison.wanted {
        sheet.add_wanted(Symbol::Line(LineStyle::Right), &hit_text(&hit));
    }
    if let Some(hit) = comparison.got_hit() {
        sheet.add_got(Symbol::Line(LineStyle::Wrong), &hit_text(&hit));
    }
    sheet.finish("The hits along the ray", comparison.caption())
}
