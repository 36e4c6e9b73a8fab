//! What a ray meets in a heap of primitives: distances along it are all there is to see.

use protocol::Interval;

use super::Drawing;
use super::bars::{self, BarRow, BarStyle};
use super::hit_comparison::{HitAnswer, HitComparison};
use super::ink::LineStyle;
use super::sheet::{Sheet, Symbol};
use crate::describe;

/// The drawing: the range, and both answers as the part of the ray before the hit.
pub(super) fn draw(encounter: &HitComparison) -> Drawing {
    let range = encounter.ray.range;
    let before = |distance: f64| Interval::new(range.min, distance as f32);
    let (got, otherwise) = match encounter.got {
        HitAnswer::Hit(met) => (
            Some(before(met.distance)),
            describe::number(met.distance as f32),
        ),
        HitAnswer::Miss => (None, "no hit".to_owned()),
        HitAnswer::NoAnswer => (None, "no answer".to_owned()),
    };
    let row = |name, bar, span, otherwise: &str| BarRow {
        name,
        style: bar,
        span,
        empty_text: otherwise.to_owned(),
    };
    let wanted = encounter.wanted.map(|met| before(met.distance));
    let rows = [
        row("range", BarStyle::Range, Some(range), "none"),
        row("wanted", BarStyle::Right, wanted, "no hit"),
        row("got", BarStyle::Wrong, got, &otherwise),
    ];
    let ends = [wanted, got].into_iter().flatten();
    let ends = ends.map(|span| f64::from(span.max));
    let distances = ends.chain([range.min, range.max].map(f64::from));

    let mut sheet = Sheet::default();
    sheet.title("along the ray, up to the hit");
    sheet.y = bars::draw(&mut sheet.canvas, sheet.y, &rows, distances);
    if let Some(met) = encounter.wanted {
        let words = format!("wanted: a hit at {}", describe::number(met.distance as f32));
        sheet.add_legend(Symbol::Line(LineStyle::Right), &words);
    }
    if let HitAnswer::Hit(met) = encounter.got {
        let words = format!("got: a hit at {}", describe::number(met.distance as f32));
        sheet.add_legend(Symbol::Line(LineStyle::Wrong), &words);
    }
    sheet.finish("The hits along the ray", encounter.caption())
}
