//! Draws an environment map, shaded by how often each pixel should be picked, with the expected and
//! the submitted direction.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, UVec2, Vec3, dvec2};
use protocol::light::environment::MapImage;

use super::row::{RowComparison, last_direction};
use crate::drawing::Drawing;
use crate::drawing::canvas::{Anchor, Canvas, Mark, WIDTH, rectangle};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::numbers::short;
use crate::drawing::sheet::{Sheet, Symbol};
use crate::drawing::window::Panel;

/// The maximum number of columns. Larger maps are drawn with fewer, larger cells.
const MAX_COLUMNS: u32 = 32;
/// The number of different shades.
const SHADES: usize = 8;
/// The opacity of the strongest shade.
const MAX_TINT: f64 = 0.45;
/// The minimum width of a cell that is labelled with its share.
const MIN_LABELLED: f64 = 33.0;

/// Draws the map. The marks are at the direction that a sample should have and the one it has, or at
/// the direction whose density is computed.
pub(super) fn draw(map: &MapImage, row: &RowComparison) -> Option<Drawing> {
    let grid = Grid::new(map)?;
    let mut sheet = Sheet::default();
    sheet.title("the map: φ to the right, θ downward");
    let height = (WIDTH - 2.0) * f64::from(grid.size.y) / f64::from(grid.size.x);
    let panel = sheet.panel(height.clamp(60.0, 240.0) + 2.0);
    grid.draw(&mut sheet.canvas, panel);

    let asked = last_direction(row.input.as_ref());
    let marks = [
        (asked, Mark::Origin),
        (row.wanted_direction(), Mark::Right),
        (row.wrong_direction(), Mark::Wrong),
    ];
    for (direction, mark) in marks {
        if let Some(position) = direction.and_then(map_position) {
            let at = panel.min + position * (panel.max - panel.min);
            sheet.canvas.mark(at, mark);
        }
    }
    row.add_results(&mut sheet, [Mark::Right, Mark::Wrong].map(Symbol::Mark));
    if let Some(share) = asked.and_then(|asked| grid.share_at(map_position(asked)?)) {
        let text = format!(
            "the direction, in a pixel with {}% of the weight",
            short(100.0 * share)
        );
        sheet.add_legend(Symbol::Mark(Mark::Origin), &text);
    }
    let fill = Fill::Tint(Ink::Text, 0.5 * MAX_TINT);
    let text =
        "the more often a pixel should be picked, the stronger its shade; black pixels have none";
    sheet.add_legend(Symbol::Area(fill), text);
    let title = "The environment map, shaded by how often each pixel should be picked";
    Some(sheet.finish(title, row.caption()))
}

/// Returns a direction's position in the map, from (0, 0) at the upper left to (1, 1). Returns
/// `None` if the direction isn't one.
fn map_position(direction: DVec3) -> Option<DVec2> {
    let unit = direction.try_normalize()?;
    let turn = unit.z.atan2(unit.x).rem_euclid(TAU) / TAU;
    Some(dvec2(turn, unit.y.clamp(-1.0, 1.0).acos() / PI))
}

/// The cells of the drawing: the pixels, or blocks of pixels if the map is large.
struct Grid {
    size: UVec2,
    /// Each cell's share of the weights, row by row from the top.
    shares: Vec<f64>,
}

impl Grid {
    /// Sums up the weights of the pixels in each cell, which the starter defines. Returns `None` if
    /// the map has no pixels.
    fn new(map: &MapImage) -> Option<Grid> {
        let block = map.size.x.div_ceil(MAX_COLUMNS).max(1);
        let size = UVec2::new(map.size.x.div_ceil(block), map.size.y.div_ceil(block));
        let mut shares = vec![0.0; size.element_product() as usize];
        for (pixel, color) in (0u32..).zip(&map.pixels) {
            let at = UVec2::new(pixel % map.size.x, pixel / map.size.x);
            let theta = (f64::from(at.y) + 0.5) / f64::from(map.size.y) * PI;
            let cell = at / block;
            let cell = shares.get_mut((cell.y * size.x + cell.x) as usize)?;
            *cell += luminance(*color) * theta.sin();
        }
        let sum: f64 = shares.iter().sum();
        for share in &mut shares {
            *share /= sum.max(1e-30);
        }
        (!shares.is_empty()).then_some(Grid { size, shares })
    }

    fn share_at(&self, position: DVec2) -> Option<f64> {
        let cell = (position * self.size.as_dvec2())
            .as_uvec2()
            .min(self.size - 1);
        self.shares
            .get((cell.y * self.size.x + cell.x) as usize)
            .copied()
    }

    fn draw(&self, canvas: &mut Canvas, panel: Panel) {
        let step = (panel.max - panel.min) / self.size.as_dvec2();
        let corner = |cell: usize| {
            let width = self.size.x as usize;
            panel.min + step * dvec2((cell % width) as f64, (cell / width) as f64)
        };
        let largest = self.shares.iter().copied().fold(0.0, f64::max);
        // All cells of a shade are one element, which keeps the drawing small.
        let mut shades = vec![Vec::new(); SHADES + 1];
        for (cell, share) in self.shares.iter().enumerate() {
            // The cube root shows differences between shares that are far smaller than the largest.
            let shade = (share / largest.max(1e-30)).cbrt() * SHADES as f64;
            let corners = rectangle(corner(cell), corner(cell) + step);
            shades[(shade.ceil() as usize).min(SHADES)].push(corners);
        }
        for (shade, cells) in shades.iter().enumerate() {
            let tint = MAX_TINT * shade as f64 / SHADES as f64;
            canvas.polygons(cells, LineStyle::Grid, Fill::Tint(Ink::Text, tint));
        }
        if step.x >= MIN_LABELLED {
            let shares = self.shares.iter().enumerate();
            for (cell, share) in shares.filter(|(_, share)| **share > 0.0) {
                let at = corner(cell) + dvec2(0.5 * step.x, step.y - 5.0);
                let text = match 100.0 * share {
                    percent if percent < 0.5 => "<1%".to_owned(),
                    percent => format!("{percent:.0}%"),
                };
                canvas.text(at, Anchor::Middle, Ink::Text, &text);
            }
        }
    }
}

/// Returns the luminance of a colour according to Rec. 709.
fn luminance(color: Vec3) -> f64 {
    color.as_dvec3().dot(DVec3::new(0.2126, 0.7152, 0.0722))
}
