//! Draws the lines, areas and labels of the handout's figures as SVG.
//!
//! Every drawing has a background card, so that it is readable on any page. The card follows the
//! light or dark mode of the reader's system, or the theme of the book. No information depends on
//! colour alone: areas and lines are also labelled. The colours are those of Okabe and Ito, which
//! people with colour blindness can distinguish.

use glam::{DVec2, dvec2};
use grader::svg::{self, closed_path, number, path};
use maud::{Markup, PreEscaped, Render, html};

use super::label::with_subscripts;

/// The style sheet of a drawing, in light and dark mode. The book's style sheet, `handout.css`,
/// sets the same colours for each of its themes.
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

/// The colour of a line, an area or a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hue {
    /// The colour of objects: boxes, axes, surfaces, and their labels.
    Ink,
    /// The colour of helper lines, such as grids and extended lines.
    Soft,
    /// The colour of rays, and of the first of several objects.
    Blue,
    /// The colour of the second of several objects, and of mistakes.
    Orange,
    /// The colour of the third of several objects, and of correct results.
    Green,
    /// The colour of the fourth of several objects.
    Pink,
}

impl Hue {
    fn paint(self) -> &'static str {
        match self {
            Hue::Ink => "var(--ink)",
            Hue::Soft => "var(--soft)",
            Hue::Blue => "var(--blue)",
            Hue::Orange => "var(--orange)",
            Hue::Green => "var(--green)",
            Hue::Pink => "var(--pink)",
        }
    }
}

/// The horizontal alignment of a label relative to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// On the right: the text starts at the position.
    Right,
    /// Centred: the middle of the text is at the position.
    Middle,
    /// On the left: the text ends at the position.
    Left,
}

/// A figure that is being drawn. x points right, y down. On a phone, a unit is about three quarters
/// of a pixel.
#[derive(Clone, Debug)]
pub struct Drawing {
    size: DVec2,
    body: String,
}

impl Drawing {
    /// Creates an empty drawing.
    pub fn new(width: f64, height: f64) -> Self {
        Drawing {
            size: dvec2(width, height),
            body: String::new(),
        }
    }

    /// Returns the SVG file. `title` names the figure, and `description` describes it in words.
    pub fn finish(&self, title: &str, description: &str) -> String {
        let (w, h) = (self.size.x, self.size.y);
        // The preferred size, if the page is wide enough for it.
        let (wide, high) = (w * 1.25, h * 1.25);
        // A line for each element, so that changes can be reviewed.
        let image = html! {
            svg .figure xmlns="http://www.w3.org/2000/svg" role="img" width=(wide) height=(high)
                viewBox=(format!("0 0 {w} {h}")) { "\n"
                title { (svg::text(title)) } "\n"
                desc { (svg::text(description)) } "\n"
                style { (PreEscaped(STYLE)) } "\n"
                rect .card width=(w) height=(h) rx="8" {} "\n"
                (PreEscaped(&self.body))
            } "\n"
        };
        image.into_string()
    }

    /// Draws a line from `a` to `b`.
    pub fn line(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        self.stroke(hue, "line", &path(&[a, b]))
    }

    /// Draws a dotted line from `a` to `b`.
    pub fn dashed(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        self.stroke(hue, "line dashed", &path(&[a, b]))
    }

    /// Draws an arrow from `a` to `b`.
    pub fn arrow(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        let along = (b - a).normalize();
        let (back, aside) = (b - 11.0 * along, 4.5 * along.perp());
        self.stroke(hue, "line", &path(&[a, back]));
        let tip = closed_path(&[b, back + aside, back - aside]);
        self.element(&html! { path d=(tip) fill=(hue.paint()) {} })
    }

    /// Draws a dimension line: an arrow with a tip at each end.
    pub fn measure(&mut self, a: DVec2, b: DVec2) -> &mut Self {
        let middle = a.midpoint(b);
        self.arrow(Hue::Soft, middle, a).arrow(Hue::Soft, middle, b)
    }

    /// Draws lines through all of the points.
    pub fn curve(&mut self, hue: Hue, points: &[DVec2]) -> &mut Self {
        self.stroke(hue, "line", &path(points))
    }

    /// Fills a polygon with a light tint, without an outline.
    pub fn area(&mut self, hue: Hue, points: &[DVec2]) -> &mut Self {
        self.element(&html! { path .area d=(closed_path(points)) fill=(hue.paint()) {} })
    }

    /// Draws the outline of a polygon.
    pub fn outline(&mut self, hue: Hue, points: &[DVec2]) -> &mut Self {
        self.stroke(hue, "line", &closed_path(points))
    }

    /// Draws a tinted box between two corners.
    pub fn filled_box(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        let corners = corners(a, b);
        self.area(hue, &corners).outline(hue, &corners)
    }

    /// Draws the outline of a box between two corners.
    pub fn open_box(&mut self, hue: Hue, a: DVec2, b: DVec2) -> &mut Self {
        self.outline(hue, &corners(a, b))
    }

    /// Covers a box with the background, to hide what was drawn there.
    pub fn card(&mut self, a: DVec2, b: DVec2) -> &mut Self {
        self.element(&html! { path .card d=(closed_path(&corners(a, b))) {} })
    }

    /// Draws a tinted circle.
    pub fn disc(&mut self, hue: Hue, center: DVec2, radius: f64) -> &mut Self {
        let [x, y, r] = [center.x, center.y, radius].map(number);
        self.element(&html! { circle .area cx=(x) cy=(y) r=(r) fill=(hue.paint()) {} })
            .element(&html! { circle .line cx=(x) cy=(y) r=(r) stroke=(hue.paint()) {} })
    }

    /// Draws a point.
    pub fn dot(&mut self, hue: Hue, at: DVec2) -> &mut Self {
        let (x, y) = (number(at.x), number(at.y));
        self.element(&html! { circle cx=(x) cy=(y) r="4.5" fill=(hue.paint()) {} })
    }

    /// Draws a small ring, for a point that does not count.
    pub fn ring(&mut self, hue: Hue, at: DVec2) -> &mut Self {
        let (x, y) = (number(at.x), number(at.y));
        self.element(&html! {
            circle cx=(x) cy=(y) r="5" fill="var(--card)" stroke=(hue.paint()) stroke-width="2" {}
        })
    }

    /// Draws a cross, for something that is wrong, missing or not done.
    pub fn cross(&mut self, hue: Hue, at: DVec2) -> &mut Self {
        let (a, b) = (dvec2(7.0, 7.0), dvec2(7.0, -7.0));
        self.line(hue, at - a, at + a).line(hue, at - b, at + b)
    }

    /// Draws a label whose base line goes through `at`. `_` makes the next letter a subscript, as
    /// in `S_A`; `__` is an underscore.
    pub fn label(&mut self, hue: Hue, side: Side, at: DVec2, text: &str) -> &mut Self {
        self.text(None, hue, side, at, text)
    }

    /// Draws a label in a smaller font.
    pub fn small_label(&mut self, hue: Hue, side: Side, at: DVec2, text: &str) -> &mut Self {
        self.text(Some("small"), hue, side, at, text)
    }

    fn text(
        &mut self,
        class: Option<&str>,
        hue: Hue,
        side: Side,
        at: DVec2,
        text: &str,
    ) -> &mut Self {
        let anchor = match side {
            Side::Right => "start",
            Side::Middle => "middle",
            Side::Left => "end",
        };
        self.element(&html! {
            text class=[class] x=(number(at.x)) y=(number(at.y)) text-anchor=(anchor)
                fill=(hue.paint()) { (with_subscripts(text)) }
        })
    }

    fn stroke(&mut self, hue: Hue, class: &str, path: &str) -> &mut Self {
        self.element(&html! { path class=(class) d=(path) stroke=(hue.paint()) {} })
    }

    fn element(&mut self, element: &Markup) -> &mut Self {
        element.render_to(&mut self.body);
        self.body.push('\n');
        self
    }
}

/// Returns the corners of a box in order around it.
pub fn corners(a: DVec2, b: DVec2) -> [DVec2; 4] {
    [a, dvec2(b.x, a.y), b, dvec2(a.x, b.y)]
}
