//! Figures of the chapter "Ray-sphere intersection".

use glam::{DVec2, dvec2};

use super::drawing::{Drawing, Hue, Side};

/// Draws a ray from outside a sphere, a ray from inside, and a ray that misses, with the roots that
/// count.
pub fn roots() -> String {
    let mut drawing = Drawing::new(480.0, 330.0);
    let (center, radius) = (dvec2(270.0, 180.0), 110.0);
    drawing
        .disc(Hue::Ink, center, radius)
        .dot(Hue::Soft, center);
    let half = |height: f64| dvec2((radius * radius - height * height).sqrt(), 0.0);

    // A ray from outside: the near root is ahead of the origin, and counts.
    let (up, start) = (dvec2(0.0, -55.0), dvec2(30.0, 125.0));
    let (near, far) = (center + up - half(55.0), center + up + half(55.0));
    drawing
        .line(Hue::Blue, start, near)
        .dashed(Hue::Blue, near, far)
        .arrow(Hue::Blue, far, far + dvec2(75.0, 0.0))
        .dot(Hue::Ink, start)
        .dot(Hue::Blue, near)
        .ring(Hue::Blue, far)
        .label(
            Hue::Blue,
            Side::Left,
            near + dvec2(-10.0, -10.0),
            "near: counts",
        )
        .label(Hue::Blue, Side::Right, far + dvec2(12.0, -10.0), "far");

    // A ray from inside: the near root is behind the origin, so the far one counts.
    let (down, inside) = (dvec2(0.0, 45.0), dvec2(250.0, 225.0));
    let (near, far) = (center + down - half(45.0), center + down + half(45.0));
    drawing
        .dashed(Hue::Orange, near, inside)
        .arrow(Hue::Orange, inside, far)
        .dot(Hue::Ink, inside)
        .ring(Hue::Orange, near)
        .dot(Hue::Orange, far)
        .label(
            Hue::Orange,
            Side::Left,
            near + dvec2(-12.0, 6.0),
            "near: t < 0",
        )
        .label(
            Hue::Orange,
            Side::Right,
            far + dvec2(12.0, 6.0),
            "far: counts",
        );

    // A ray that misses the sphere: there is no root.
    let past = dvec2(30.0, 40.0);
    drawing
        .arrow(Hue::Green, past, dvec2(450.0, 40.0))
        .dot(Hue::Ink, past)
        .label(
            Hue::Green,
            Side::Left,
            dvec2(450.0, 28.0),
            "none: discriminant < 0",
        );
    drawing.finish(
        "The roots of three rays",
        "Three rays and a sphere. One starts outside and intersects the sphere twice: the near \
         intersection counts. One starts inside: its near root is behind it, where t is negative, \
         so the far one counts. One misses the sphere and has no root.",
    )
}

/// Draws the geometry of the two roots: the closest approach, and half a chord to either side.
pub fn chord() -> String {
    let mut drawing = Drawing::new(480.0, 290.0);
    let (center, radius) = (dvec2(300.0, 140.0), 105.0);
    let (start, closest) = (dvec2(40.0, 210.0), dvec2(300.0, 210.0));
    let half = dvec2((radius * radius - 70.0 * 70.0_f64).sqrt(), 0.0);
    let (near, far) = (closest - half, closest + half);
    drawing
        .disc(Hue::Ink, center, radius)
        .area(Hue::Blue, &[center, closest, near])
        .line(Hue::Blue, center, closest)
        .line(Hue::Blue, center, near)
        .dashed(Hue::Soft, start, center)
        .arrow(Hue::Ink, start, far + dvec2(70.0, 0.0))
        .outline(Hue::Soft, &right_angle_mark(closest))
        .dot(Hue::Ink, start)
        .dot(Hue::Ink, center)
        .dot(Hue::Blue, near)
        .dot(Hue::Blue, far)
        .measure(start + dvec2(0.0, 44.0), closest + dvec2(0.0, 44.0))
        .measure(near + dvec2(0.0, 22.0), closest + dvec2(0.0, 22.0));
    drawing
        .label(Hue::Ink, Side::Left, start + dvec2(6.0, -14.0), "o")
        .label(Hue::Ink, Side::Right, center + dvec2(8.0, -8.0), "centre")
        .label(
            Hue::Blue,
            Side::Left,
            center.midpoint(near) + dvec2(-8.0, -2.0),
            "r",
        )
        .small_label(Hue::Ink, Side::Middle, dvec2(150.0, 276.0), "−(o · d)")
        .small_label(
            Hue::Ink,
            Side::Right,
            closest + dvec2(8.0, 28.0),
            "√discriminant / 2",
        )
        .label(Hue::Ink, Side::Left, near + dvec2(-8.0, -8.0), "near")
        .label(Hue::Ink, Side::Right, far + dvec2(8.0, -8.0), "far")
        .small_label(
            Hue::Blue,
            Side::Right,
            closest + dvec2(8.0, -30.0),
            "closest approach",
        );
    drawing.finish(
        "Half a chord to either side of the closest approach",
        "A ray from o passes the sphere's centre at some distance. Its closest approach is at \
         minus the dot product of o and d along the ray. The near root is half a chord before it, \
         and the far root half a chord behind it. Half of the chord, the distance of the closest \
         approach and the radius form a right triangle.",
    )
}

/// Returns the mark of a right angle at `corner`, to its upper left.
fn right_angle_mark(corner: DVec2) -> [DVec2; 4] {
    let side = 12.0;
    [
        corner,
        corner - dvec2(side, 0.0),
        corner - dvec2(side, side),
        corner - dvec2(0.0, side),
    ]
}
