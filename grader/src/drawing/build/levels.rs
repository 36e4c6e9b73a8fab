//! A tree as bars, one for each level: a node is as wide as its share of the primitives.

use glam::{DVec2, dvec2};

use super::Marked;
use crate::drawing::canvas::{Anchor, Canvas, Mark, WIDTH};
use crate::drawing::ink::{Fill, Ink, Line};
use crate::drawing::sheet::{Sheet, Sign};
use crate::shown::{LevelNode, Sweep};

/// The height of a level.
const ROW: f64 = 19.0;
/// Right of it stand the costs.
const RIGHT: f64 = WIDTH - 52.0;
/// A level with more nodes is drawn without their borders.
const MOST: usize = 2_000;

/// The levels of a tree over `all` primitives that costs `total`, if that is known. Returns with
/// which sign the marked node is marked.
pub(super) fn draw(
    sheet: &mut Sheet,
    nodes: &[LevelNode],
    all: u32,
    total: f64,
    mark: Marked,
) -> Sign {
    let mut sign = Sign::None;
    let top = sheet.y;
    let x = |place: u32| RIGHT * f64::from(place) / f64::from(all.max(1));
    let canvas = &mut sheet.canvas;
    canvas.text(
        dvec2(WIDTH - 2.0, top - 6.0),
        Anchor::End,
        Ink::Faint,
        "SAH cost",
    );
    let deepest = nodes.iter().map(|node| node.level).max().unwrap_or(0);
    let mut sum = 0.0;
    for level in 0..=deepest.min(Sweep::LEVELS - 1) {
        let y = top + ROW * f64::from(level);
        let on_level = nodes.iter().filter(|node| node.level == level);
        let cost: f64 = on_level.clone().map(|node| f64::from(node.cost)).sum();
        sum += cost;
        for node in on_level.take(MOST) {
            draw_node(
                canvas,
                node,
                [x(node.start), x(node.start.saturating_add(node.count))],
                y,
            );
        }
        let at = dvec2(WIDTH - 2.0, y + 13.5);
        canvas.text(at, Anchor::End, Ink::Text, &format!("{cost:.2}"));
    }
    if let Some((level, start, count)) = mark {
        let y = top + ROW * f64::from(level.min(deepest));
        let (from, to) = (
            dvec2(x(start), y),
            dvec2(x(start.saturating_add(count)), y + ROW - 3.0),
        );
        if level <= deepest && to.x - from.x > 14.0 {
            canvas.rectangle(from, to, Line::Wrong, Fill::None);
            sign = Sign::Line(Line::Wrong);
        } else {
            canvas.mark(0.5 * (from + to), Mark::Wrong);
            sign = Sign::Mark(Mark::Wrong);
        }
    }
    sheet.take(ROW * f64::from(deepest + 1));
    let rest = total - sum;
    if rest > 0.005 {
        let y = sheet.y + 13.5;
        let canvas = &mut sheet.canvas;
        canvas.text(dvec2(0.0, y), Anchor::Start, Ink::Faint, "deeper levels");
        canvas.text(
            dvec2(WIDTH - 2.0, y),
            Anchor::End,
            Ink::Text,
            &format!("{rest:.2}"),
        );
        sheet.take(ROW);
    }
    sheet.take(4.0);
    sign
}

fn draw_node(canvas: &mut Canvas, node: &LevelNode, [from, to]: [f64; 2], y: f64) {
    /// So wide a number is.
    const DIGIT: f64 = 8.0;

    let times = if node.is_leaf { node.count.max(1) } else { 1 };
    let area = f64::from(node.cost) / f64::from(times);
    let area = if area.is_finite() { area } else { 0.0 };
    let height = if node.is_leaf {
        0.5 * (ROW - 3.0)
    } else {
        ROW - 3.0
    };
    // A gap between neighbours, as far as there is room for one.
    let gap = (0.1 * (to - from)).min(1.0);
    let (low, high): (DVec2, DVec2) = (dvec2(from, y), dvec2(to - gap, y + height));
    let fill = Fill::Of(Ink::Text, 0.1 + 0.75 * area.sqrt());
    if to - from > 6.0 {
        canvas.rectangle(low, high, Line::Grid, fill);
    } else {
        canvas.area(low, high, fill);
    }
    let words = node.count.to_string();
    if to - from > DIGIT * (words.len() as f64 + 0.5) {
        let at = dvec2(0.5 * (from + to), y + 13.0);
        canvas.text(at, Anchor::Middle, Ink::Text, &words);
    }
}
