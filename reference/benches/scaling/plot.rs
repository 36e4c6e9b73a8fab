//! Draws the plot. The left panel compares the tests per ray with brute force. The right panel has
//! a linear vertical axis, so that counts that grow with the logarithm of the number of triangles
//! are straight lines.

use std::fmt::Write as _;

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

/// A curve: its colour, its label, and the function that returns its value for a row.
type Curve<'a> = (&'a str, &'a str, fn(&Row) -> f64);

const BRUTE: Curve = ("#b3261e", "every triangle", |row| row.triangles as f64);
const BOXES: Curve = ("#1f5fa8", "boxes per ray", |row| row.boxes);
const PRIMITIVES: Curve = ("#2e7d32", "triangles per ray", |row| row.primitives);
const HANDLED: Curve = ("#8a5a00", "build calls per triangle", |row| row.handled);

/// Returns the plot as SVG.
pub fn plot(rows: &[Row]) -> String {
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 880 380\" width=\"880\" \
         height=\"380\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n\
         <title>Work for each ray and each triangle, against the number of triangles</title>\n\
         <rect width=\"880\" height=\"380\" fill=\"#fff\"/>\n",
    );
    let log = |value: f64| value.max(1.0).log10() / 6.0;
    let linear = |value: f64| value / MAX_COUNT;
    frame(
        &mut svg,
        LEFT[0],
        "Tests for one ray",
        (0..=6).map(|decade| (f64::from(decade) / 6.0, power(decade))),
    );
    frame(
        &mut svg,
        LEFT[1],
        "Tests for one ray, and build calls",
        (0..=6).map(|tenth| (f64::from(tenth) / 6.0, format!("{}", 10 * tenth))),
    );
    for line in [BRUTE, BOXES, PRIMITIVES] {
        curve(&mut svg, LEFT[0], rows, line, log);
    }
    for line in [BOXES, PRIMITIVES, HANDLED] {
        curve(&mut svg, LEFT[1], rows, line, linear);
    }
    svg.push_str("</svg>\n");
    svg
}

fn power(decade: i32) -> String {
    let digits = ["⁰", "¹", "²", "³", "⁴", "⁵", "⁶"];
    format!("10{}", digits[decade as usize])
}

/// Draws a panel with its axes. Each mark on the vertical axis consists of a height, from 0 to 1,
/// and a label.
fn frame(svg: &mut String, left: f64, title: &str, marks: impl Iterator<Item = (f64, String)>) {
    let (right, bottom) = (left + WIDTH, TOP + HEIGHT);
    _ = writeln!(
        svg,
        "<text x=\"{left}\" y=\"{}\" font-size=\"15\">{title}</text>",
        TOP - 20.0
    );
    for (height, text) in marks {
        let y = bottom - HEIGHT * height;
        _ = writeln!(svg, "<path d=\"M{left} {y:.1}H{right}\" stroke=\"#ddd\"/>");
        _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
            left - 8.0,
            y + 4.5
        );
    }
    for decade in DECADES {
        let x = left + WIDTH * x_fraction(10f64.powi(decade));
        _ = writeln!(svg, "<path d=\"M{x:.1} {bottom}v5\" stroke=\"#888\"/>");
        _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            bottom + 20.0,
            power(decade)
        );
    }
    let middle = left + WIDTH / 2.0;
    _ = writeln!(
        svg,
        "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">triangles</text>",
        bottom + 42.0
    );
}

/// Returns where a triangle count is on the logarithmic x axis, from 0 (left) to 1 (right).
fn x_fraction(triangles: f64) -> f64 {
    let (first, last) = (f64::from(*DECADES.start()), f64::from(*DECADES.end()));
    (triangles.log10() - first) / (last - first)
}

fn curve(svg: &mut String, left: f64, rows: &[Row], line: Curve, height: impl Fn(f64) -> f64) {
    let (colour, name, value) = line;
    let point = |row: &Row| {
        let x = left + WIDTH * x_fraction(row.triangles as f64);
        (x, TOP + HEIGHT * (1.0 - height(value(row))))
    };
    let mut path = String::new();
    for (i, (x, y)) in rows.iter().map(point).enumerate() {
        _ = write!(path, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
        _ = writeln!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>"
        );
    }
    _ = writeln!(
        svg,
        "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\"/>"
    );
    if let Some(last) = rows.last() {
        // Above the end of the curve, within the panel.
        let (x, y) = point(last);
        _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"{colour}\">{name}: {}</text>",
            y - 9.0,
            format_count(value(last))
        );
    }
}

/// Formats a count for people.
fn format_count(value: f64) -> String {
    if value < 1000.0 {
        format!("{value:.1}")
    } else {
        format!("{:.1} million", value / 1e6)
    }
}
