//! An SVG image, built element by element in page units: x to the right, y down.
//!
//! Coordinates may come from submissions, so elements with points that are not finite or far off
//! the page are skipped, and an image that has reached [`MAX_BYTES`] bytes accepts no more
//! elements. All text is escaped here.

use std::fmt::{Display, Write};

use glam::{DVec2, dvec2};

use super::ink::{Fill, Ink, LineStyle};

/// The width of every drawing. A phone screen that is 360 pixels wide shows it at full size, with a
/// small margin.
pub(super) const WIDTH: f64 = 340.0;
/// The font size.
const FONT_SIZE: f64 = 12.5;
/// The size of a drawing, in bytes, from which no more elements are added.
const MAX_BYTES: usize = 120_000;
/// The limit for the absolute value of a coordinate. Points beyond it are not drawn.
const MAX_COORDINATE: f64 = 1e4;

/// The position of a text relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    /// To the right of the point.
    Start,
    /// Centred on the point.
    Middle,
    /// To the left of the point.
    End,
}

/// A mark at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    /// A disc, for the expected answer.
    Right,
    /// A cross, for the submitted answer if it is wrong.
    Wrong,
    /// A ring, for the origin of a ray.
    Origin,
}

/// The elements drawn so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Canvas {
    body: String,
}

impl Canvas {
    /// Returns the complete image, with this height. `title` and `description` are for screen
    /// readers.
    pub(super) fn finish(self, height: f64, title: &str, description: &str) -> String {
        let (title, description) = (escape(title), escape(description));
        format!(
            concat!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" role="img" viewBox="0 0 {} {:.0}" "#,
                r#"font-family="system-ui, sans-serif" font-size="{}" stroke-linejoin="round">"#,
                "<title>{}</title><desc>{}</desc>{}</svg>"
            ),
            WIDTH, height, FONT_SIZE, title, description, self.body
        )
    }

    /// Draws a straight line.
    pub(super) fn line(&mut self, from: DVec2, to: DVec2, line: LineStyle) {
        if is_drawable(from) && is_drawable(to) {
            let (a, b) = (coordinates(from), coordinates(to));
            self.add(format_args!(
                r#"<path d="M{a}L{b}" {}/>"#,
                line.attributes()
            ));
        }
    }

    /// Draws a closed polygon, or nothing if a corner is far off the page.
    pub(super) fn polygon(&mut self, corners: &[DVec2], line: LineStyle, fill: Fill) {
        self.polygons(&[corners], line, fill);
    }

    /// Draws several polygons in the same style.
    pub(super) fn polygons(&mut self, all: &[impl AsRef<[DVec2]>], line: LineStyle, fill: Fill) {
        let mut path = String::new();
        for corners in all.iter().map(AsRef::as_ref) {
            if corners.iter().all(|corner| is_drawable(*corner)) {
                let corners: Vec<String> =
                    corners.iter().map(|corner| coordinates(*corner)).collect();
                write!(path, "M{}Z", corners.join("L")).expect("writing to a string cannot fail");
            }
        }
        if !path.is_empty() {
            let (fill, line) = (fill.attributes(), line.attributes());
            self.add(format_args!(r#"<path d="{path}" {fill} {line}/>"#));
        }
    }

    /// Draws a rectangle from two opposite corners.
    pub(super) fn rectangle(&mut self, from: DVec2, to: DVec2, line: LineStyle, fill: Fill) {
        let corners = [from, dvec2(to.x, from.y), to, dvec2(from.x, to.y)];
        self.polygon(&corners, line, fill);
    }

    /// Fills a rectangle between two opposite corners, without an outline.
    pub(super) fn area(&mut self, from: DVec2, to: DVec2, fill: Fill) {
        if is_drawable(from) && is_drawable(to) {
            let (min, size) = (from.min(to), (to - from).abs());
            let fill = fill.attributes();
            self.add(format_args!(
                r#"<rect x="{:.1}" y="{:.1}" width="{:.1}" height="{:.1}" {fill}/>"#,
                min.x, min.y, size.x, size.y
            ));
        }
    }

    /// Draws a circle.
    pub(super) fn circle(&mut self, center: DVec2, radius: f64, line: LineStyle, fill: Fill) {
        if is_drawable(center) && radius.is_finite() && radius < MAX_COORDINATE {
            let (fill, line) = (fill.attributes(), line.attributes());
            self.add(format_args!(
                r#"<circle cx="{:.1}" cy="{:.1}" r="{radius:.1}" {fill} {line}/>"#,
                center.x, center.y
            ));
        }
    }

    /// Draws an arrow with its head at `to`.
    pub(super) fn arrow(&mut self, from: DVec2, to: DVec2, line: LineStyle, ink: Ink) {
        self.line(from, to, line);
        let Some(dir) = (to - from).try_normalize() else {
            return;
        };
        let (back, across) = (to - 9.0 * dir, 4.0 * dir.perp());
        if is_drawable(to) {
            let head = [to, back + across, back - across]
                .map(coordinates)
                .join("L");
            let paint = ink.paint();
            self.add(format_args!(r#"<path d="M{head}Z" fill="{paint}"/>"#));
        }
    }

    /// Draws a mark.
    pub(super) fn mark(&mut self, at: DVec2, mark: Mark) {
        if !is_drawable(at) {
            return;
        }
        let paper = r#"stroke="var(--paper, Canvas)" stroke-width="1.5""#;
        match mark {
            Mark::Right => {
                let paint = Ink::Right.paint();
                let (x, y) = (at.x, at.y);
                self.add(format_args!(
                    r#"<circle cx="{x:.1}" cy="{y:.1}" r="5.5" fill="{paint}" {paper}/>"#
                ));
            }
            Mark::Wrong => {
                let arm = |x: f64, y: f64| coordinates(at + 5.5 * dvec2(x, y));
                let path = format!(
                    "M{}L{}M{}L{}",
                    arm(-1.0, -1.0),
                    arm(1.0, 1.0),
                    arm(-1.0, 1.0),
                    arm(1.0, -1.0)
                );
                // Drawn twice, first wider and in the background colour, so that a border separates
                // the cross from the lines below it.
                for (paint, width) in [("var(--paper, Canvas)", 6.0), (Ink::Wrong.paint(), 3.0)] {
                    self.add(format_args!(
                        r#"<path d="{path}" fill="none" stroke="{paint}" stroke-width="{width}"/>"#
                    ));
                }
            }
            Mark::Origin => {
                let (x, y) = (at.x, at.y);
                self.add(format_args!(
                    r#"<circle cx="{x:.1}" cy="{y:.1}" r="4" fill="var(--paper, Canvas)" stroke="currentColor" stroke-width="2"/>"#
                ));
            }
        }
    }

    /// Draws text with an outline in the background colour, so that it can be read on top of lines.
    pub(super) fn text(&mut self, at: DVec2, anchor: Anchor, ink: Ink, text: &str) {
        if !is_drawable(at) {
            return;
        }
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (paint, opacity, text) = (ink.paint(), ink.opacity(), escape(text));
        let opacity = match opacity {
            "1" => String::new(),
            opacity => format!(r#" fill-opacity="{opacity}""#),
        };
        self.add(format_args!(
            concat!(
                r#"<text x="{:.1}" y="{:.1}" text-anchor="{}" fill="{}"{} "#,
                r#"stroke="var(--paper, Canvas)" stroke-width="3" paint-order="stroke">{}</text>"#
            ),
            at.x, at.y, anchor, paint, opacity, text
        ));
    }

    fn add(&mut self, element: impl Display) {
        if self.body.len() < MAX_BYTES {
            write!(self.body, "{element}").expect("writing to a string cannot fail");
        }
    }
}

fn is_drawable(at: DVec2) -> bool {
    // False for NaN.
    at.abs().max_element() < MAX_COORDINATE && at.is_finite()
}

fn coordinates(at: DVec2) -> String {
    format!("{:.1} {:.1}", at.x, at.y)
}

fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // Control characters are not allowed in XML, not even escaped.
            c if c.is_control() => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_become_elements() {
        let mut canvas = Canvas::default();
        let text = "<script>&\"\u{0}";
        canvas.text(DVec2::ZERO, Anchor::Start, Ink::Text, text);
        let svg = canvas.finish(10.0, text, text);
        assert!(!svg.contains("<script>") && !svg.contains('\u{0}'), "{svg}");
    }

    #[test]
    fn skips_coordinates_that_are_not_on_the_page() {
        let mut canvas = Canvas::default();
        for wild in [f64::NAN, f64::INFINITY, -1e38] {
            let at = dvec2(1.0, wild);
            canvas.line(at, DVec2::ZERO, LineStyle::Ray);
            canvas.polygon(&[at, DVec2::ZERO], LineStyle::Ray, Fill::None);
            canvas.area(at, DVec2::ZERO, Fill::None);
            canvas.circle(DVec2::ZERO, wild.abs(), LineStyle::Ray, Fill::None);
            canvas.mark(at, Mark::Wrong);
            canvas.text(at, Anchor::End, Ink::Text, "nowhere");
        }
        assert_eq!(canvas.body, "");
    }
}
