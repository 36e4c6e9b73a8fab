//! Figures of "Camera rays".

use glam::{DVec2, dvec2};

use super::drawing::{Drawing, Hue, Side, corners};

/// The camera, the sensor before it, and one ray.
pub fn sensor() -> String {
    let mut drawing = Drawing::new(480.0, 300.0);
    let eye = dvec2(80.0, 150.0);
    // Parallel projection: −z goes to the right and a little up, x toward the reader.
    let place = |x: f64, y: f64, z: f64| eye + dvec2(-215.0 * z - 70.0 * x, 42.0 * x - 85.0 * y);
    let (near, far) = (place(-1.0, -1.0, -1.0), place(1.0, 1.0, -1.0));
    let sensor = [near, place(1.0, -1.0, -1.0), far, place(-1.0, 1.0, -1.0)];
    let target = place(-0.45, 0.5, -1.0);
    drawing
        .area(Hue::Blue, &sensor)
        .outline(Hue::Ink, &sensor)
        .dashed(Hue::Soft, eye, place(0.0, 0.0, -1.0))
        .dot(Hue::Soft, place(0.0, 0.0, -1.0))
        .arrow(Hue::Ink, eye, place(0.0, 0.75, 0.0))
        .label(Hue::Ink, Side::Middle, place(0.0, 0.82, 0.0), "y")
        .arrow(Hue::Ink, eye, place(0.7, 0.0, 0.0))
        .label(Hue::Ink, Side::Left, place(0.78, -0.1, 0.0), "x")
        .arrow(Hue::Blue, eye, eye + 1.55 * (target - eye))
        .dot(Hue::Blue, target)
        .dot(Hue::Ink, eye);
    drawing
        .label(
            Hue::Blue,
            Side::Right,
            target + dvec2(6.0, 22.0),
            "(p_x, p_y)",
        )
        .small_label(
            Hue::Ink,
            Side::Right,
            dvec2(12.0, 222.0),
            "the camera, at (0, 0, 0)",
        )
        .small_label(Hue::Soft, Side::Middle, place(0.0, -0.13, -0.45), "−z")
        .label(Hue::Ink, Side::Right, dvec2(375.0, 210.0), "the sensor,")
        .label(Hue::Ink, Side::Right, dvec2(375.0, 232.0), "z = −1");
    drawing.finish(
        "The camera and its sensor",
        "The camera stands at the origin with y up and x to the side. One unit ahead along minus z \
         hangs the sensor, a rectangle around the axis. A ray from the camera passes through the \
         point (px, py) of the sensor and goes on.",
    )
}

/// The triangle that gives the sensor's height.
pub fn side() -> String {
    let mut drawing = Drawing::new(480.0, 270.0);
    let eye = dvec2(50.0, 135.0);
    let middle = dvec2(330.0, 135.0);
    let half = dvec2(0.0, 90.0);
    let (top, bottom) = (middle - half, middle + half);
    drawing
        .area(Hue::Blue, &[eye, middle, top])
        .line(Hue::Ink, top, bottom)
        .line(Hue::Blue, eye, top)
        .line(Hue::Blue, eye, middle)
        .dashed(Hue::Soft, eye, bottom)
        .outline(Hue::Soft, &corners(middle + dvec2(-13.0, -13.0), middle))
        .curve(Hue::Blue, &arc(eye, 62.0, dvec2(1.0, 0.0), top - eye))
        .dot(Hue::Ink, eye)
        .measure(top + dvec2(24.0, 0.0), middle + dvec2(24.0, 0.0))
        .measure(eye + dvec2(0.0, 112.0), middle + dvec2(0.0, 112.0));
    drawing
        .label(Hue::Blue, Side::Right, dvec2(120.0, 128.0), "α")
        .label(Hue::Ink, Side::Right, dvec2(362.0, 96.0), "height / 2")
        .label(Hue::Ink, Side::Right, dvec2(344.0, 222.0), "the sensor")
        .label(Hue::Ink, Side::Middle, dvec2(190.0, 238.0), "1")
        .label(Hue::Blue, Side::Left, dvec2(205.0, 58.0), "the highest ray")
        .small_label(
            Hue::Ink,
            Side::Right,
            dvec2(16.0, 28.0),
            "α = vertical__fov / 2",
        );
    drawing.finish(
        "The camera from the side",
        "A right triangle: from the camera straight ahead to the sensor's middle, length 1; from \
         there up to the sensor's upper edge, half of its height; and the highest ray back to the \
         camera, where the angle alpha is half of the vertical field of view.",
    )
}

/// The film, one pixel of it, and the offset in the pixel.
pub fn pixels() -> String {
    let mut drawing = Drawing::new(480.0, 300.0);
    let (origin, cell) = (dvec2(40.0, 236.0), 48.0);
    let place = |x: f64, y: f64| origin + cell * dvec2(x, -y);
    drawing.filled_box(Hue::Blue, place(4.0, 2.0), place(5.0, 3.0));
    for x in 0..=8 {
        drawing.line(Hue::Soft, place(x.into(), 0.0), place(x.into(), 4.0));
    }
    for y in 0..=4 {
        drawing.line(Hue::Soft, place(0.0, y.into()), place(8.0, y.into()));
    }
    drawing
        .open_box(Hue::Ink, place(0.0, 0.0), place(8.0, 4.0))
        .open_box(Hue::Blue, place(4.0, 2.0), place(5.0, 3.0))
        .dot(Hue::Blue, place(4.5, 2.5))
        .dashed(Hue::Blue, place(4.5, 2.5), place(4.5, 0.0))
        .dashed(Hue::Blue, place(4.5, 2.5), place(0.0, 2.5));
    drawing
        .small_label(Hue::Ink, Side::Left, place(0.0, -0.5), "0")
        .small_label(Hue::Ink, Side::Middle, place(8.0, -0.5), "8")
        .small_label(Hue::Ink, Side::Left, place(-0.15, 3.9), "4")
        .label(Hue::Blue, Side::Middle, place(4.5, -0.5), "4.5")
        .label(Hue::Blue, Side::Left, place(-0.1, 2.4), "2.5")
        .label(Hue::Blue, Side::Right, place(5.15, 3.33), "pixel (4, 2),")
        .label(Hue::Blue, Side::Right, place(5.15, 2.36), "offset (½, ½)")
        .small_label(Hue::Ink, Side::Right, place(0.2, 0.4), "pixel (0, 0)")
        .label(Hue::Ink, Side::Right, place(1.0, -1.1), "across: 4.5 / 8")
        .label(Hue::Ink, Side::Right, place(5.0, -1.1), "up: 2.5 / 4");
    drawing.finish(
        "Pixels and offsets",
        "A film of 8 by 4 pixels, pixel (0, 0) at the bottom left. In pixel (4, 2) the offset \
         (1/2, 1/2) is the middle: 4.5 of 8 pixels across and 2.5 of 4 up.",
    )
}

/// A part of a circle from the direction `from` to the direction `to`, by the shorter way.
pub(super) fn arc(center: DVec2, radius: f64, from: DVec2, to: DVec2) -> Vec<DVec2> {
    let (from, to) = (from.normalize(), to.normalize());
    // On the chord between the directions, and back onto the circle: no angles are needed.
    (0..=24)
        .map(|step| center + radius * from.lerp(to, f64::from(step) / 24.0).normalize())
        .collect()
}
