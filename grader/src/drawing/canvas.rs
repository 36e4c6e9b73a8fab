//! An SVG image, built element by element in page units: x to the right, y down.
//!
//! Coordinates may come from submissions, so an element is skipped if any of its points isn't
//! finite or is far off the page. Once an image has reached [`MAX_BYTES`], no more elements are
//! added.

use glam::{DVec2, dvec2};
use maud::{Markup, PreEscaped, Render, html};
use protocol::Interval;

use super::ink::{Fill, Ink, LineStyle};
use super::window::Window;
use crate::svg::{self, number};

/// The width of every drawing. A phone screen that is 360 pixels wide shows it at full size, with a
/// small margin.
pub(super) const WIDTH: f64 = 340.0;
/// The font size.
const FONT_SIZE: f64 = 12.5;
/// The size of a drawing, in bytes, above which no more elements are added.
const MAX_BYTES: usize = 120_000;
/// The limit for the absolute value of a coordinate. Points beyond it aren't drawn.
const MAX_COORDINATE: f64 = 1e4;
/// The background colour of the page.
const PAPER: &str = "var(--paper, Canvas)";

/// The position of text relative to its anchor point.
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
    /// A disc that marks the expected answer.
    Right,
    /// A cross that marks a wrong answer.
    Wrong,
    /// A ring that marks the origin of a ray.
    Origin,
}

/// An SVG image under construction: the elements drawn so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Canvas {
    body: String,
}

impl Canvas {
    /// Returns the complete image, with this height. `title` and `description` are for screen
    /// readers.
    pub(super) fn finish(self, height: f64, title: &str, description: &str) -> String {
        let view_box = format!("0 0 {WIDTH} {height:.0}");
        let image = html! {
            svg xmlns="http://www.w3.org/2000/svg" role="img" viewBox=(view_box)
                font-family="system-ui, sans-serif" font-size=(FONT_SIZE) stroke-linejoin="round" {
                title { (svg::text(title)) }
                desc { (svg::text(description)) }
                (PreEscaped(self.body))
            }
        };
        image.into_string()
    }

    /// Draws a straight line.
    pub(super) fn line(&mut self, from: DVec2, to: DVec2, line: LineStyle) {
        if is_drawable(from) && is_drawable(to) {
            self.path(&svg::path(&[from, to]), line, Fill::None);
        }
    }

    /// Draws a closed polygon, or nothing if a corner is far off the page.
    pub(super) fn polygon(&mut self, corners: &[DVec2], line: LineStyle, fill: Fill) {
        self.polygons(&[corners], line, fill);
    }

    /// Draws several polygons in the same style.
    pub(super) fn polygons(&mut self, all: &[impl AsRef<[DVec2]>], line: LineStyle, fill: Fill) {
        let polygons = all.iter().map(AsRef::as_ref);
        let drawable = polygons.filter(|corners| corners.iter().all(|corner| is_drawable(*corner)));
        let path: String = drawable.map(svg::closed_path).collect();
        if !path.is_empty() {
            self.path(&path, line, fill);
        }
    }

    fn path(&mut self, data: &str, line: LineStyle, fill: Fill) {
        let stroke = line.stroke();
        self.add(&html! {
            path d=(data) fill=(fill.paint()) fill-opacity=[fill.opacity()]
                stroke=(stroke.paint) stroke-opacity=[stroke.opacity]
                stroke-width=(stroke.width) stroke-dasharray=[stroke.dashes] {}
        });
    }

    /// Draws a rectangle from two opposite corners.
    pub(super) fn rectangle(&mut self, from: DVec2, to: DVec2, line: LineStyle, fill: Fill) {
        self.polygon(&rectangle(from, to), line, fill);
    }

    /// Fills a rectangle between two opposite corners, without an outline.
    pub(super) fn area(&mut self, from: DVec2, to: DVec2, fill: Fill) {
        if is_drawable(from) && is_drawable(to) {
            let (min, size) = (from.min(to), (to - from).abs());
            self.add(&html! {
                rect x=(number(min.x)) y=(number(min.y)) width=(number(size.x))
                    height=(number(size.y)) fill=(fill.paint()) fill-opacity=[fill.opacity()] {}
            });
        }
    }

    /// Draws a circle.
    pub(super) fn circle(&mut self, center: DVec2, radius: f64, line: LineStyle, fill: Fill) {
        if is_drawable(center) && radius.is_finite() && radius < MAX_COORDINATE {
            let stroke = line.stroke();
            self.add(&html! {
                circle cx=(number(center.x)) cy=(number(center.y)) r=(number(radius))
                    fill=(fill.paint()) fill-opacity=[fill.opacity()]
                    stroke=(stroke.paint) stroke-opacity=[stroke.opacity]
                    stroke-width=(stroke.width) stroke-dasharray=[stroke.dashes] {}
            });
        }
    }

    /// Draws the part of an arrow that is inside a window. The head is at the second point, or
    /// where the arrow leaves the window.
    pub(super) fn arrow(&mut self, window: &Window, [from, to]: [DVec2; 2], line: LineStyle) {
        let Some((from, to)) = window.clip_segment(from, to) else {
            return;
        };
        self.line(from, to, line);
        let Some(dir) = (to - from).try_normalize() else {
            return;
        };
        let (back, across) = (to - 9.0 * dir, 4.0 * dir.perp());
        if is_drawable(to) {
            let head = svg::closed_path(&[to, back + across, back - across]);
            self.add(&html! { path d=(head) fill=(line.stroke().paint) {} });
        }
    }

    /// Draws a mark.
    pub(super) fn mark(&mut self, at: DVec2, mark: Mark) {
        if !is_drawable(at) {
            return;
        }
        let (x, y) = (number(at.x), number(at.y));
        self.add(&match mark {
            Mark::Right => html! {
                circle cx=(x) cy=(y) r="5.5" fill=(Ink::Right.paint())
                    stroke=(PAPER) stroke-width="1.5" {}
            },
            Mark::Wrong => {
                let arm =
                    |x: f64, y: f64| svg::path(&[at - 5.5 * dvec2(x, y), at + 5.5 * dvec2(x, y)]);
                let cross = arm(1.0, 1.0) + &arm(1.0, -1.0);
                // Draw the cross twice, first wider and in the background colour, so that a border
                // separates it from the lines below it.
                html! {
                    path d=(cross) fill="none" stroke=(PAPER) stroke-width="6" {}
                    path d=(cross) fill="none" stroke=(Ink::Wrong.paint()) stroke-width="3" {}
                }
            }
            Mark::Origin => html! {
                circle cx=(x) cy=(y) r="4" fill=(PAPER) stroke="currentColor" stroke-width="2" {}
            },
        });
    }

    /// Draws the part of a line that is inside a window.
    pub(super) fn segment(&mut self, window: &Window, [from, to]: [DVec2; 2], line: LineStyle) {
        if let Some((from, to)) = window.clip_segment(from, to) {
            self.line(from, to, line);
        }
    }

    /// Draws a ray's line: its range, and the parts behind and ahead of its origin. `at` returns
    /// the point at a given distance along the ray. The line is drawn up to the distance `far` in
    /// both directions.
    pub(super) fn ray(
        &mut self,
        window: &Window,
        range: Option<Interval>,
        far: f64,
        at: impl Fn(f64) -> DVec2,
    ) {
        if let Some(range) = range {
            let ends = [range.min, range.max].map(|end| at(f64::from(end).clamp(-far, far)));
            self.segment(window, ends, LineStyle::Range);
        }
        self.segment(window, [at(-far), at(0.0)], LineStyle::Behind);
        self.segment(window, [at(0.0), at(far)], LineStyle::Ray);
    }

    /// Draws a mark in a window, or at its border if the point is outside.
    pub(super) fn mark_pinned(&mut self, window: &Window, at: Option<DVec2>, mark: Mark) {
        if let Some((at, _)) = at.and_then(|at| window.pin_to_border(at)) {
            self.mark(at, mark);
        }
    }

    /// Draws a mark if its point is in a window.
    pub(super) fn mark_inside(&mut self, window: &Window, at: DVec2, mark: Mark) {
        if let Some((at, false)) = window.pin_to_border(at) {
            self.mark(at, mark);
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
        self.add(&html! {
            text x=(number(at.x)) y=(number(at.y)) text-anchor=(anchor)
                fill=(ink.paint()) fill-opacity=[ink.opacity()]
                stroke=(PAPER) stroke-width="3" paint-order="stroke" {
                (svg::text(text))
            }
        });
    }

    fn add(&mut self, element: &Markup) {
        if self.body.len() < MAX_BYTES {
            element.render_to(&mut self.body);
        }
    }
}

/// Returns the corners of a rectangle, given two opposite corners.
pub(super) fn rectangle(from: DVec2, to: DVec2) -> [DVec2; 4] {
    [from, dvec2(to.x, from.y), to, dvec2(from.x, to.y)]
}

fn is_drawable(at: DVec2) -> bool {
    // This is also false for NaN.
    at.abs().max_element() < MAX_COORDINATE && at.is_finite()
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
