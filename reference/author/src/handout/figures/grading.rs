//! Figures of the chapter "How grading works".

use glam::{DVec2, dvec2};
use protocol::PIXEL_OFFSETS;

use super::drawing::{Drawing, Hue, Side};

/// Draws a pixel with an edge through it, and the answers that are correct at its five positions.
pub fn edge() -> String {
    let mut drawing = Drawing::new(480.0, 300.0);
    let (corner, side) = (dvec2(30.0, 24.0), 240.0);
    let point = |at: DVec2| corner + side * dvec2(at.x, 1.0 - at.y);
    let (low, high) = (dvec2(0.13, 0.0), dvec2(0.87, 1.0));
    let left = [dvec2(0.0, 0.0), low, high, dvec2(0.0, 1.0)];
    let right = [low, dvec2(1.0, 0.0), dvec2(1.0, 1.0), high];
    drawing
        .area(Hue::Blue, &left.map(point))
        .area(Hue::Orange, &right.map(point))
        .line(Hue::Ink, point(low), point(high))
        .open_box(Hue::Ink, corner, corner + side);
    for offset in PIXEL_OFFSETS {
        let at = offset.as_dvec2();
        let beside = (high - low).perp_dot(at - low);
        let hue = match beside {
            _ if beside.abs() < 1e-6 => Hue::Green,
            _ if beside > 0.0 => Hue::Blue,
            _ => Hue::Orange,
        };
        drawing.dot(hue, point(at));
    }
    drawing
        .dashed(Hue::Green, point(dvec2(0.5, 0.5)), dvec2(300.0, 144.0))
        .label(Hue::Green, Side::Right, dvec2(306.0, 140.0), "on the edge:")
        .label(
            Hue::Green,
            Side::Right,
            dvec2(306.0, 162.0),
            "both are correct",
        )
        .label(
            Hue::Blue,
            Side::Right,
            dvec2(286.0, 236.0),
            "left of it: a hit",
        )
        .label(
            Hue::Orange,
            Side::Right,
            dvec2(286.0, 60.0),
            "right of it: a miss",
        )
        .small_label(
            Hue::Ink,
            Side::Middle,
            dvec2(150.0, 288.0),
            "one pixel, five positions",
        );
    drawing.finish(
        "A pixel with an edge in it",
        "One pixel with five positions, and an edge through the middle one. At the two positions \
         left of the edge only a hit is correct, and at the two right of it only a miss. At the \
         middle one, on the edge, both are.",
    )
}
