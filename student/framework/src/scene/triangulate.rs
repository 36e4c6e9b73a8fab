//! Splits polygons and the faces of meshes into triangles.

use std::collections::VecDeque;

use glam::DVec3;

/// Returns the cross products of the triangles in a fan around the first corner. By Newell's
/// method, their sum has the direction of the outline's normal, and the sum's length is twice the
/// area.
pub(super) fn fan(corners: &[DVec3]) -> impl Iterator<Item = DVec3> {
    let from_first = corners[1..].iter().map(|corner| corner - corners[0]);
    let next = from_first.clone().skip(1);
    from_first.zip(next).map(|(a, b)| a.cross(b))
}

/// Splits a face with any outline into triangles, by ear clipping in the plane that fits it best. A
/// convex face becomes a fan around its first corner. Returns `None` if the outline crosses itself.
pub(super) fn triangulate(corners: &[DVec3]) -> Option<Vec<[usize; 3]>> {
    let count = corners.len();
    let cross = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(|i| corners[i]);
        (b - a).cross(c - a)
    };
    let sum: DVec3 = fan(corners).sum();
    let area: f64 = fan(corners).map(DVec3::length).sum();
    if area > 0.0 && sum.length() <= 1e-9 * area {
        return None;
    }
    let normal = sum.normalize_or_zero();
    // 1 if the corners are counter-clockwise, -1 if they are clockwise, and 0 if they are on a
    // line.
    let turn = |triangle: [usize; 3]| match cross(triangle).dot(normal) {
        twice_area if twice_area.abs() <= 1e-12 * area => 0,
        twice_area if twice_area > 0.0 => 1,
        _ => -1,
    };
    let after = |i: usize| (i + 1) % count;
    let turns_back = |&i: &usize| turn([i, after(i), after(after(i))]) < 0;
    let reflex: Vec<usize> = (0..count).filter(turns_back).map(after).collect();
    let around_first: Vec<[usize; 3]> = (2..count).map(|i| [0, i - 1, i]).collect();
    // All corners of a star such as a pentagram turn the same way, but the triangles of its fan
    // don't.
    if reflex.is_empty() && around_first.iter().all(|triangle| turn(*triangle) >= 0) {
        return Some(around_first);
    }
    let separates = |a, b, c, d| turn([a, b, c]) * turn([a, b, d]) < 0;
    let cross_each_other = |i: usize, j: usize| {
        let [a, b, c, d] = [i, after(i), j, after(j)];
        separates(a, b, c, d) && separates(c, d, a, b)
    };
    if (0..count).any(|i| (0..i).any(|j| cross_each_other(i, j))) {
        return None;
    }

    let is_inside = |[a, b, c]: [usize; 3], i: usize| {
        let is_corner = [a, b, c].iter().any(|&j| corners[j] == corners[i]);
        !is_corner
            && [[a, b, i], [b, c, i], [c, a, i]]
                .map(turn)
                .iter()
                .all(|turn| *turn >= 0)
    };
    let is_ear = |triangle| match turn(triangle) {
        0 => true,
        1 => !reflex.iter().any(|&i| is_inside(triangle, i)),
        _ => false,
    };
    let mut rest: VecDeque<usize> = (0..count).collect();
    let mut triangles = Vec::new();
    while rest.len() > 2 {
        let length = rest.len();
        let triangle = |i: usize| [i - 1, i, i + 1].map(|i| rest[i % length]);
        let ear = (1..=length).find(|i| is_ear(triangle(*i)))?;
        triangles.push(triangle(ear));
        rest.remove(ear % length);
    }
    Some(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the signed areas of the triangles that an outline is split into. The outline lies in
    /// a slanted plane.
    fn areas(outline: &[[f64; 2]]) -> Option<Vec<f64>> {
        let corners: Vec<DVec3> = outline
            .iter()
            .map(|[x, y]| DVec3::new(*x, *y, x + y))
            .collect();
        let normal = DVec3::new(-1.0, -1.0, 1.0);
        let area = |triangle: [usize; 3]| {
            let [a, b, c] = triangle.map(|i| corners[i]);
            (b - a).cross(c - a).dot(normal) / 6.0
        };
        Some(triangulate(&corners)?.into_iter().map(area).collect())
    }

    fn sum(outline: &[[f64; 2]]) -> f64 {
        let areas = areas(outline).expect("the outline does not cross itself");
        areas.iter().map(|area| area.abs()).sum()
    }

    #[test]
    fn a_convex_face_becomes_a_fan() {
        let square = [DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y];
        assert_eq!(triangulate(&square), Some(vec![[0, 1, 2], [0, 2, 3]]));
    }

    #[test]
    fn the_triangles_of_a_concave_face_cover_its_area() {
        let arrow = [[0.0, 0.0], [4.0, 4.0], [2.0, 1.0], [4.0, 0.0]];
        // The outer square is joined to the square hole by an edge that is used twice.
        let hole = [
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 3.0],
            [0.0, 3.0],
            [0.0, 0.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [2.0, 2.0],
            [2.0, 1.0],
            [1.0, 1.0],
        ];
        for (outline, area) in [(&arrow[..], 4.0), (&hole[..], 8.0)] {
            let reversed: Vec<[f64; 2]> = outline.iter().rev().copied().collect();
            assert!((sum(outline) - area).abs() < 1e-9, "{outline:?}");
            assert!((sum(&reversed) - area).abs() < 1e-9, "{outline:?}");
        }
    }

    #[test]
    fn repeated_corners_and_faces_without_area_are_no_errors() {
        assert_eq!(
            sum(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 2.0], [0.0, 0.0]]),
            1.0
        );
        assert_eq!(sum(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0]]), 0.0);
        assert_eq!(sum(&[[1.0, 1.0]; 4]), 0.0);
    }

    #[test]
    fn an_outline_that_crosses_itself_is_an_error() {
        let bow_tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        let uneven = [[0.0, 0.0], [3.0, 3.0], [3.0, 0.0], [0.0, 1.0]];
        let touching = [
            [0.0, 0.0],
            [4.0, 0.0],
            [1.0, 1.0],
            [0.0, 2.0],
            [2.0, 2.0],
            [1.0, 1.0],
        ];
        let pentagram = [
            [0.0, 1.0],
            [-0.588, -0.809],
            [0.951, 0.309],
            [-0.951, 0.309],
            [0.588, -0.809],
        ];
        for outline in [&bow_tie[..], &uneven, &touching, &pentagram] {
            assert_eq!(areas(outline), None, "{outline:?}");
        }
    }

    #[test]
    fn stars_are_covered_once() {
        for count in 3..40 {
            let corner = |i: usize| {
                let distance = 1.0 + (i * i * 7919 % 97) as f64;
                let (sin, cos) = (i as f64 * std::f64::consts::TAU / count as f64).sin_cos();
                [distance * cos, distance * sin]
            };
            let outline: Vec<[f64; 2]> = (0..count).map(corner).collect();
            let pairs = outline.iter().zip(outline.iter().cycle().skip(1));
            let area: f64 = pairs.map(|([x, y], [z, w])| (x * w - y * z) / 2.0).sum();
            let areas = areas(&outline).expect("a star does not cross itself");
            assert_eq!(areas.len(), count - 2);
            assert!(areas.iter().all(|area| *area > -1e-6), "{areas:?}");
            assert!((areas.iter().sum::<f64>() - area).abs() < 1e-6, "{areas:?}");
        }
    }
}
