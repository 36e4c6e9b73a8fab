//! Figures of the chapter "Building a BVH".

use glam::{DVec2, dvec2};

use super::drawing::{Drawing, Hue, Side};

/// The number of spheres in the chapter's example. They have radius 1/2 and are at 0, 2, 4, …
const SPHERES: u32 = 10;
const BUCKETS: u32 = 8;

fn center(sphere: u32) -> f64 {
    f64::from(2 * sphere)
}

/// Returns the bucket of a centre. The largest centre would be in bucket 8, so the index is
/// clamped.
fn bucket(center_at: f64) -> u32 {
    let extent = center(SPHERES - 1);
    let index = (center_at / extent * f64::from(BUCKETS)).floor() as u32;
    index.min(BUCKETS - 1)
}

/// Returns the number of spheres to the left of each plane between adjacent buckets.
fn left_of_planes() -> Vec<u32> {
    let left_of = |plane: u32| {
        (0..SPHERES)
            .filter(|sphere| bucket(center(*sphere)) < plane)
            .count()
    };
    (1..BUCKETS).map(|plane| left_of(plane) as u32).collect()
}

/// Returns the surface area of the box around `n` neighbouring spheres, which is 2n − 1 long, 1
/// high and 1 deep.
fn surface_area(n: u32) -> f64 {
    8.0 * f64::from(n) - 2.0
}

/// Returns the cost C of a partition, with C_trav = C_isect = 1.
fn cost(left: u32) -> f64 {
    let right = SPHERES - left;
    let side = |n: u32| surface_area(n) * f64::from(n);
    1.0 + (side(left) + side(right)) / surface_area(SPHERES)
}

/// Draws nested boxes, and the tree that they form.
pub fn tree() -> String {
    let mut drawing = Drawing::new(480.0, 350.0);
    let triangle = |drawing: &mut Drawing, hue: Hue, at: DVec2| {
        let corners = [
            at + dvec2(0.0, -14.0),
            at + dvec2(13.0, 10.0),
            at + dvec2(-13.0, 10.0),
        ];
        drawing.area(hue, &corners).outline(hue, &corners);
    };
    drawing
        .open_box(Hue::Ink, dvec2(20.0, 20.0), dvec2(460.0, 160.0))
        .filled_box(Hue::Blue, dvec2(40.0, 46.0), dvec2(200.0, 146.0))
        .filled_box(Hue::Orange, dvec2(280.0, 40.0), dvec2(440.0, 140.0));
    for at in [dvec2(64.0, 70.0), dvec2(120.0, 112.0), dvec2(176.0, 96.0)] {
        triangle(&mut drawing, Hue::Blue, at);
    }
    for at in [dvec2(304.0, 116.0), dvec2(416.0, 64.0)] {
        triangle(&mut drawing, Hue::Orange, at);
    }
    drawing
        .label(Hue::Ink, Side::Middle, dvec2(240.0, 98.0), "N")
        .label(Hue::Blue, Side::Left, dvec2(194.0, 138.0), "A")
        .label(Hue::Orange, Side::Left, dvec2(434.0, 132.0), "B");
    let (root, a, b) = (
        dvec2(240.0, 200.0),
        dvec2(120.0, 262.0),
        dvec2(360.0, 262.0),
    );
    drawing.line(Hue::Ink, root, a).line(Hue::Ink, root, b);
    for (at, hue, name) in [
        (root, Hue::Ink, "N"),
        (a, Hue::Blue, "A"),
        (b, Hue::Orange, "B"),
    ] {
        let half = dvec2(22.0, 15.0);
        drawing
            .card(at - half, at + half)
            .filled_box(hue, at - half, at + half)
            .label(hue, Side::Middle, at + dvec2(0.0, 6.0), name);
    }
    for cell in 0..5 {
        let hue = if cell < 3 { Hue::Blue } else { Hue::Orange };
        let corner = dvec2(130.0 + 44.0 * f64::from(cell), 296.0);
        drawing.filled_box(hue, corner, corner + dvec2(44.0, 28.0));
        drawing.small_label(
            hue,
            Side::Middle,
            corner + dvec2(22.0, 20.0),
            &cell.to_string(),
        );
    }
    drawing
        .small_label(Hue::Ink, Side::Left, dvec2(120.0, 316.0), "primitives")
        .small_label(Hue::Blue, Side::Left, dvec2(92.0, 250.0), "start 0,")
        .small_label(Hue::Blue, Side::Left, dvec2(92.0, 270.0), "size 3")
        .small_label(Hue::Orange, Side::Right, dvec2(388.0, 250.0), "start 3,")
        .small_label(Hue::Orange, Side::Right, dvec2(388.0, 270.0), "size 2");
    drawing.finish(
        "A bounding volume hierarchy",
        "A box N around everything contains a box A around three triangles and a box B around two. \
         As a tree, N has the children A and B, which are leaves. The list of primitives is \
         divided between them: indices 0 to 2 belong to A, with start 0 and size 3, and indices 3 \
         and 4 to B, with start 3 and size 2.",
    )
}

/// Draws the example's ten spheres in eight buckets, and the cheapest plane.
pub fn buckets() -> String {
    let mut drawing = Drawing::new(480.0, 240.0);
    let point = |x: f64, y: f64| dvec2(33.0 + 23.0 * x, 96.0 + y);
    let width = center(SPHERES - 1) / f64::from(BUCKETS);
    let edge = |bucket: u32| f64::from(bucket) * width;
    drawing
        .filled_box(Hue::Blue, point(-0.5, -11.5), point(8.5, 11.5))
        .filled_box(Hue::Orange, point(9.5, -11.5), point(18.5, 11.5));
    for plane in 0..=BUCKETS {
        let at = edge(plane);
        let ends = (point(at, -62.0), point(at, 58.0));
        if plane == BUCKETS / 2 {
            drawing.line(Hue::Green, ends.0, ends.1);
        } else {
            drawing.dashed(Hue::Soft, ends.0, ends.1);
        }
    }
    for sphere in 0..SPHERES {
        let at = center(sphere);
        drawing
            .disc(Hue::Ink, point(at, 0.0), 11.5)
            .dot(Hue::Ink, point(at, 0.0));
    }
    for number in 0..BUCKETS {
        let count = (0..SPHERES)
            .filter(|sphere| bucket(center(*sphere)) == number)
            .count();
        let middle = edge(number) + width / 2.0;
        drawing
            .small_label(
                Hue::Soft,
                Side::Middle,
                point(middle, -46.0),
                &number.to_string(),
            )
            .label(
                Hue::Ink,
                Side::Middle,
                point(middle, 48.0),
                &count.to_string(),
            );
    }
    drawing
        .small_label(Hue::Soft, Side::Right, point(-0.9, -76.0), "bucket")
        .small_label(Hue::Ink, Side::Right, point(-0.9, 78.0), "centres in it")
        .label(
            Hue::Blue,
            Side::Middle,
            point(4.0, 108.0),
            "A: N_A = 5, S_A = 38",
        )
        .label(
            Hue::Orange,
            Side::Middle,
            point(14.2, 108.0),
            "B: N_B = 5, S_B = 38",
        )
        .small_label(Hue::Green, Side::Middle, point(9.0, -70.0), "this plane")
        .small_label(Hue::Soft, Side::Middle, point(9.0, 132.0), "S_N = 78");
    drawing.finish(
        "Ten spheres in eight buckets",
        "Ten spheres in a row. Their centres range from 0 to 18 and are sorted into eight buckets \
         of equal width, which hold 2, 1, 1, 1, 1, 1, 1 and 2 of them. The plane in the middle has \
         five spheres on either side. The box around five spheres has surface area 38, and the box \
         around all of them 78.",
    )
}

/// Draws the cost of each of the seven planes.
pub fn costs() -> String {
    let mut drawing = Drawing::new(480.0, 300.0);
    let point = |plane: f64, cost: f64| dvec2(40.0 + 54.0 * plane, 250.0 - 82.0 * (cost - 5.4));
    drawing.arrow(Hue::Soft, point(0.4, 5.4), point(7.9, 5.4));
    drawing.arrow(Hue::Soft, point(0.4, 5.4), point(0.4, 8.35));
    let planes: Vec<(f64, u32)> = (1..BUCKETS).map(f64::from).zip(left_of_planes()).collect();
    let curve: Vec<DVec2> = planes
        .iter()
        .map(|(plane, left)| point(*plane, cost(*left)))
        .collect();
    drawing.curve(Hue::Soft, &curve);
    for (plane, left) in planes {
        let (cost, right) = (cost(left), SPHERES - left);
        let hue = if left == right { Hue::Green } else { Hue::Blue };
        let at = point(plane, cost);
        drawing
            .dot(hue, at)
            .small_label(
                hue,
                Side::Middle,
                at + dvec2(0.0, -14.0),
                &format!("{cost:.2}"),
            )
            .small_label(
                Hue::Ink,
                Side::Middle,
                point(plane, 5.4) + dvec2(0.0, 22.0),
                &format!("{left}|{right}"),
            );
    }
    drawing
        .label(Hue::Ink, Side::Right, dvec2(76.0, 26.0), "C")
        .label(
            Hue::Green,
            Side::Middle,
            point(4.0, 5.87) + dvec2(0.0, 26.0),
            "the cheapest",
        )
        .small_label(
            Hue::Ink,
            Side::Middle,
            dvec2(256.0, 294.0),
            "spheres to the left and right of the plane",
        );
    drawing.finish(
        "The costs of the planes",
        "The costs of the seven partitions of ten spheres. With 2 spheres left of the plane and 8 \
         right of it the cost is 7.72, with 3 and 7 it is 6.69, with 4 and 6 it is 6.08, and with \
         5 and 5 it is 5.87, the cheapest. The other three are symmetric to these.",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_match_the_chapter() {
        let costs = left_of_planes().into_iter().map(cost);
        let costs: Vec<String> = costs.map(|cost| format!("{cost:.2}")).collect();
        assert_eq!(
            costs,
            ["7.72", "6.69", "6.08", "5.87", "6.08", "6.69", "7.72"]
        );
    }
}
