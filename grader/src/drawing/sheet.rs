//! A drawing that is filled from top to bottom with panels, bars over an axis and a legend.

use glam::{DVec2, dvec2};

use super::Drawing;
use super::canvas::{Anchor, Canvas, Mark, WIDTH};
use super::ink::{Fill, Ink, LineStyle};
use super::window::{Panel, Window, extent};
use crate::machine::printing::wrap;

/// The height of a line in the legend.
const ROW_HEIGHT: f64 = 18.0;
/// The maximum number of characters per line in the legend.
const MAX_LINE_CHARS: usize = 47;

/// The symbol at the start of a line in the legend.
#[derive(Clone, Copy, Debug)]
pub(super) enum Symbol {
    /// A mark, such as a disc or a cross.
    Mark(Mark),
    /// A short line in this style.
    Line(LineStyle),
    /// A small rectangle with this fill.
    Area(Fill),
    /// No symbol, for a remark.
    None,
}

/// A drawing that is filled from top to bottom.
#[derive(Clone, Debug, Default)]
pub(super) struct Sheet {
    /// The elements drawn so far.
    pub(super) canvas: Canvas,
    /// The y coordinate where the next element goes.
    pub(super) y: f64,
    legend: Vec<String>,
}

impl Sheet {
    /// Adds a full-width panel with a border.
    pub(super) fn panel(&mut self, height: f64) -> Panel {
        let panel = self.bordered_panel(1.0, WIDTH - 1.0, height);
        self.advance(height + 6.0);
        panel
    }

    /// Adds a full-width window that shows these points and has a suitable height.
    pub(super) fn window(&mut self, seen: Vec<DVec2>) -> Window {
        let size = extent(seen.iter().copied()).map_or(DVec2::ONE, |(min, max)| max - min);
        // A single point has no proportions.
        let shape = if size.x > 0.0 { size.y / size.x } else { 1.0 };
        let panel = self.panel((306.0 * shape + 32.0).clamp(100.0, 210.0));
        Window::around(panel, seen)
    }

    /// Adds two panels side by side, each with its title above it.
    pub(super) fn panels(&mut self, titles: [&str; 2], height: f64) -> [Panel; 2] {
        let middle = WIDTH / 2.0;
        self.title_at(1.0, titles[0]);
        self.title_at(middle + 3.0, titles[1]);
        self.advance(ROW_HEIGHT);
        let panels = [
            self.bordered_panel(1.0, middle - 3.0, height),
            self.bordered_panel(middle + 3.0, WIDTH - 1.0, height),
        ];
        self.advance(height + 6.0);
        panels
    }

    fn bordered_panel(&mut self, left: f64, right: f64, height: f64) -> Panel {
        let panel = Panel {
            min: dvec2(left, self.y + 1.0),
            max: dvec2(right, self.y + height - 1.0),
        };
        self.canvas
            .rectangle(panel.min, panel.max, LineStyle::Grid, Fill::None);
        panel
    }

    /// Adds a title for the elements below it.
    pub(super) fn title(&mut self, title: &str) {
        self.title_at(1.0, title);
        self.advance(ROW_HEIGHT);
    }

    fn title_at(&mut self, x: f64, title: &str) {
        let at = dvec2(x, self.y + 12.0);
        self.canvas.text(at, Anchor::Start, Ink::Faint, title);
    }

    /// Moves the position of the next element down by this height.
    pub(super) fn advance(&mut self, height: f64) {
        self.y += height;
    }

    /// Adds an entry to the legend, wrapped to as many lines as it needs.
    pub(super) fn add_legend(&mut self, symbol: Symbol, text: &str) {
        let middle = dvec2(11.0, self.y + 9.0);
        self.draw_symbol(symbol, middle);
        for line in wrap(text, MAX_LINE_CHARS) {
            let at = dvec2(26.0, self.y + 13.5);
            self.canvas.text(at, Anchor::Start, Ink::Text, &line);
            self.advance(ROW_HEIGHT);
        }
        self.legend.push(text.to_owned());
    }

    /// Adds the expected answer to the legend.
    pub(super) fn add_wanted(&mut self, symbol: Symbol, text: &str) {
        self.add_legend(symbol, &format!("wanted: {text}"));
    }

    /// Adds the submitted answer to the legend.
    pub(super) fn add_got(&mut self, symbol: Symbol, text: &str) {
        self.add_legend(symbol, &format!("got: {text}"));
    }

    fn draw_symbol(&mut self, symbol: Symbol, middle: DVec2) {
        let aside = dvec2(10.0, 0.0);
        match symbol {
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

    /// Returns the finished drawing.
    pub(super) fn finish(self, title: &str, caption: String) -> Drawing {
        let height = self.y + 4.0;
        let text = self.legend.join("; ");
        let description = format!("{caption} {text}");
        Drawing {
            svg: self.canvas.finish(height, title, description.trim_end()),
            caption,
        }
    }
}
