//! Figures of the chapter "Traversing a BVH".

use glam::{DVec2, dvec2};

use super::drawing::{Drawing, Hue, Side};

/// The height of the ray in these figures.
const RAY: f64 = 120.0;

/// Returns the point on the ray at time `t`.
fn on_ray(t: f64) -> DVec2 {
    dvec2(30.0 + 42.0 * t, RAY)
}

/// Draws a box around a part of the ray, from `up` above the ray to `down` below it.
fn node(drawing: &mut Drawing, hue: Hue, from: f64, to: f64, up: f64, down: f64) {
    let (a, b) = (on_ray(from) - dvec2(0.0, up), on_ray(to) + dvec2(0.0, down));
    drawing.filled_box(hue, a, b);
}

fn ray(drawing: &mut Drawing, hit: f64) {
    drawing
        .dashed(Hue::Soft, on_ray(hit), on_ray(10.6))
        .line(Hue::Blue, on_ray(0.0), on_ray(hit))
        .dot(Hue::Ink, on_ray(0.0))
        .label(Hue::Ink, Side::Middle, on_ray(0.0) + dvec2(0.0, -14.0), "o");
}

/// Draws a surface across the ray.
fn surface(drawing: &mut Drawing, hue: Hue, t: f64, lean: f64) {
    let half = dvec2(lean, 34.0);
    drawing.line(hue, on_ray(t) - half, on_ray(t) + half);
}

fn mark(drawing: &mut Drawing, hue: Hue, side: Side, t: f64, text: &str) {
    let foot = on_ray(t) + dvec2(0.0, 104.0);
    drawing
        .dashed(hue, on_ray(t), foot)
        .small_label(hue, side, foot + dvec2(0.0, 18.0), text);
}

/// Draws the case in which the second box is not entered, because it begins beyond the hit in the
/// first.
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
        .label(Hue::Ink, Side::Right, on_ray(1.4) + dvec2(4.0, -102.0), "N")
        .label(
            Hue::Blue,
            Side::Right,
            on_ray(2.0) + dvec2(8.0, -50.0),
            "A: first",
        )
        .label(
            Hue::Orange,
            Side::Right,
            on_ray(7.0) + dvec2(8.0, -38.0),
            "B: skipped",
        );
    drawing.finish(
        "A box that begins beyond the hit",
        "A ray enters box A at 2 and has a hit in it at 5. It would enter box B at 7, which is \
         beyond 5, so B is not entered.",
    )
}

/// Draws the case in which the second box begins before the hit in the first, and contains a closer
/// hit.
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
    mark(&mut drawing, Hue::Orange, Side::Right, 5.0, "5: closer");
    mark(&mut drawing, Hue::Blue, Side::Middle, 8.0, "8: a hit");
    drawing
        .label(
            Hue::Blue,
            Side::Right,
            on_ray(2.0) + dvec2(8.0, -62.0),
            "A: first",
        )
        .label(
            Hue::Orange,
            Side::Left,
            on_ray(9.8) + dvec2(-8.0, 76.0),
            "B: second",
        );
    drawing.finish(
        "A box that begins before the hit",
        "The boxes overlap. A ray enters box A at 2 and has a hit near the far end of A, at 8. It \
         enters box B at 4, before 8, so B must also be searched: its hit at 5 is closer.",
    )
}

/// Draws the traversal of the chapter's example: the nodes that are entered and those that are not.
pub fn example() -> String {
    let mut drawing = Drawing::new(480.0, 375.0);
    // The distance at which the ray, which starts at x = 25, enters the box whose last sphere is
    // `last`.
    let entry = |last: u32| 25.0 - (f64::from(2 * last) + 0.5);
    let hit = entry(9);
    let root = dvec2(150.0, 36.0);
    let mut parent = root;
    for (level, (skipped, last, entered)) in (1..).zip([
        ("A: 0–4", 4, "B: 5–9"),
        ("5, 6", 6, "7–9"),
        ("7", 7, "8, 9"),
        ("8", 8, "9"),
    ]) {
        let height = 36.0 + 72.0 * f64::from(level);
        let below = dvec2(0.0, 16.0);
        let (left, right) = (
            dvec2(parent.x - 62.0, height),
            dvec2(parent.x + 62.0, height),
        );
        drawing
            .dashed(Hue::Soft, parent + below, left)
            .line(Hue::Blue, parent + below, right)
            .small_label(
                Hue::Soft,
                Side::Middle,
                left + dvec2(0.0, 32.0),
                &entry(last).to_string(),
            );
        labelled_box(&mut drawing, Hue::Soft, left, skipped);
        let hue = if entered == "9" {
            Hue::Green
        } else {
            Hue::Blue
        };
        labelled_box(&mut drawing, hue, right, entered);
        parent = right;
    }
    labelled_box(&mut drawing, Hue::Blue, root, "N");
    drawing
        .label(
            Hue::Green,
            Side::Middle,
            parent + dvec2(0.0, 34.0),
            &format!("hit at {hit}"),
        )
        .small_label(
            Hue::Blue,
            Side::Right,
            dvec2(255.0, 42.0),
            &format!("blue, solid: entered at {hit}"),
        )
        .small_label(
            Hue::Soft,
            Side::Right,
            dvec2(20.0, 322.0),
            "grey, dotted: beyond",
        )
        .small_label(
            Hue::Soft,
            Side::Right,
            dvec2(20.0, 342.0),
            &format!("{hit}, so skipped"),
        );
    drawing.finish(
        "One of ten spheres is tested",
        "A tree over ten spheres, and a ray from the right. The root N has the children A, with \
         spheres 0 to 4, entered at 16.5, and B, with spheres 5 to 9, entered at 6.5. The \
         traversal enters B, then the node with spheres 7 to 9, then the one with 8 and 9, and \
         then sphere 9, which the ray hits at 6.5. The other children on the way contain sphere 8, \
         sphere 7, spheres 5 and 6, and A. They begin at 8.5, 10.5, 12.5 and 16.5, beyond the hit, \
         so all of them are skipped.",
    )
}

/// Draws a node of a tree as a box with a label.
fn labelled_box(drawing: &mut Drawing, hue: Hue, at: DVec2, name: &str) {
    let half = dvec2(32.0, 16.0);
    drawing
        .card(at - half, at + half)
        .filled_box(hue, at - half, at + half)
        .label(hue, Side::Middle, at + dvec2(0.0, 6.0), name);
}

/// Draws a decoy: the ray misses the box of its leaf, but would hit the sphere itself.
pub fn decoy() -> String {
    let mut drawing = Drawing::new(480.0, 250.0);
    let axis = 180.0;
    let (start, decoy, answer) = (dvec2(440.0, axis), dvec2(300.0, axis), dvec2(110.0, axis));
    drawing
        .filled_box(Hue::Orange, dvec2(180.0, 30.0), dvec2(270.0, 90.0))
        .dashed(Hue::Orange, dvec2(262.0, 90.0), decoy - dvec2(8.0, 24.0))
        .disc(Hue::Orange, decoy, 26.0)
        .filled_box(
            Hue::Green,
            answer - dvec2(26.0, 26.0),
            answer + dvec2(26.0, 26.0),
        )
        .disc(Hue::Green, answer, 26.0)
        .arrow(Hue::Blue, start, answer + dvec2(26.0, 0.0))
        .dot(Hue::Ink, start)
        .cross(Hue::Orange, decoy + dvec2(26.0, 0.0))
        .dot(Hue::Green, answer + dvec2(26.0, 0.0));
    drawing
        .label(Hue::Ink, Side::Middle, start + dvec2(0.0, -14.0), "o")
        .label(Hue::Orange, Side::Left, dvec2(172.0, 56.0), "the box of")
        .label(
            Hue::Orange,
            Side::Left,
            dvec2(172.0, 78.0),
            "sphere 1: missed",
        )
        .label(
            Hue::Orange,
            Side::Right,
            dvec2(318.0, 134.0),
            "sphere 1: not tested",
        )
        .label(
            Hue::Green,
            Side::Middle,
            answer + dvec2(12.0, 54.0),
            "sphere 0: the answer",
        );
    drawing.finish(
        "A decoy",
        "A ray goes from right to left. Sphere 1 is on the ray, but the box of its leaf is \
         somewhere else, and the ray misses that box. A correct traversal therefore never tests \
         sphere 1. Sphere 0 is farther along the ray, in its own box, and is the answer.",
    )
}
