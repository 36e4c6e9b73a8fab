//! Figures of the chapter "Camera rays".

use glam::{DVec2, dvec2};

use super::drawing::{Drawing, Hue, Side, corners};

/// Draws the camera, the sensor in front of it, and one ray.
pub fn sensor() -> String {
    let mut drawing = Drawing::new(480.0, 300.0);
    let eye = dvec2(80.0, 150.0);
    // Parallel projection: −z goes to the right and a little up, x toward the reader.
    let point = |x: f64, y: f64, z: f64| eye + dvec2(-215.0 * z - 70.0 * x, 42.0 * x - 85.0 * y);
    let (near, far) = (point(-1.0, -1.0, -1.0), point(1.0, 1.0, -1.0));
    let sensor = [near, point(1.0, -1.0, -1.0), far, point(-1.0, 1.0, -1.0)];
    let target = point(-0.45, 0.5, -1.0);
    drawing
        .area(Hue::Blue, &sensor)
        .outline(Hue::Ink, &sensor)
        .dashed(Hue::Soft, eye, point(0.0, 0.0, -1.0))
        .dot(Hue::Soft, point(0.0, 0.0, -1.0))
        .arrow(Hue::Ink, eye, point(0.0, 0.75, 0.0))
        .label(Hue::Ink, Side::Middle, point(0.0, 0.82, 0.0), "y")
        .arrow(Hue::Ink, eye, point(0.7, 0.0, 0.0))
        .label(Hue::Ink, Side::Left, point(0.78, -0.1, 0.0), "x")
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
        .small_label(Hue::Soft, Side::Middle, point(0.0, -0.13, -0.45), "−z")
        .label(Hue::Ink, Side::Right, dvec2(375.0, 210.0), "the sensor,")
        .label(Hue::Ink, Side::Right, dvec2(375.0, 232.0), "z = −1");
    drawing.finish(
        "The camera and its sensor",
        "The camera is at the origin, with y up and x to the side. The sensor is a rectangle one \
         unit ahead along minus z, centred on the axis. A ray from the camera passes through the \
         point (px, py) of the sensor.",
    )
}

/// Draws the triangle from which the sensor's height follows.
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
        "A right triangle. One side, of length 1, goes from the camera straight ahead to the \
         centre of the sensor. The second goes from there up to the sensor's upper edge, and is \
         half the sensor's height. The third is the highest ray. The angle alpha at the camera is \
         half of the vertical field of view.",
    )
}

/// Draws the film, one of its pixels, and the offset in that pixel.
pub fn pixels() -> String {
    let mut drawing = Drawing::new(480.0, 300.0);
    let (origin, cell) = (dvec2(40.0, 236.0), 48.0);
    let point = |x: f64, y: f64| origin + cell * dvec2(x, -y);
    drawing.filled_box(Hue::Blue, point(4.0, 2.0), point(5.0, 3.0));
    for x in 0..=8 {
        drawing.line(Hue::Soft, point(x.into(), 0.0), point(x.into(), 4.0));
    }
    for y in 0..=4 {
        drawing.line(Hue::Soft, point(0.0, y.into()), point(8.0, y.into()));
    }
    drawing
        .open_box(Hue::Ink, point(0.0, 0.0), point(8.0, 4.0))
        .open_box(Hue::Blue, point(4.0, 2.0), point(5.0, 3.0))
        .dot(Hue::Blue, point(4.5, 2.5))
        .dashed(Hue::Blue, point(4.5, 2.5), point(4.5, 0.0))
        .dashed(Hue::Blue, point(4.5, 2.5), point(0.0, 2.5));
    drawing
        .small_label(Hue::Ink, Side::Left, point(0.0, -0.5), "0")
        .small_label(Hue::Ink, Side::Middle, point(8.0, -0.5), "8")
        .small_label(Hue::Ink, Side::Left, point(-0.15, 3.9), "4")
        .label(Hue::Blue, Side::Middle, point(4.5, -0.5), "4.5")
        .label(Hue::Blue, Side::Left, point(-0.1, 2.4), "2.5")
        .label(Hue::Blue, Side::Right, point(5.15, 3.33), "pixel (4, 2),")
        .label(Hue::Blue, Side::Right, point(5.15, 2.36), "offset (½, ½)")
        .small_label(Hue::Ink, Side::Right, point(0.2, 0.4), "pixel (0, 0)")
        .label(Hue::Ink, Side::Right, point(1.0, -1.1), "across: 4.5 / 8")
        .label(Hue::Ink, Side::Right, point(5.0, -1.1), "up: 2.5 / 4");
    drawing.finish(
        "Pixels and offsets",
        "A film of 8 by 4 pixels, with pixel (0, 0) at the bottom left. In pixel (4, 2) the offset \
         (1/2, 1/2) is the centre: 4.5 of 8 pixels across and 2.5 of 4 up.",
    )
}

/// Returns the points of the shorter arc of a circle between the directions `from` and `to`.
pub(super) fn arc(center: DVec2, radius: f64, from: DVec2, to: DVec2) -> Vec<DVec2> {
    let (from, to) = (from.normalize(), to.normalize());
    // Interpolates along the chord and projects onto the circle, so no angles are needed.
    (0..=24)
        .map(|step| center + radius * from.lerp(to, f64::from(step) / 24.0).normalize())
        .collect()
}
