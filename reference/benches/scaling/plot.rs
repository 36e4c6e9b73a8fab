//! Draws the plot. The left panel compares the number of tests per ray with the number that brute
//! force needs. The right panel has a linear vertical axis, which turns counts that grow
//! logarithmically with the number of triangles into straight lines.

use maud::{Markup, html};

use crate::Row;

/// The left edge of each panel's plot area. The constants `TOP`, `WIDTH` and `HEIGHT` are the same
/// for both panels.
const LEFT: [f64; 2] = [70.0, 510.0];
const TOP: f64 = 60.0;
const WIDTH: f64 = 340.0;
const HEIGHT: f64 = 260.0;
/// The powers of ten on the horizontal axis.
const DECADES: std::ops::RangeInclusive<i32> = 2..=6;
/// The upper end of the right panel's vertical axis.
const MAX_COUNT: f64 = 60.0;

/// A curve: its colour, its label and the function that returns its value for a row.
type Curve<'a> = (&'a str, &'a str, fn(&Row) -> f64);

const BRUTE: Curve = ("#b3261e", "every triangle", |row| row.triangles as f64);
const BOXES: Curve = ("#1f5fa8", "boxes per ray", |row| row.boxes);
const PRIMITIVES: Curve = ("#2e7d32", "triangles per ray", |row| row.primitives);
const HANDLED: Curve = ("#8a5a00", "build calls per triangle", |row| row.handled);

/// Returns the plot as SVG.
pub fn plot(rows: &[Row]) -> String {
    let log = |value: f64| value.max(1.0).log10() / 6.0;
    let linear = |value: f64| value / MAX_COUNT;
    let decades = (0..=6).map(|decade| (f64::from(decade) / 6.0, power(decade)));
    let tens = (0..=6).map(|ten| (f64::from(ten) / 6.0, format!("{}", 10 * ten)));
    let markup = html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 880 380" width="880" height="380"
            font-family="sans-serif" font-size="13" fill="#222" {
            title { "Work per ray and per triangle, against the number of triangles" }
            rect width="880" height="380" fill="#fff" {}
            (frame(LEFT[0], "Tests per ray", decades))
            (frame(LEFT[1], "Tests per ray, and build calls per triangle", tens))
            @for line in [BRUTE, BOXES, PRIMITIVES] { (curve(LEFT[0], rows, line, log)) }
            @for line in [BOXES, PRIMITIVES, HANDLED] { (curve(LEFT[1], rows, line, linear)) }
        }
    };
    // Write one element per line, so that a diff shows what moved.
    markup.into_string().replace("><", ">\n<") + "\n"
}

fn power(decade: i32) -> String {
    let digits = ["⁰", "¹", "²", "³", "⁴", "⁵", "⁶"];
    format!("10{}", digits[decade as usize])
}

/// Formats a coordinate.
fn number(value: f64) -> String {
    format!("{value:.1}")
}

/// Draws a panel with its axes. Each mark on the vertical axis consists of a height, from 0 to 1,
/// and a label.
fn frame(left: f64, title: &str, marks: impl Iterator<Item = (f64, String)>) -> Markup {
    let (right, bottom) = (left + WIDTH, TOP + HEIGHT);
    html! {
        text x=(left) y=(TOP - 20.0) font-size="15" { (title) }
        @for (height, label) in marks {
            @let y = bottom - HEIGHT * height;
            path d={ "M" (left) " " (number(y)) "H" (right) } stroke="#ddd" {}
            text x=(left - 8.0) y=(number(y + 4.5)) text-anchor="end" { (label) }
        }
        @for decade in DECADES {
            @let x = number(left + WIDTH * x_fraction(10f64.powi(decade)));
            path d={ "M" (x) " " (bottom) "v5" } stroke="#888" {}
            text x=(x) y=(bottom + 20.0) text-anchor="middle" { (power(decade)) }
        }
        text x=(left + WIDTH / 2.0) y=(bottom + 42.0) text-anchor="middle" { "triangles" }
    }
}

/// Returns the position of a triangle count on the logarithmic x axis, from 0 (left) to 1 (right).
fn x_fraction(triangles: f64) -> f64 {
    let (first, last) = (f64::from(*DECADES.start()), f64::from(*DECADES.end()));
    (triangles.log10() - first) / (last - first)
}

/// Draws one curve, with a label above its end.
fn curve(left: f64, rows: &[Row], line: Curve, height: impl Fn(f64) -> f64) -> Markup {
    let (colour, name, value) = line;
    let point = |row: &Row| {
        let x = left + WIDTH * x_fraction(row.triangles as f64);
        (x, TOP + HEIGHT * (1.0 - height(value(row))))
    };
    let points: Vec<String> = rows
        .iter()
        .map(point)
        .map(|(x, y)| format!("{x:.1} {y:.1}"))
        .collect();
    html! {
        @for (x, y) in rows.iter().map(point) {
            circle cx=(number(x)) cy=(number(y)) r="3" fill=(colour) {}
        }
        path d={ "M" (points.join("L")) } fill="none" stroke=(colour) stroke-width="1.5" {}
        @if let Some(last) = rows.last() {
            @let (x, y) = point(last);
            text x=(number(x)) y=(number(y - 9.0)) text-anchor="end" fill=(colour) {
                (name) ": " (format_count(value(last)))
            }
        }
    }
}

/// Formats a count with a readable unit.
fn format_count(value: f64) -> String {
    if value < 1000.0 {
        format!("{value:.1}")
    } else {
        format!("{:.1} million", value / 1e6)
    }
}
