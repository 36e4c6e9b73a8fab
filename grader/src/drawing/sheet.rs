//! One drawing from top to bottom: panels, bars over an axis, and what the signs mean.

use glam::{DVec2, dvec2};

use super::Drawing;
use super::canvas::{Anchor, Canvas, Mark, WIDTH};
use super::ink::{Fill, Ink, Line};
use super::window::Part;

/// The height of a line of the legend.
const ROW: f64 = 18.0;
/// The most characters of one line of the legend.
const LONGEST: usize = 47;

/// What a line of the legend explains.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sign {
    /// A mark.
    Mark(Mark),
    /// A line.
    Line(Line),
    /// An area.
    Area(Fill),
    /// Nothing: a remark.
    None,
}

/// A drawing, filled from the top.
#[derive(Clone, Debug, Default)]
pub(super) struct Sheet {
    /// What is drawn.
    pub(super) canvas: Canvas,
    /// How far down the page is full.
    pub(super) y: f64,
    words: Vec<String>,
}

impl Sheet {
    /// The next part of the page, over the whole width, with a border.
    pub(super) fn panel(&mut self, height: f64) -> Part {
        let part = self.part(1.0, WIDTH - 1.0, height);
        self.take(height + 6.0);
        part
    }

    /// Two parts side by side, each under its title.
    pub(super) fn panels(&mut self, titles: [&str; 2], height: f64) -> [Part; 2] {
        let middle = WIDTH / 2.0;
        self.titles([(1.0, titles[0]), (middle + 3.0, titles[1])]);
        let parts = [
            self.part(1.0, middle - 3.0, height),
            self.part(middle + 3.0, WIDTH - 1.0, height),
        ];
        self.take(height + 6.0);
        parts
    }

    fn titles(&mut self, titles: [(f64, &str); 2]) {
        for (x, title) in titles {
            let at = dvec2(x, self.y + 12.0);
            self.canvas.text(at, Anchor::Start, Ink::Faint, title);
        }
        self.take(ROW);
    }

    fn part(&mut self, left: f64, right: f64, height: f64) -> Part {
        let part = Part {
            min: dvec2(left, self.y + 1.0),
            max: dvec2(right, self.y + height - 1.0),
        };
        self.canvas
            .rectangle(part.min, part.max, Line::Grid, Fill::None);
        part
    }

    /// A title over what comes next.
    pub(super) fn title(&mut self, title: &str) {
        let at = dvec2(1.0, self.y + 12.0);
        self.canvas.text(at, Anchor::Start, Ink::Faint, title);
        self.take(ROW);
    }

    /// Leaves room.
    pub(super) fn take(&mut self, height: f64) {
        self.y += height;
    }

    /// What a sign means, in as many lines as it needs.
    pub(super) fn explain(&mut self, sign: Sign, words: &str) {
        let middle = dvec2(11.0, self.y + 9.0);
        self.sign(sign, middle);
        for line in lines(words) {
            let at = dvec2(26.0, self.y + 13.5);
            self.canvas.text(at, Anchor::Start, Ink::Text, &line);
            self.take(ROW);
        }
        self.words.push(words.to_owned());
    }

    fn sign(&mut self, sign: Sign, middle: DVec2) {
        let aside = dvec2(10.0, 0.0);
        match sign {
            Sign::Mark(mark) => self.canvas.mark(middle, mark),
            Sign::Line(line) => self.canvas.line(middle - aside, middle + aside, line),
            Sign::Area(fill) => {
                let corner = dvec2(9.0, 5.5);
                self.canvas
                    .rectangle(middle - corner, middle + corner, Line::Grid, fill);
            }
            Sign::None => {}
        }
    }

    /// The whole drawing.
    pub(super) fn finish(self, title: &str, caption: String) -> Drawing {
        let height = self.y + 4.0;
        let words = self.words.join("; ");
        let description = format!("{caption} {words}");
        Drawing {
            svg: self.canvas.finish(height, title, description.trim_end()),
            caption,
        }
    }
}

/// The words in lines that fit.
fn lines(words: &str) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in words.split(' ') {
        let last = lines.len() - 1;
        let length = lines[last].chars().count();
        if length > 0 && length + 1 + word.chars().count() > LONGEST {
            lines.push(word.to_owned());
        } else {
            let gap = if length > 0 { " " } else { "" };
            lines[last].push_str(&format!("{gap}{word}"));
        }
    }
    lines
}
