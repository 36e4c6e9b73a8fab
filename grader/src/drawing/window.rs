//! Windows, which map a plane in the world to a panel on the page. The mapping is to scale, and
//! segments are clipped to the panel.

use glam::{DVec2, dvec2};

/// A rectangular part of the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Panel {
    /// The upper left corner.
    pub(super) min: DVec2,
    /// The lower right corner.
    pub(super) max: DVec2,
}

/// The part of a plane that a panel shows. The plane's y axis points up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    panel: Panel,
    center: DVec2,
    scale: f64,
}

impl Window {
    /// Creates a window that shows all finite points, with a margin.
    pub(super) fn around(panel: Panel, points: impl IntoIterator<Item = DVec2>) -> Window {
        /// The margin on each side, in page units.
        const MARGIN: f64 = 20.0;

        let (min, max) = extent(points).unwrap_or((DVec2::NEG_ONE, DVec2::ONE));
        let available = panel.max - panel.min - 2.0 * MARGIN;
        let size = max - min;
        // The lower bound avoids a division by zero for a single point, which is centred at any
        // scale.
        let scale = (available / size.max(DVec2::splat(1e-12))).min_element();
        Window {
            panel,
            center: 0.5 * (min + max),
            scale,
        }
    }

    /// Converts a point to page coordinates.
    pub(super) fn page_position(&self, at: DVec2) -> DVec2 {
        let middle = 0.5 * (self.panel.min + self.panel.max);
        middle + self.scale * (at - self.center) * dvec2(1.0, -1.0)
    }

    /// Converts a length to page units.
    pub(super) fn page_length(&self, length: f64) -> f64 {
        self.scale * length
    }

    /// Converts a length in page units to a length in the world.
    pub(super) fn world_length(&self, length: f64) -> f64 {
        length / self.scale
    }

    /// Converts a point to page coordinates and clamps it to the panel. The flag says whether the
    /// point was outside the panel. Returns `None` if the point isn't finite.
    pub(super) fn pin_to_border(&self, at: DVec2) -> Option<(DVec2, bool)> {
        let (min, max) = (self.panel.min + 7.0, self.panel.max - 7.0);
        let page = self.page_position(at);
        let inside = page.clamp(min, max);
        page.is_finite().then_some((inside, inside != page))
    }

    /// Returns the distance between the panel and a point outside it, in world units.
    pub(super) fn distance_outside(&self, at: DVec2) -> f64 {
        let page = self.page_position(at);
        self.world_length(page.distance(page.clamp(self.panel.min, self.panel.max)))
    }

    /// Clips a segment to the panel, one side of the panel at a time (Sutherland and Hodgman,
    /// "Reentrant polygon clipping", Communications of the ACM 17, 1974). Returns the ends of the
    /// visible part in page coordinates, or `None` if no part is visible.
    pub(super) fn clip_segment(&self, from: DVec2, to: DVec2) -> Option<(DVec2, DVec2)> {
        let (from, to) = (self.page_position(from), self.page_position(to));
        if !(from.is_finite() && to.is_finite()) {
            return None;
        }
        // Far enough away to look infinite, but near enough to be precise in `f64`.
        let farthest = DVec2::splat(1e9);
        let [mut from, mut to] = [from, to].map(|at| at.clamp(-farthest, farthest));
        for axis in 0..2 {
            for (side, inward) in [(self.panel.min[axis], 1.0), (self.panel.max[axis], -1.0)] {
                let [a, b] = [from, to].map(|end| inward * (end[axis] - side));
                match (a < 0.0, b < 0.0) {
                    (true, true) => return None,
                    (true, false) => from = from.lerp(to, a / (a - b)),
                    (false, true) => to = to.lerp(from, b / (b - a)),
                    (false, false) => {}
                }
            }
        }
        Some((from, to))
    }
}

/// Returns the smallest and largest coordinates of the finite points, if any.
pub(super) fn extent(points: impl IntoIterator<Item = DVec2>) -> Option<(DVec2, DVec2)> {
    let finite = points.into_iter().filter(|point| point.is_finite());
    finite.fold(None, |so_far, point| match so_far {
        None => Some((point, point)),
        Some((min, max)) => Some((point.min(min), point.max(max))),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PANEL: Panel = Panel {
        min: DVec2::ZERO,
        max: dvec2(140.0, 140.0),
    };

    #[test]
    fn keeps_proportions_and_points_y_up() {
        let window = Window::around(PANEL, [dvec2(0.0, 0.0), dvec2(10.0, 5.0)]);
        assert_eq!(window.page_position(dvec2(0.0, 2.5)), dvec2(20.0, 70.0));
        assert_eq!(window.page_position(dvec2(10.0, 7.5)), dvec2(120.0, 20.0));
    }

    #[test]
    fn clips_long_segments_at_the_border() {
        let window = Window::around(PANEL, [DVec2::NEG_ONE, DVec2::ONE]);
        let (from, to) = window
            .clip_segment(dvec2(-1e30, 0.0), dvec2(1e30, 0.0))
            .expect("the segment crosses the panel");
        assert!(
            from.abs_diff_eq(dvec2(0.0, 70.0), 1e-3) && to.abs_diff_eq(dvec2(140.0, 70.0), 1e-3)
        );
        assert_eq!(window.clip_segment(dvec2(-9.0, 5.0), dvec2(9.0, 5.0)), None);
        assert_eq!(window.clip_segment(DVec2::NAN, DVec2::ZERO), None);
    }

    #[test]
    fn pins_points_off_the_page_to_the_border() {
        let window = Window::around(PANEL, [DVec2::NEG_ONE, DVec2::ONE]);
        assert_eq!(
            window.pin_to_border(DVec2::ZERO),
            Some((dvec2(70.0, 70.0), false))
        );
        assert_eq!(
            window.pin_to_border(dvec2(1e30, 0.0)),
            Some((dvec2(133.0, 70.0), true))
        );
        assert_eq!(window.pin_to_border(DVec2::INFINITY), None);
    }
}
