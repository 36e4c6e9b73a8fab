//! Figures of "Walking a BVH".

use glam::{DVec2, dvec2};

use super::drawing::{Drawing, Hue, Side};

/// The height of the ray in these figures, and the place of a time on it.
const RAY: f64 = 120.0;

fn on_ray(t: f64) -> DVec2 {
    dvec2(30.0 + 42.0 * t, RAY)
}

/// A box over some of the ray, from `up` above it to `down` below it.
fn node(drawing: &mut Drawing, hue: Hue, from: f64, to: f64, up: f64, down: f64) {
    let (a, b) = (on_ray(from) - dvec2(0.0, up), on_ray(to) + dvec2(0.0, down));
    drawing.filled_box(hue, a, b);
}

fn ray(drawing: &mut Drawing, hit: f64) {
    drawing
        .dashed(Hue::Soft, on_ray(hit), on_ray(10.6))
        .line(Hue::Blue, on_ray(0.0), on_ray(hit))
        .dot(Hue::Ink, on_ray(0.0))
        .words(Hue::Ink, Side::Middle, on_ray(0.0) + dvec2(0.0, -14.0), "o");
}

/// A surface across the ray.
fn surface(drawing: &mut Drawing, hue: Hue, t: f64, lean: f64) {
    let half = dvec2(lean, 34.0);
    drawing.line(hue, on_ray(t) - half, on_ray(t) + half);
}

fn mark(drawing: &mut Drawing, hue: Hue, side: Side, t: f64, text: &str) {
    let foot = on_ray(t) + dvec2(0.0, 104.0);
    drawing
        .dashed(hue, on_ray(t), foot)
        .small(hue, side, foot + dvec2(0.0, 18.0), text);
}

/// The second box begins beyond the hit in the first: it is not entered.
pub fn pruned() -> String {
    let mut drawing = Drawing::new(480.0, 270.0);
    drawing.open_box(
        Hue::Ink,
        on_ray(1.4) - dvec2(0.0, 96.0),
        on_ray(10.2) + dvec2(0.0, 86.0),
    );
    node(&mut drawing, Hue::Blue, 2.0, 6.2, 72.0, 66.0);
    node(&mut drawing, Hue::Orange, 7.0, 9.8, 60.0, 72.0);
    ray(&mut drawing, 5.0);
    surface(&mut drawing, Hue::Blue, 5.0, 18.0);
    surface(&mut drawing, Hue::Orange, 8.6, -14.0);
    drawing.dot(Hue::Blue, on_ray(5.0));
    mark(&mut drawing, Hue::Blue, Side::Middle, 2.0, "2");
    mark(&mut drawing, Hue::Blue, Side::Middle, 5.0, "5: a hit");
    mark(&mut drawing, Hue::Orange, Side::Middle, 7.0, "7 > 5");
    drawing
        .words(Hue::Ink, Side::Right, on_ray(1.4) + dvec2(4.0, -102.0), "N")
        .words(
            Hue::Blue,
            Side::Right,
            on_ray(2.0) + dvec2(8.0, -50.0),
            "A: first",
        )
        .words(
            Hue::Orange,
            Side::Right,
            on_ray(7.0) + dvec2(8.0, -38.0),
            "B: not at all",
        );
    drawing.finish(
        "A box that begins beyond the hit",
        "A ray enters box A at 2 and hits something in it at 5. It would enter box B at 7. Since 7 is \
         beyond 5, B is not entered.",
    )
}

/// The second box begins before the hit in the first: it holds a nearer one.
pub fn overlapping() -> String {
    let mut drawing = Drawing::new(480.0, 270.0);
    node(&mut drawing, Hue::Blue, 2.0, 8.8, 84.0, 50.0);
    node(&mut drawing, Hue::Orange, 4.0, 9.8, 58.0, 84.0);
    ray(&mut drawing, 5.0);
    surface(&mut drawing, Hue::Orange, 5.0, -16.0);
    surface(&mut drawing, Hue::Blue, 8.0, 12.0);
    drawing
        .dot(Hue::Orange, on_ray(5.0))
        .ring(Hue::Blue, on_ray(8.0));
    mark(&mut drawing, Hue::Blue, Side::Middle, 2.0, "2");
    mark(&mut drawing, Hue::Orange, Side::Left, 4.0, "4 < 8");
    mark(&mut drawing, Hue::Orange, Side::Right, 5.0, "5: nearer");
    mark(&mut drawing, Hue::Blue, Side::Middle, 8.0, "8: a hit");
    drawing
        .words(
            Hue::Blue,
            Side::Right,
            on_ray(2.0) + dvec2(8.0, -62.0),
            "A: first",
        )
        .words(
            Hue::Orange,
            Side::Left,
            on_ray(9.8) + dvec2(-8.0, 76.0),
            "B: as well",
        );
    drawing.finish(
        "A box that begins before the hit",
        "The boxes overlap. A ray enters box A at 2 and hits something near its far end at 8. It enters \
         box B at 4, before 8, so B must be asked as well: it holds a hit at 5, which is nearer.",
    )
}

/// The walk of the chapter's example through a tree: what is entered, and what is not.
pub fn walk() -> String {
    let mut drawing = Drawing::new(480.0, 310.0);
    let (root, a, b) = (dvec2(240.0, 44.0), dvec2(150.0, 124.0), dvec2(360.0, 124.0));
    let leaves = [60.0, 150.0, 230.0, 320.0, 410.0].map(|x| dvec2(x, 208.0));
    drawing
        .dashed(Hue::Soft, root, a)
        .line(Hue::Blue, root, b)
        .line(Hue::Blue, b, leaves[4])
        .dashed(Hue::Soft, b, leaves[3]);
    for leaf in &leaves[..3] {
        drawing.dashed(Hue::Soft, a, *leaf);
    }
    let circle = |drawing: &mut Drawing, hue: Hue, at: DVec2, name: &str| {
        let half = dvec2(26.0, 16.0);
        drawing
            .card(at - half, at + half)
            .filled_box(hue, at - half, at + half)
            .words(hue, Side::Middle, at + dvec2(0.0, 6.0), name);
    };
    circle(&mut drawing, Hue::Blue, root, "N");
    circle(&mut drawing, Hue::Soft, a, "A");
    circle(&mut drawing, Hue::Blue, b, "B");
    for (leaf, name) in leaves.into_iter().zip(["0, 1", "2, 3", "4", "5–8", "9"]) {
        let hue = if name == "9" { Hue::Green } else { Hue::Soft };
        circle(&mut drawing, hue, leaf, name);
    }
    drawing
        .small(Hue::Blue, Side::Right, dvec2(394.0, 116.0), "entered")
        .small(Hue::Blue, Side::Right, dvec2(394.0, 134.0), "at 6.5")
        .small(Hue::Soft, Side::Left, dvec2(116.0, 116.0), "16.5 > 6.5:")
        .small(Hue::Soft, Side::Left, dvec2(116.0, 134.0), "skipped")
        .words(Hue::Green, Side::Middle, dvec2(410.0, 250.0), "hit at 6.5")
        .small(Hue::Soft, Side::Middle, dvec2(304.0, 250.0), "8.5 or more:")
        .small(Hue::Soft, Side::Middle, dvec2(304.0, 269.0), "skipped")
        .small(
            Hue::Ink,
            Side::Middle,
            dvec2(240.0, 300.0),
            "numbers: which balls; the ray comes from the right",
        );
    drawing.finish(
        "One ball asked out of ten",
        "A tree over ten balls: the root N has the children A, with balls 0 to 4, and B, with balls 5 to \
         9. The ray enters B at 6.5 and A at 16.5, so it goes to B, and there to the part with ball 9, \
         which it hits at 6.5. The other part of B begins at 8.5 or later, and A at 16.5: neither is \
         entered.",
    )
}

/// A leaf that lies: its box is missed, and what it holds lies on the ray.
pub fn trap() -> String {
    let mut drawing = Drawing::new(480.0, 250.0);
    let axis = 180.0;
    let (start, lying, honest) = (dvec2(440.0, axis), dvec2(300.0, axis), dvec2(110.0, axis));
    drawing
        .filled_box(Hue::Orange, dvec2(180.0, 30.0), dvec2(270.0, 90.0))
        .dashed(Hue::Orange, dvec2(262.0, 90.0), lying - dvec2(8.0, 24.0))
        .disc(Hue::Orange, lying, 26.0)
        .filled_box(
            Hue::Green,
            honest - dvec2(26.0, 26.0),
            honest + dvec2(26.0, 26.0),
        )
        .disc(Hue::Green, honest, 26.0)
        .arrow(Hue::Blue, start, honest + dvec2(26.0, 0.0))
        .dot(Hue::Ink, start)
        .cross(Hue::Orange, lying + dvec2(26.0, 0.0))
        .dot(Hue::Green, honest + dvec2(26.0, 0.0));
    drawing
        .words(Hue::Ink, Side::Middle, start + dvec2(0.0, -14.0), "o")
        .words(Hue::Orange, Side::Left, dvec2(172.0, 56.0), "the box of")
        .words(
            Hue::Orange,
            Side::Left,
            dvec2(172.0, 78.0),
            "ball 1: missed",
        )
        .words(
            Hue::Orange,
            Side::Right,
            dvec2(318.0, 134.0),
            "ball 1: not asked",
        )
        .words(
            Hue::Green,
            Side::Middle,
            honest + dvec2(12.0, 54.0),
            "ball 0: the answer",
        );
    drawing.finish(
        "A leaf that lies",
        "A ray runs from right to left. Ball 1 lies on the ray, but the box of its leaf lies elsewhere \
         and is missed by the ray: whoever culls never asks ball 1. Ball 0 lies farther on, in its own \
         box, and is the answer.",
    )
}
