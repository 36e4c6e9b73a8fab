//! One drawing from top to bottom: panels, bars over an axis, and what the signs mean.

use glam::{DVec2, dvec2};

use super::Drawing;
use super::canvas::{Anchor, Canvas, Mark, WIDTH};
use super::ink::{Fill, Ink, LineStyle};
use super::window::Panel;

/// The height of a line of the legend.
const ROW_HEIGHT: f64 = 18.0;
/// The most characters of one line of the legend.
const MAX_LINE_CHARS: usize = 47;

/// What a line of the legend explains.
#[derive(Clone, Copy, Debug)]
pub(super) enum Symbol {
    /// A mark.
    Mark(Mark),
    /// A line.
    Line(LineStyle),
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
    legend: Vec<String>,
}

impl Sheet {
    /// The next part of the page, over the whole width, with a border.
    pub(super) fn panel(&mut self, height: f64) -> Panel {
        let part = self.bordered_panel(1.0, WIDTH - 1.0, height);
        self.advance(height + 6.0);
        part
    }

    /// Two parts side by side, each under its title.
    pub(super) fn panels(&mut self, titles: [&str; 2], height: f64) -> [Panel; 2] {
        let middle = WIDTH / 2.0;
        self.titles([(1.0, titles[0]), (middle + 3.0, titles[1])]);
        let parts = [
            self.bordered_panel(1.0, middle - 3.0, height),
            self.bordered_panel(middle + 3.0, WIDTH - 1.0, height),
        ];
        self.advance(height + 6.0);
        parts
    }

    fn titles(&mut self, titles: [(f64, &str); 2]) {
        for (x, title) in titles {
            let at = dvec2(x, self.y + 12.0);
            self.canvas.text(at, Anchor::Start, Ink::Faint, title);
        }
        self.advance(ROW_HEIGHT);
    }

    fn bordered_panel(&mut self, left: f64, right: f64, height: f64) -> Panel {
        let part = Panel {
            min: dvec2(left, self.y + 1.0),
            max: dvec2(right, self.y + height - 1.0),
        };
        self.canvas
            .rectangle(part.min, part.max, LineStyle::Grid, Fill::None);
        part
    }

    /// A title over what comes next.
    pub(super) fn title(&mut self, title: &str) {
        let at = dvec2(1.0, self.y + 12.0);
        self.canvas.text(at, Anchor::Start, Ink::Faint, title);
        self.advance(ROW_HEIGHT);
    }

    /// Leaves room.
    pub(super) fn advance(&mut self, height: f64) {
        self.y += height;
    }

    /// What a sign means, in as many lines as it needs.
    pub(super) fn add_legend(&mut self, sign: Symbol, words: &str) {
        let middle = dvec2(11.0, self.y + 9.0);
        self.draw_symbol(sign, middle);
        for line in wrap(words) {
            let at = dvec2(26.0, self.y + 13.5);
            self.canvas.text(at, Anchor::Start, Ink::Text, &line);
            self.advance(ROW_HEIGHT);
        }
        self.legend.push(words.to_owned());
    }

    fn draw_symbol(&mut self, sign: Symbol, middle: DVec2) {
        let aside = dvec2(10.0, 0.0);
        match sign {
            Symbol::Mark(mark) => self.canvas.mark(middle, mark),
            Symbol::Line(line) => self.canvas.line(middle - aside, middle + aside, line),
            Symbol::Area(fill) => {
                let corner = dvec2(9.0, 5.5);
                self.canvas
                    .rectangle(middle - corner, middle + corner, LineStyle::Grid, fill);
            }
            Symbol::None => {}
        }
    }

    /// The whole drawing.
    pub(super) fn finish(self, title: &str, caption: String) -> Drawing {
        let height = self.y + 4.0;
        let words = self.legend.join("; ");
        let description = format!("{caption} {words}");
        Drawing {
            svg: self.canvas.finish(height, title, description.trim_end()),
            caption,
        }
    }
}

/// The words in lines that fit.
fn wrap(words: &str) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in words.split(' ') {
        let last = lines.len() - 1;
        let length = lines[last].chars().count();
        if length > 0 && length + 1 + word.chars().count() > MAX_LINE_CHARS {
            lines.push(word.to_owned());
        } else {
            let gap = if length > 0 { " " } else { "" };
            lines[last].push_str(&format!("{gap}{word}"));
        }
    }
    lines
}
