//! What a ray meets in a heap of primitives: distances along it are all there is to see.

use protocol::Interval;

use super::Drawing;
use super::bars::{self, Bar, Row};
use super::encounter::{Encounter, Got};
use super::ink::Line;
use super::sheet::{Sheet, Sign};
use crate::describe;

/// The drawing: the range, and both answers as the part of the ray before the hit.
pub(super) fn draw(encounter: &Encounter) -> Drawing {
    let range = encounter.ray.range;
    let before = |distance: f64| Interval::new(range.min, distance as f32);
    let (got, otherwise) = match encounter.got {
        Got::Hit(met) => (
            Some(before(met.distance)),
            describe::number(met.distance as f32),
        ),
        Got::Miss => (None, "no hit".to_owned()),
        Got::NoAnswer => (None, "no answer".to_owned()),
    };
    let row = |name, bar, span, otherwise: &str| Row {
        name,
        bar,
        span,
        otherwise: otherwise.to_owned(),
    };
    let wanted = encounter.wanted.map(|met| before(met.distance));
    let rows = [
        row("range", Bar::Range, Some(range), "none"),
        row("wanted", Bar::Right, wanted, "no hit"),
        row("got", Bar::Wrong, got, &otherwise),
    ];
    let ends = [wanted, got].into_iter().flatten();
    let ends = ends.map(|span| f64::from(span.max));
    let distances = ends.chain([range.min, range.max].map(f64::from));

    let mut sheet = Sheet::default();
    sheet.title("along the ray, up to the hit");
    sheet.y = bars::draw(&mut sheet.canvas, sheet.y, &rows, distances);
    if let Some(met) = encounter.wanted {
        let words = format!("wanted: a hit at {}", describe::number(met.distance as f32));
        sheet.explain(Sign::Line(Line::Right), &words);
    }
    if let Got::Hit(met) = encounter.got {
        let words = format!("got: a hit at {}", describe::number(met.distance as f32));
        sheet.explain(Sign::Line(Line::Wrong), &words);
    }
    sheet.finish("The hits along the ray", encounter.sentence())
}
