//! From a plane of the world to a part of the page: to scale, and clipped.

use glam::{DVec2, dvec2};

/// A part of the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Panel {
    /// Its upper left corner.
    pub(super) min: DVec2,
    /// Its lower right corner.
    pub(super) max: DVec2,
}

/// What of a plane is seen in a part of the page. The plane's y goes up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    panel: Panel,
    center: DVec2,
    scale: f64,
}

impl Window {
    /// Around these points, those of them that are finite, with a margin.
    pub(super) fn around(part: Panel, points: impl IntoIterator<Item = DVec2>) -> Window {
        /// Of the part, on each side, in page units.
        const MARGIN: f64 = 20.0;

        let (min, max) = extent(points).unwrap_or((DVec2::NEG_ONE, DVec2::ONE));
        let room = part.max - part.min - 2.0 * MARGIN;
        let size = max - min;
        // One point has no size: whatever the scale, it is in the middle.
        let scale = (room / size.max(DVec2::splat(1e-12))).min_element();
        Window {
            panel: part,
            center: 0.5 * (min + max),
            scale,
        }
    }

    /// The point's place on the page.
    pub(super) fn to_page(&self, at: DVec2) -> DVec2 {
        let middle = 0.5 * (self.panel.min + self.panel.max);
        middle + self.scale * (at - self.center) * dvec2(1.0, -1.0)
    }

    /// So long is a length of the world on the page.
    pub(super) fn to_page_length(&self, length: f64) -> f64 {
        self.scale * length
    }

    /// So long is a length on the page in the world.
    pub(super) fn to_world_length(&self, length: f64) -> f64 {
        length / self.scale
    }

    /// The point's place on the page, or the nearest one at the border and `true`. None for what is
    /// not finite.
    pub(super) fn pin_to_border(&self, at: DVec2) -> Option<(DVec2, bool)> {
        let (min, max) = (self.panel.min + 7.0, self.panel.max - 7.0);
        let page = self.to_page(at);
        let inside = page.clamp(min, max);
        page.is_finite().then_some((inside, inside != page))
    }

    /// How far a point is outside of what is seen.
    pub(super) fn distance_outside(&self, at: DVec2) -> f64 {
        let page = self.to_page(at);
        self.to_world_length(page.distance(page.clamp(self.panel.min, self.panel.max)))
    }

    /// The part of a segment that is seen, on the page: what is outside of one side after the other
    /// is cut off (Sutherland and Hodgman, "Reentrant polygon clipping", Communications of the ACM
    /// 17, 1974).
    pub(super) fn clip_segment(&self, from: DVec2, to: DVec2) -> Option<(DVec2, DVec2)> {
        let (from, to) = (self.to_page(from), self.to_page(to));
        if !(from.is_finite() && to.is_finite()) {
            return None;
        }
        // So far off that nobody sees the difference, and near enough for what f64 can tell apart.
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

/// The least and largest coordinates of those points that are finite; none if there is no such.
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
        assert_eq!(window.to_page(dvec2(0.0, 2.5)), dvec2(20.0, 70.0));
        assert_eq!(window.to_page(dvec2(10.0, 7.5)), dvec2(120.0, 20.0));
    }

    #[test]
    fn clips_long_segments_at_the_border() {
        let window = Window::around(PANEL, [DVec2::NEG_ONE, DVec2::ONE]);
        let (from, to) = window
            .clip_segment(dvec2(-1e30, 0.0), dvec2(1e30, 0.0))
            .expect("it passes through");
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
