//! Lines, areas and words as SVG: as much of it as the handout's figures need.
//!
//! A drawing has a card of its own below it, so that it can be read on any page; the card is light
//! or dark as the reader's system is, and in the book as the book's theme is. No colour says
//! something alone: areas also have words, and lines their places. The colours are those of Okabe
//! and Ito, which nobody takes for each other.

use glam::{DVec2, dvec2};

use super::svg::{circle, escape, format_number, path, with_subscripts};

/// How a reader's page, light or dark, colours a drawing. The book's own style sheet, `handout.css`,
/// says the same for each of its themes.
const STYLE: &str = "\
.figure{--card:#fff;--ink:#1c1c1c;--soft:#6f6f6f;--blue:#0072b2;--orange:#c25400;--green:#00795a;--pink:#a8467f;\
font:17px system-ui,-apple-system,'Segoe UI',sans-serif}\
@media(prefers-color-scheme:dark){.figure{--card:#1d2129;--ink:#e4e6ea;--soft:#9aa1ad;--blue:#6cbcf0;--orange:#f2a04c;--green:#3fcca0;--pink:#e79cc6}}\
.figure .card{fill:var(--card)}\
.figure .area{fill-opacity:.16}\
.figure .line{fill:none;stroke-width:2;stroke-linecap:round;stroke-linejoin:round}\
.figure .dashed{stroke-dasharray:2 6}\
.figure text{paint-order:stroke;stroke:var(--card);stroke-width:4px;stroke-linejoin:round}\
.figure .small{font-size:15px}";

/// What a stroke, an area or a word is drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hue {
    /// What is there: boxes, axes, surfaces, words.
    Ink,
    /// What helps: grids, continuations.
    Soft,
    /// The ray, and the first of two things.
    Blue,
    /// The second of two things, and what is wrong.
    Orange,
    /// The third thing, and what is right.
    Green,
    /// A fourth thing.
    Pink,
}

impl Hue {
    fn name(self) -> &'static str {
        match self {
            Hue::Ink => "ink",
            Hue::Soft => "soft",
            Hue::Blue => "blue",
            Hue::Orange => "orange",
            Hue::Green => "green",
            Hue::Pink => "pink",
        }
    }
}

/// Where a word stands beside its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// It begins there.
    Right,
    /// Its middle is there.
    Middle,
    /// It ends there.
    Left,
}

/// A figure that is being drawn: x to the right, y down, in units of which a phone shows three in
/// four pixels.
#[derive(Clone, Debug)]
pub struct Drawing {
    size: DVec2,
    body: String,
}

impl Drawing {
    /// A card with nothing on it.
    pub fn new(width: f64, height: f64) -> Self {
        Drawing {
            size: dvec2(width, height),
            body: String::new(),
        }
    }

    /// The file: `title` is the figure's name, and `description` what it shows, in words.
    pub fn finish(&self, title: &str, description: &str) -> String {
        let (w, h) = (self.size.x, self.size.y);
        // Larger than its units where there is room.
        let (wide, high) = (w * 1.25, h * 1.25);
        let (title, description) = (escape(title), escape(description));
        let body = &self.body;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"figure\" role=\"img\" \
             width=\"{wide}\" height=\"{high}\" viewBox=\"0 0 {w} {h}\">\n\
             <title>{title}</title>\n<desc>{description}</desc>\n<style>{STYLE}</style>\n\
             <rect class=\"card\" width=\"{w}\" height=\"{h}\" rx=\"8\"/>\n{body}</svg>\n"
        )
    }

    /// A line from `a` to `b`.
    pub fn line(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        self.stroke(hue, "line", &path(&[a, b]))
    }

    /// A dotted line from `a` to `b`.
    pub fn dashed(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        self.stroke(hue, "line dashed", &path(&[a, b]))
    }

    /// A line with a tip at `b`.
    pub fn arrow(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        let along = (b - a).normalize();
        let (back, aside) = (b - 11.0 * along, 4.5 * along.perp());
        self.stroke(hue, "line", &path(&[a, back]));
        let tip = path(&[b, back + aside, back - aside]);
        self.element(&format!(
            "<path d=\"{tip}Z\" fill=\"var(--{})\"/>",
            hue.name()
        ))
    }

    /// A line with a tip at either end: a measure.
    pub fn measure(&mut self, a: DVec2, b: DVec2) -> &mut Self {
        let middle = a.midpoint(b);
        self.arrow(Hue::Soft, middle, a).arrow(Hue::Soft, middle, b)
    }

    /// Lines through all of the points.
    pub fn curve(&mut self, hue: Hue, points: &[DVec2]) -> &mut Self {
        self.stroke(hue, "line", &path(points))
    }

    /// A closed outline, its inside tinted.
    pub fn area(&mut self, hue: Hue, points: &[DVec2]) -> &mut Self {
        let (path, name) = (path(points), hue.name());
        self.element(&format!(
            "<path class=\"area\" d=\"{path}Z\" fill=\"var(--{name})\"/>"
        ))
    }

    /// A closed outline.
    pub fn outline(&mut self, hue: Hue, points: &[DVec2]) -> &mut Self {
        self.stroke(hue, "line", &format!("{}Z", path(points)))
    }

    /// A box between two corners, its inside tinted.
    pub fn filled_box(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        let corners = corners(a, b);
        self.area(hue, &corners).outline(hue, &corners)
    }

    /// A box between two corners.
    pub fn open_box(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        self.outline(hue, &corners(a, b))
    }

    /// A piece of the bare card, to hide what lies below.
    pub fn card(&mut self, a: DVec2, b: DVec2) -> &mut Self {
        let path = path(&corners(a, b));
        self.element(&format!("<path class=\"card\" d=\"{path}Z\"/>"))
    }

    /// A circle, its inside tinted.
    pub fn disc(&mut self, hue: Hue, center: DVec2, radius: f64) -> &mut Self {
        let (at, name) = (circle(center, radius), hue.name());
        self.element(&format!(
            "<circle class=\"area\" {at} fill=\"var(--{name})\"/>"
        ))
        .element(&format!(
            "<circle class=\"line\" {at} stroke=\"var(--{name})\"/>"
        ))
    }

    /// A point.
    pub fn dot(&mut self, hue: Hue, at: DVec2) -> &mut Self {
        let (at, name) = (circle(at, 4.5), hue.name());
        self.element(&format!("<circle {at} fill=\"var(--{name})\"/>"))
    }

    /// A point that does not count: a small ring.
    pub fn ring(&mut self, hue: Hue, at: DVec2) -> &mut Self {
        let (at, name) = (circle(at, 5.0), hue.name());
        self.element(&format!(
            "<circle {at} fill=\"var(--card)\" stroke=\"var(--{name})\" stroke-width=\"2\"/>"
        ))
    }

    /// A cross: what is not done, not there, not right.
    pub fn cross(&mut self, hue: Hue, at: DVec2) -> &mut Self {
        let (a, b) = (dvec2(7.0, 7.0), dvec2(7.0, -7.0));
        self.line(hue, at - a, at + a).line(hue, at - b, at + b)
    }

    /// Words, their base line through `at`. `_` puts the next letter below the line,
    /// `S_A`; `__` is a `_`.
    pub fn label(&mut self, hue: Hue, side: Side, at: DVec2, text: &str) -> &mut Self {
        self.text("", hue, side, at, text)
    }

    /// Words that say less.
    pub fn small_label(&mut self, hue: Hue, side: Side, at: DVec2, text: &str) -> &mut Self {
        self.text(" class=\"small\"", hue, side, at, text)
    }

    fn text(&mut self, class: &str, hue: Hue, side: Side, at: DVec2, text: &str) -> &mut Self {
        let anchor = match side {
            Side::Right => "start",
            Side::Middle => "middle",
            Side::Left => "end",
        };
        let (x, y, name, text) = (
            format_number(at.x),
            format_number(at.y),
            hue.name(),
            with_subscripts(text),
        );
        self.element(&format!(
            "<text{class} x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" fill=\"var(--{name})\">{text}</text>"
        ))
    }

    fn stroke(&mut self, hue: Hue, class: &str, path: &str) -> &mut Self {
        let name = hue.name();
        self.element(&format!(
            "<path class=\"{class}\" d=\"{path}\" stroke=\"var(--{name})\"/>"
        ))
    }

    fn element(&mut self, element: &str) -> &mut Self {
        self.body.push_str(element);
        self.body.push('\n');
        self
    }
}

/// The corners of a box, around it.
pub fn corners(a: DVec2, b: DVec2) -> [DVec2; 4] {
    [a, dvec2(b.x, a.y), b, dvec2(a.x, b.y)]
}
