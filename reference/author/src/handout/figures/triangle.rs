//! Figures of the chapter "Ray-triangle intersection".

use glam::{DVec2, dvec2};

use super::drawing::{Drawing, Hue, Side};

const P0: DVec2 = dvec2(70.0, 250.0);
const P1: DVec2 = dvec2(420.0, 210.0);
const P2: DVec2 = dvec2(190.0, 50.0);

fn point(u: f64, v: f64) -> DVec2 {
    P0 + u * (P1 - P0) + v * (P2 - P0)
}

/// Draws a point of a triangle, and the three areas that are its weights.
pub fn weights() -> String {
    let mut drawing = Drawing::new(480.0, 300.0);
    let p = point(0.35, 0.3);
    drawing
        .area(Hue::Blue, &[p, P1, P2])
        .area(Hue::Orange, &[p, P2, P0])
        .area(Hue::Green, &[p, P0, P1])
        .line(Hue::Soft, p, P0)
        .line(Hue::Soft, p, P1)
        .line(Hue::Soft, p, P2)
        .outline(Hue::Ink, &[P0, P1, P2])
        .arrow(Hue::Ink, P0, P1)
        .arrow(Hue::Ink, P0, P2)
        .dot(Hue::Ink, p);
    drawing
        .label(Hue::Ink, Side::Left, P0 + dvec2(-6.0, 8.0), "p_0")
        .label(Hue::Ink, Side::Right, P1 + dvec2(10.0, 6.0), "p_1")
        .label(Hue::Ink, Side::Middle, P2 + dvec2(0.0, -14.0), "p_2")
        .label(
            Hue::Ink,
            Side::Middle,
            P0.midpoint(P1) + dvec2(6.0, 24.0),
            "e_1 = p_1 − p_0",
        )
        .label(
            Hue::Ink,
            Side::Left,
            P0.midpoint(P2) + dvec2(-12.0, 0.0),
            "e_2",
        )
        .label(Hue::Ink, Side::Right, p + dvec2(8.0, -8.0), "P")
        .label(
            Hue::Blue,
            Side::Middle,
            (p + P1 + P2) / 3.0 + dvec2(8.0, 8.0),
            "w = 0.35",
        )
        .label(
            Hue::Orange,
            Side::Middle,
            (p + P2 + P0) / 3.0 + dvec2(6.0, 16.0),
            "u = 0.35",
        )
        .label(
            Hue::Green,
            Side::Middle,
            (p + P0 + P1) / 3.0 + dvec2(6.0, 8.0),
            "v = 0.3",
        );
    drawing.finish(
        "Barycentric coordinates",
        "A triangle p0, p1, p2 with the edges e1 from p0 to p1 and e2 from p0 to p2. A point P \
         inside divides it into three parts. As fractions of the whole area, the part opposite p0 \
         is w, the part opposite p1 is u, and the part opposite p2 is v. Here u is 0.35, v is 0.3 \
         and w is 0.35.",
    )
}

/// Draws the regions in which each weight is negative.
pub fn signs() -> String {
    let mut drawing = Drawing::new(480.0, 340.0);
    let (origin, unit) = (dvec2(130.0, 250.0), 130.0);
    let position = |u: f64, v: f64| origin + unit * dvec2(u, -v);
    let triangle = [position(0.0, 0.0), position(1.0, 0.0), position(0.0, 1.0)];
    let other = [position(1.0, 0.0), position(1.0, 1.0), position(0.0, 1.0)];
    drawing
        .line(Hue::Soft, position(0.0, -0.6), position(0.0, 1.75))
        .line(Hue::Soft, position(-0.9, 0.0), position(2.4, 0.0))
        .line(Hue::Soft, position(1.6, -0.6), position(-0.75, 1.75))
        .area(Hue::Orange, &other)
        .dashed(Hue::Orange, position(1.0, 0.0), position(1.0, 1.0))
        .dashed(Hue::Orange, position(0.0, 1.0), position(1.0, 1.0))
        .area(Hue::Green, &triangle)
        .outline(Hue::Ink, &triangle)
        .dot(Hue::Green, position(0.2, 0.3))
        .cross(Hue::Orange, position(0.8, 0.7));
    drawing
        .label(Hue::Green, Side::Right, position(0.13, 0.1), "a hit")
        .small_label(
            Hue::Orange,
            Side::Right,
            position(1.06, 0.86),
            "(0.8, 0.7): u, v ≥ 0,",
        )
        .small_label(
            Hue::Orange,
            Side::Right,
            position(1.06, 0.7),
            "and w = −0.5: a miss",
        )
        .label(Hue::Ink, Side::Left, position(-0.07, -0.17), "p_0")
        .label(Hue::Ink, Side::Middle, position(0.93, -0.19), "p_1")
        .label(Hue::Ink, Side::Left, position(-0.1, 1.0), "p_2")
        .label(Hue::Soft, Side::Left, position(-0.2, 0.4), "u < 0")
        .label(Hue::Soft, Side::Middle, position(0.45, -0.4), "v < 0")
        .label(Hue::Soft, Side::Right, position(0.5, 1.35), "w < 0")
        .small_label(Hue::Soft, Side::Right, position(2.2, -0.15), "u")
        .small_label(Hue::Soft, Side::Right, position(0.06, 1.65), "v");
    drawing.finish(
        "Where the weights are negative",
        "The plane of the triangle, with u to the right and v up. Beyond each edge one weight is \
         negative: u left of the edge p0 p2, v below the edge p0 p1, and w beyond the edge p1 p2. \
         The point (0.2, 0.3) is inside. The point (0.8, 0.7) is in the other half of the \
         parallelogram: u and v are positive there, and w is minus 0.5.",
    )
}
