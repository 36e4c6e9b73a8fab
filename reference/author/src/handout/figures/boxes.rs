//! Figures of the chapter "Ray-box intersection".

use glam::{DVec2, dvec2};

use super::drawing::{Drawing, Hue, Side};

/// The times at which the ray of the first two figures enters and leaves each slab.
const X: [f64; 2] = [2.0, 6.0];
const Y: [f64; 2] = [3.0, 7.5];
const Z: [f64; 2] = [0.8, 6.8];
/// The argument `times` of the example.
const TIMES: [f64; 2] = [2.4, 9.0];

/// Draws two slabs, the box where they overlap, and a ray through the box.
pub fn slabs() -> String {
    let mut drawing = Drawing::new(480.0, 330.0);
    let (origin, step) = (dvec2(40.0, 300.0), dvec2(46.0, -32.0));
    let at = |t: f64| origin + t * step;
    let (low, high) = (dvec2(at(X[0]).x, at(Y[0]).y), dvec2(at(X[1]).x, at(Y[1]).y));
    let across = [dvec2(low.x, 15.0), dvec2(high.x, 315.0)];
    let along = [dvec2(15.0, high.y), dvec2(465.0, low.y)];
    drawing
        .area(Hue::Orange, &super::drawing::corners(across[0], across[1]))
        .area(Hue::Green, &super::drawing::corners(along[0], along[1]));
    for x in [low.x, high.x] {
        drawing.line(Hue::Orange, dvec2(x, 15.0), dvec2(x, 315.0));
    }
    for y in [low.y, high.y] {
        drawing.line(Hue::Green, dvec2(15.0, y), dvec2(465.0, y));
    }
    drawing
        .open_box(Hue::Ink, low, high)
        .arrow(Hue::Blue, origin, at(8.8))
        .dot(Hue::Ink, origin);
    for (t, hue) in [(X[0], Hue::Orange), (Y[0], Hue::Green)] {
        drawing.dot(hue, at(t));
    }
    for (t, hue) in [(X[1], Hue::Orange), (Y[1], Hue::Green)] {
        drawing.ring(hue, at(t));
    }
    drawing
        .small_label(
            Hue::Orange,
            Side::Left,
            at(X[0]) + dvec2(-8.0, -6.0),
            "2: enters x",
        )
        .small_label(
            Hue::Green,
            Side::Right,
            at(Y[0]) + dvec2(9.0, 16.0),
            "3: enters y",
        )
        .small_label(
            Hue::Orange,
            Side::Right,
            at(X[1]) + dvec2(9.0, 16.0),
            "6: leaves x",
        )
        .small_label(
            Hue::Green,
            Side::Left,
            at(Y[1]) + dvec2(-10.0, -8.0),
            "7.5: leaves y",
        )
        .label(
            Hue::Orange,
            Side::Middle,
            dvec2(low.x.midpoint(high.x), 306.0),
            "x slab",
        )
        .label(
            Hue::Green,
            Side::Left,
            dvec2(low.x - 12.0, low.y - 14.0),
            "y slab",
        )
        .label(
            Hue::Ink,
            Side::Left,
            dvec2(high.x - 8.0, high.y + 22.0),
            "the box",
        );
    drawing.finish(
        "Two slabs and a ray",
        "The x slab is a vertical band, the y slab a horizontal one; the box is where they cross. \
         The ray enters the x slab at time 2 and the y slab at time 3, and leaves the x slab at 6 \
         and the y slab at 7.5. It is in the box from 3, the last entry, to 6, the first exit.",
    )
}

/// Draws the intervals of time in which the same ray is in each slab, with a third slab and the
/// argument `times`.
pub fn times() -> String {
    let mut drawing = Drawing::new(480.0, 290.0);
    let point = |t: f64, row: f64| dvec2(110.0 + 38.0 * t, 40.0 + 40.0 * row);
    let enter = X[0].max(Y[0]).max(Z[0]).max(TIMES[0]);
    let leave = X[1].min(Y[1]).min(Z[1]).min(TIMES[1]);
    drawing
        .area(
            Hue::Blue,
            &super::drawing::corners(point(enter, -0.5), point(leave, 4.3)),
        )
        .dashed(Hue::Blue, point(enter, -0.5), point(enter, 4.3))
        .dashed(Hue::Blue, point(leave, -0.5), point(leave, 4.3));
    let rows = [
        ("x slab", X, Hue::Orange),
        ("y slab", Y, Hue::Green),
        ("z slab", Z, Hue::Pink),
        ("times", TIMES, Hue::Ink),
        ("all of them", [enter, leave], Hue::Blue),
    ];
    for (row, (name, [from, to], hue)) in (0..).zip(rows) {
        let row = f64::from(row);
        let tick = dvec2(0.0, 7.0);
        let (a, b) = (point(from, row), point(to, row));
        drawing
            .label(hue, Side::Left, dvec2(98.0, a.y + 6.0), name)
            .line(hue, a, b)
            .line(hue, a - tick, a + tick)
            .line(hue, b - tick, b + tick);
    }
    drawing.arrow(Hue::Soft, point(0.0, 5.0), point(9.3, 5.0));
    for t in 0..=9 {
        let at = point(f64::from(t), 5.0);
        drawing
            .line(Hue::Soft, at - dvec2(0.0, 4.0), at + dvec2(0.0, 4.0))
            .small_label(
                Hue::Soft,
                Side::Middle,
                at + dvec2(0.0, 22.0),
                &t.to_string(),
            );
    }
    drawing.label(
        Hue::Soft,
        Side::Right,
        point(9.3, 5.0) + dvec2(2.0, 5.0),
        "t",
    );
    drawing.finish(
        "Intervals of time and their intersection",
        "Five intervals above a time axis: the x slab from 2 to 6, the y slab from 3 to 7.5, the z \
         slab from 0.8 to 6.8, and the argument times from 2.4 to 9. Their intersection is 3 to 6, \
         from the last entry to the first exit.",
    )
}

/// Draws the special cases: a direction whose x component is zero, and a flat box.
pub fn special() -> String {
    let mut drawing = Drawing::new(480.0, 300.0);
    let (low, high) = (dvec2(90.0, 110.0), dvec2(190.0, 200.0));
    drawing
        .area(
            Hue::Orange,
            &super::drawing::corners(dvec2(low.x, 50.0), dvec2(high.x, 265.0)),
        )
        .dashed(Hue::Orange, dvec2(low.x, 50.0), dvec2(low.x, 265.0))
        .dashed(Hue::Orange, dvec2(high.x, 50.0), dvec2(high.x, 265.0))
        .open_box(Hue::Ink, low, high);
    for (x, hue) in [(45.0, Hue::Soft), (140.0, Hue::Blue), (235.0, Hue::Soft)] {
        drawing
            .arrow(hue, dvec2(x, 250.0), dvec2(x, 62.0))
            .dot(Hue::Ink, dvec2(x, 250.0));
    }
    drawing
        .label(Hue::Ink, Side::Middle, dvec2(140.0, 28.0), "d_x = 0")
        .small_label(Hue::Soft, Side::Middle, dvec2(45.0, 284.0), "+∞ +∞")
        .small_label(Hue::Blue, Side::Middle, dvec2(140.0, 284.0), "−∞ +∞")
        .small_label(Hue::Soft, Side::Middle, dvec2(235.0, 284.0), "−∞ −∞");
    let flat = [dvec2(310.0, 150.0), dvec2(460.0, 150.0)];
    drawing
        .line(Hue::Ink, flat[0], flat[1])
        .arrow(Hue::Blue, dvec2(325.0, 245.0), dvec2(445.0, 65.0))
        .dot(Hue::Ink, dvec2(325.0, 245.0))
        .dot(
            Hue::Blue,
            at_height(dvec2(325.0, 245.0), dvec2(445.0, 65.0), 150.0),
        )
        .label(Hue::Ink, Side::Middle, dvec2(385.0, 28.0), "min.y = max.y")
        .small_label(Hue::Blue, Side::Left, dvec2(380.0, 138.0), "enter = leave")
        .small_label(Hue::Blue, Side::Middle, dvec2(385.0, 284.0), "a hit");
    drawing.finish(
        "A direction without an x component, and a flat box",
        "Left: three rays whose direction has the x component zero. Dividing by zero gives plus \
         and plus infinity for the ray left of the x slab, minus and plus infinity for the one \
         inside it, and minus and minus infinity for the one right of it. Right: a flat box. The \
         ray enters and leaves it at the same time, and that is a hit.",
    )
}

/// Returns the point of the line from `a` to `b` at height `y`.
fn at_height(a: DVec2, b: DVec2, y: f64) -> DVec2 {
    a.lerp(b, (y - a.y) / (b.y - a.y))
}
