//! The domain of `Triangle::hit`.

mod draw;
mod plane;

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use glam::{DVec3, Vec2};
use protocol::Shape;

use self::plane::corner_normals;
use super::fields::{DIAGONALS, diagonal_class};
use super::shape::{
    self, DISTANCE, HARDLY_MOVED, HARDLY_TURNED, HISTORY, MIRRORED_START, NUMBER, ORIGIN, ShapeCall,
};
use super::{Aspect, FunctionDomain, not_asked};
use crate::oracle::scan;

pub use draw::tables;
pub use plane::Plane;

/// The domain of `Triangle::hit`.
pub static TRIANGLE: FunctionDomain<ShapeCall> = FunctionDomain {
    pairs: &[
        ["size", "axis"],
        ["size", "start"],
        ["size", "crossing"],
        ["size", "cosine"],
        ["cosine", "crossing"],
    ],
    fields: &[],
    calls: shape::calls,
    function: "Triangle::hit",
    subject_aspects: &[
        Aspect::SIZE,
        Aspect::ROUND,
        Aspect::PLACE,
        Aspect::OCTANT,
        NUMBER,
        PLANE,
        FACING,
        FACING_DIAGONAL,
        FORM,
        FLAT,
        ANGLES,
        RIGHT_AND_FAR,
        EDGE_ALONG,
        LEGS,
        TILES,
        EQUAL_UVS,
        NORMALS,
        EQUAL_NORMALS,
        SPREAD,
    ],
    aspects: &[
        START,
        ORIGIN,
        DISTANCE,
        COSINE,
        CROSSING,
        LEAST_WEIGHT,
        SMALL_WEIGHTS,
        NEAREST_CORNER,
        NARROWLY_OUTSIDE,
        NORMAL_LENGTH,
        Aspect::DIRECTION,
        Aspect::DIAGONAL,
        AXIS,
        Aspect::RANGE,
        ENDS,
        HISTORY,
    ],
    not_asked: &[
        not_asked(
            &["call before"],
            &[HARDLY_TURNED, HARDLY_MOVED],
            &["`None`", "normal", "origin", "shape", "uv"],
            "A change this small has a noticeable effect only on the distance and the position.",
        ),
        not_asked(&["distance"], &[], &["`None`"], "A miss has no distance."),
        not_asked(
            &["start"],
            &["points away"],
            &[],
            "A ray that points away from the triangle hits nothing.",
        ),
        not_asked(
            &["start"],
            &["on the surface"],
            &[],
            "A ray in this class starts on the triangle. Its start is a hit only if its range \
             begins there, but no range in an exam begins or ends so close to the triangle. So the \
             ray hits nothing.",
        ),
        not_asked(
            &["crossing"],
            &[
                "just outside an edge",
                "outside",
                "far outside",
                "outside two edges",
            ],
            &[],
            "A ray that passes outside the triangle hits nothing.",
        ),
        not_asked(
            &["crossing"],
            &["just inside an edge"],
            &[
                "`None`", "distance", "normal", "origin", "position", "shape",
            ],
            "Only the items `triangle.outside` and `triangle.uv_corners` test rays close to an \
             edge, so that a mistake at the edges costs few points. Of the quantities, only the \
             texture coordinates are judged, because they show errors in small weights.",
        ),
        not_asked(
            &["call before"],
            &[
                "the same ray with its axes in another order",
                MIRRORED_START,
            ],
            &["normal", "origin", "position", "shape", "uv"],
            "A ray like this hits only shapes near the origin, so it is enough if an exam tests \
             the distance to the hit.",
        ),
        not_asked(
            &["call before"],
            &["the opposite direction"],
            &["normal", "position", "uv"],
            "The items about these quantities test rays from the front, and one of two opposite \
             rays comes from behind.",
        ),
        not_asked(
            &["almost right and far"],
            &[],
            &[
                "`None`", "some", "distance", "normal", "origin", "position", "shape",
            ],
            "Where an angle is almost right, the error shows in texture coordinates that differ \
             widely.",
        ),
        not_asked(
            &["small weights"],
            &[],
            &[
                "`None`", "some", "distance", "normal", "origin", "position", "shape",
            ],
            "A weight below a thousandth has a noticeable effect only on the texture coordinates.",
        ),
        not_asked(
            &["interpolated normal"],
            &[],
            &[
                "`None`", "some", "distance", "origin", "position", "shape", "uv",
            ],
            "Only the normal depends on it.",
        ),
        not_asked(
            &["close to a corner"],
            &[],
            &["`None`"],
            "The rays in this class hit the triangle.",
        ),
        not_asked(
            &["narrowly outside"],
            &[],
            &[
                "some", "distance", "normal", "origin", "position", "shape", "uv",
            ],
            "A ray that passes outside the triangle hits nothing.",
        ),
        not_asked(
            &["form"],
            &[
                "narrow at p0",
                "narrow at p1",
                "narrow at p2",
                "flat at p0",
                "flat at p1",
                "flat at p2",
            ],
            &["normal", "uv", "origin", "position", "shape"],
            "For narrow and flat triangles, the usual formulas are not accurate enough in single \
             precision: the errors of the weights exceed the tolerances. So the items that judge \
             normals or texture coordinates contain no such triangles. The other quantities do not \
             depend on the weights.",
        ),
        not_asked(
            &["altitude"],
            &[],
            &["normal", "uv", "origin", "position", "shape"],
            "Triangles this flat are rarely tested, for the same reason as other flat triangles.",
        ),
        not_asked(
            &["cosine"],
            &["below 0.01"],
            &["normal", "uv"],
            "At a cosine this small, the usual formulas seldom compute the weights accurately \
             enough in single precision. So it is enough if an exam tests the other quantities.",
        ),
        not_asked(
            &["cosine"],
            &["below 0.01"],
            &["pairs"],
            "At a cosine this small, almost all rays cross the plane far outside the triangle.",
        ),
        not_asked(
            &["place"],
            &["1,000 sizes away"],
            &["normal", "uv"],
            "At this distance from the origin, rounding the corners' coordinates changes the \
             weights by more than the tolerances for normals and texture coordinates allow.",
        ),
        not_asked(
            &["distance"],
            &["2000", "3000"],
            &["normal", "origin", "position", "shape", "uv"],
            "Only the largest triangles are hit from so far away, so it is enough if an exam tests \
             the distance to the hit.",
        ),
    ],
};

/// The triangle's plane.
const PLANE: Aspect<ShapeCall> = Aspect {
    name: "plane",
    classes: &["across x", "across y", "across z", "any"],
    class: |call| {
        Some((FACING.class)(call).map_or(3, |facing| if facing < 6 { facing % 3 } else { 3 }))
    },
};

/// The direction that the triangle faces.
const FACING: Aspect<ShapeCall> = Aspect {
    name: "facing",
    classes: &[
        "+x",
        "+y",
        "+z",
        "-x",
        "-y",
        "-z",
        "almost along an axis",
        "any",
    ],
    class: |call| {
        let [p0, p1, p2] = scan::corners(&call.shape)?;
        let normal = (p1 - p0).cross(p2 - p0).normalize();
        let axes: Vec<usize> = (0..3).filter(|&axis| normal[axis] != 0.0).collect();
        Some(match axes[..] {
            [axis] if normal[axis] > 0.0 => axis,
            [axis] => 3 + axis,
            _ if normal.abs().max_element() > 0.9999 => 6,
            _ => 7,
        })
    },
};

/// The diagonal along which the triangle faces.
const FACING_DIAGONAL: Aspect<ShapeCall> = Aspect {
    name: "facing along a diagonal",
    classes: DIAGONALS,
    class: |call| {
        let [p0, p1, p2] = scan::corners(&call.shape)?;
        diagonal_class((p1 - p0).cross(p2 - p0).as_vec3())
    },
};

/// The proportions of the triangle.
const FORM: Aspect<ShapeCall> = Aspect {
    name: "form",
    classes: &[
        "wide",
        "narrow at p0",
        "narrow at p1",
        "narrow at p2",
        "flat at p0",
        "flat at p1",
        "flat at p2",
    ],
    class: |call| {
        let corners = scan::corners(&call.shape)?;
        let angle = |corner: usize| {
            let side = |other: usize| corners[(corner + other) % 3] - corners[corner];
            side(1).angle_between(side(2))
        };
        let narrow = (0..3).find(|&corner| angle(corner) < NARROW);
        let flat = (0..3).find(|&corner| angle(corner) > PI - 2.0 * NARROW);
        Some(match (flat, narrow) {
            (Some(corner), _) => 4 + corner,
            (None, Some(corner)) => 1 + corner,
            (None, None) => 0,
        })
    },
};

/// Triangles with almost no area.
const FLAT: Aspect<ShapeCall> = Aspect {
    name: "altitude",
    classes: &[
        "below 0.6% of the longest side",
        "an edge below 1% of the longest side",
    ],
    class: |call| {
        let [p0, p1, p2] = scan::corners(&call.shape)?;
        let longest = p0.distance(p1).max(p1.distance(p2)).max(p2.distance(p0));
        let altitude = (p1 - p0).cross(p2 - p0).length() / longest;
        let shortest = p0.distance(p1).min(p1.distance(p2)).min(p2.distance(p0));
        match altitude / longest {
            _ if shortest < 0.01 * longest => Some(1),
            ..0.006 => Some(0),
            _ => None,
        }
    },
};

/// The largest narrow angle, in radians.
const NARROW: f64 = 0.045;

/// The corner whose angle is a right angle or close to one. Most triangles have none.
const ANGLES: Aspect<ShapeCall> = Aspect {
    name: "angles",
    classes: &[
        "almost right at p0",
        "almost right at p1",
        "almost right at p2",
        "usual",
    ],
    class: |call| {
        let right = almost_right_corner(scan::corners(&call.shape)?);
        Some(right.unwrap_or(3))
    },
};

/// Returns the corner whose angle is a right angle or close to one.
fn almost_right_corner(corners: [DVec3; 3]) -> Option<usize> {
    let cosine = |corner: usize| {
        let side = |other: usize| (corners[(corner + other) % 3] - corners[corner]).normalize();
        side(1).dot(side(2))
    };
    (0..3).find(|&corner| cosine(corner).abs() < ALMOST_RIGHT)
}

/// Triangles with one angle that is close to 90°, but not equal to it. The texture coordinates at
/// this corner differ so much from those at the other corners that the deviation from 90° matters.
const RIGHT_AND_FAR: Aspect<ShapeCall> = Aspect {
    name: "almost right and far",
    classes: &["at p0", "at p1", "at p2"],
    class: |call| {
        /// The minimum difference between texture coordinates.
        const LEAST: f32 = 5.0;
        let Shape::Triangle { vertices, .. } = call.shape else {
            return None;
        };
        let corners = scan::corners(&call.shape)?;
        let corner = almost_right_corner(corners)?;
        let others = [(corner + 1) % 3, (corner + 2) % 3];
        let [side, other] = others.map(|it| (corners[it] - corners[corner]).normalize());
        let is_exact = side.dot(other).abs() < 0.4 * ALMOST_RIGHT;
        let far = others.map(|it| vertices[it].uv.distance(vertices[corner].uv) > LEAST);
        (!is_exact && far == [true, true]).then_some(corner)
    },
};

/// An angle counts as almost a right angle if the absolute value of its cosine is less than this.
const ALMOST_RIGHT: f64 = 3e-3;

/// The edges of the triangle.
const EDGE_ALONG: Aspect<ShapeCall> = Aspect {
    name: "edges",
    classes: &[
        "one along x",
        "one along y",
        "one along z",
        "none along an axis",
    ],
    class: |call| {
        let corners = scan::corners(&call.shape)?;
        let is_along = |axis: usize, from: usize| {
            let edge = corners[(from + 1) % 3] - corners[from];
            (0..3).all(|other| other == axis || edge[other] == 0.0)
        };
        let axis = (0..3).find(|&axis| (0..3).any(|from| is_along(axis, from)));
        Some(axis.unwrap_or(3))
    },
};

/// The corner with a right angle between two edges along axes.
const LEGS: Aspect<ShapeCall> = Aspect {
    name: "two edges along axes",
    classes: &["at p0", "at p1", "at p2"],
    class: |call| {
        let corners = scan::corners(&call.shape)?;
        (0..3).find(|&corner| {
            let edge = |other: usize| corners[(corner + other) % 3] - corners[corner];
            let is_along = |edge: DVec3| edge.to_array().iter().filter(|it| **it != 0.0).count();
            is_along(edge(1)) == 1 && is_along(edge(2)) == 1
        })
    },
};

/// The texture coordinates of the corners.
const TILES: Aspect<ShapeCall> = Aspect {
    name: "uv of the corners",
    classes: &[
        "in [0, 1]",
        "beyond",
        "all equal",
        "with the same v",
        "almost equal",
        "beyond 4 tiles",
    ],
    class: |call| {
        let Shape::Triangle { vertices, .. } = call.shape else {
            return None;
        };
        let unit = 0.0..=1.0;
        let uvs = vertices.map(|vertex| vertex.uv);
        let is_inside = |uv: &Vec2| uv.to_array().iter().all(|it| unit.contains(it));
        let (same_u, same_v) = (all_equal(uvs.map(|uv| uv.x)), all_equal(uvs.map(|uv| uv.y)));
        let largest = uvs.map(|uv| uv.abs().max_element());
        Some(match (same_u, same_v) {
            (true, true) => 2,
            (false, true) => 3,
            _ if uv_extent(uvs) < TEXEL => 4,
            _ if largest.into_iter().any(|it| it > 4.5) => 5,
            _ => usize::from(!uvs.iter().all(is_inside)),
        })
    },
};

/// The largest difference between texture coordinates that count as almost equal.
const TEXEL: f64 = 0.025;

/// The largest texture coordinate.
const FAR_UV: f64 = 9.0;

/// Returns the largest difference between the texture coordinates of two corners.
fn uv_extent(uvs: [Vec2; 3]) -> f64 {
    let extent = |from: usize| (uvs[from] - uvs[(from + 1) % 3]).abs().max_element();
    (0..3).map(extent).fold(0.0, f32::max).into()
}

fn all_equal(values: [f32; 3]) -> bool {
    values.iter().all(|value| *value == values[0])
}

/// Returns the index in [`EQUAL`] of the two equal values, if the third value differs.
fn equal_two<T: PartialEq>([a, b, c]: [T; 3]) -> Option<usize> {
    match (a == b, b == c, c == a) {
        (true, false, _) => Some(0),
        (_, true, false) => Some(1),
        (false, _, true) => Some(2),
        _ => None,
    }
}

/// The names of the classes. Each names the two corners with the same value.
const EQUAL: &[&str] = &["at p0 and p1", "at p1 and p2", "at p2 and p0"];

/// The two corners with the same texture coordinates.
const EQUAL_UVS: Aspect<ShapeCall> = Aspect {
    name: "same uv",
    classes: EQUAL,
    class: |call| {
        let Shape::Triangle { vertices, .. } = call.shape else {
            return None;
        };
        equal_two(vertices.map(|vertex| vertex.uv))
    },
};

/// The two corners with the same normal.
const EQUAL_NORMALS: Aspect<ShapeCall> = Aspect {
    name: "same normal",
    classes: EQUAL,
    class: |call| equal_two(corner_normals(&call.shape)?),
};

/// The side of the triangle that the corners' normals point to.
const NORMALS: Aspect<ShapeCall> = Aspect {
    name: "normals of the corners",
    classes: &["to the front", "to the back"],
    class: |call| {
        let Shape::Triangle { vertices, .. } = call.shape else {
            return None;
        };
        let [p0, p1, p2] = scan::corners(&call.shape)?;
        let front = (p1 - p0).cross(p2 - p0);
        Some(usize::from(vertices[0].normal.as_dvec3().dot(front) < 0.0))
    },
};

/// The largest angle between the normals of two corners.
const SPREAD: Aspect<ShapeCall> = Aspect {
    name: "spread of the normals",
    classes: &["none", "to 3°", "to 45°", "to 90°", "beyond"],
    class: |call| {
        let normals = corner_normals(&call.shape)?;
        let cosine = |from: usize| normals[from].dot(normals[(from + 1) % 3]);
        let least = (0..3).map(cosine).fold(f64::INFINITY, f64::min);
        Some(match least {
            _ if normals[0] == normals[1] && normals[1] == normals[2] => 0,
            0.9986.. => 1,
            FRAC_1_SQRT_2.. => 2,
            0.0.. => 3,
            _ => 4,
        })
    },
};

/// The start of the ray relative to the triangle. A triangle's size is half of the longest side of
/// its box.
const START: Aspect<ShapeCall> = Aspect {
    name: "start",
    classes: &[
        "in front, up to 3 sizes away",
        "in front, up to 30 sizes away",
        "behind, up to 3 sizes away",
        "behind, up to 30 sizes away",
        "on the surface",
        "points away",
        "just in front or behind",
    ],
    class: |call| {
        let Plane {
            distance, slope, ..
        } = Plane::of(call)?;
        let sizes = distance / call.size();
        let side = if slope < 0.0 { 0 } else { 2 };
        Some(match sizes {
            ..-0.01 => 5,
            ..0.01 => 4,
            ..NEAR => 6,
            ..3.0 => side,
            _ => side + 1,
        })
    },
};

/// The maximum distance between the plane and a point near it, as a multiple of the triangle's
/// size.
const NEAR: f64 = 0.05;

/// The cosine of the angle between the ray and the triangle's normal.
const COSINE: Aspect<ShapeCall> = Aspect {
    name: "cosine",
    classes: &["below 0.01", "0.01 to 0.1", "0.1 to 0.5", "0.5 to 1", "1"],
    class: |call| {
        Some(match Plane::of(call)?.slope.abs() {
            ..0.01 => 0,
            ..0.1 => 1,
            ..0.5 => 2,
            ..0.999_999 => 3,
            _ => 4,
        })
    },
};

/// The point where the ray's line crosses the plane.
const CROSSING: Aspect<ShapeCall> = Aspect {
    name: "crossing",
    classes: &[
        "inside",
        "just inside an edge",
        "just outside an edge",
        "outside",
        "far outside",
        "outside two edges",
    ],
    class: |call| {
        let plane = Plane::of(call)?;
        let negative = plane.weights.iter().filter(|weight| **weight < 0.0);
        Some(match plane.least_weight() {
            _ if negative.count() > 1 => 5,
            EDGE.. => 0,
            0.0.. => 1,
            -0.02.. => 2,
            -1.0.. => 3,
            _ => 4,
        })
    },
};

/// The weight below which a point inside the triangle counts as just inside an edge.
const EDGE: f64 = 0.02;

/// Weights that are small but still matter for the texture coordinates of a hit.
const SMALL_WEIGHTS: Aspect<ShapeCall> = Aspect {
    name: "small weights",
    classes: &["below a thousandth"],
    class: |call| {
        /// The minimum difference that matters.
        const LEAST: f64 = 3e-3;
        let Shape::Triangle { vertices, .. } = call.shape else {
            return None;
        };
        let (plane, hit) = (Plane::of(call)?, call.hit()?);
        let mut corners = plane.weights.into_iter().zip(vertices);
        let shows = corners.any(|(weight, vertex)| {
            let difference = vertex.uv.as_dvec2().distance(hit.uv);
            weight < SMALL_WEIGHT && weight * difference > LEAST
        });
        shows.then_some(0)
    },
};

/// The corner that a hit is close to.
const NEAREST_CORNER: Aspect<ShapeCall> = Aspect {
    name: "close to a corner",
    classes: &["p0", "p1", "p2"],
    class: |call| {
        /// The minimum weight of a corner that is close.
        const LEAST: f64 = 0.88;
        call.hit()?;
        let mut weights = Plane::of(call)?.weights.into_iter();
        weights.position(|weight| weight > LEAST)
    },
};

/// The edge that a ray narrowly misses, named after the opposite corner.
const NARROWLY_OUTSIDE: Aspect<ShapeCall> = Aspect {
    name: "narrowly outside",
    classes: &["opposite p0", "opposite p1", "opposite p2"],
    class: |call| {
        let plane = Plane::of(call)?;
        let mut weights = plane.weights.into_iter();
        let is_ahead = plane.ray64.is_in_range(plane.distance);
        let corner = weights.position(|weight| (-NARROW_MISS..0.0).contains(&weight))?;
        is_ahead.then_some(corner)
    },
};

/// The length of the interpolated normal before it is normalized.
const NORMAL_LENGTH: Aspect<ShapeCall> = Aspect {
    name: "interpolated normal",
    classes: &["shorter than 0.35", "to 0.6", "to 0.9", "longer"],
    class: |call| {
        Some(match Plane::of(call)?.normal_length {
            ..0.35 => 0,
            ..0.6 => 1,
            ..0.9 => 2,
            _ => 3,
        })
    },
};

/// The largest distance from an edge at which a ray counts as narrowly missing it, as a fraction of
/// the altitude.
const NARROW_MISS: f64 = 7e-4;

/// Weights below this limit count as small.
const SMALL_WEIGHT: f64 = 1e-3;

/// The ends of the range relative to the point where the ray crosses the plane.
const ENDS: Aspect<ShapeCall> = Aspect {
    name: "end of the range",
    classes: &[
        "just before or behind the plane",
        "just before or behind a distant plane",
        "anywhere",
    ],
    class: |call| {
        let plane = Plane::of(call)?;
        let ends = [plane.ray64.min, plane.ray64.max];
        let is_near = ends
            .iter()
            .any(|end| (end - plane.distance).abs() < END * plane.size);
        Some(match is_near {
            true if plane.distance > DISTANT * plane.size => 1,
            true => 0,
            false => 2,
        })
    },
};

/// The maximum distance from the plane at which an end of the range counts as near it, as a
/// multiple of the triangle's size.
const END: f64 = 0.02;

/// The minimum distance at which a plane counts as distant, as a multiple of the triangle's size.
const DISTANT: f64 = 20.0;

/// The corner with the smallest weight.
const LEAST_WEIGHT: Aspect<ShapeCall> = Aspect {
    name: "least weight",
    classes: &["p0", "p1", "p2"],
    class: |call| {
        let plane = Plane::of(call)?;
        (0..3).min_by(|&a, &b| plane.weights[a].total_cmp(&plane.weights[b]))
    },
};

/// The axis that the ray is parallel to, in either direction. Triangles perpendicular to an axis
/// are rarely seen from both sides.
const AXIS: Aspect<ShapeCall> = Aspect {
    name: "axis",
    classes: &["along x", "along y", "along z", "any"],
    class: |call| {
        let direction = (Aspect::DIRECTION.class)(call)?;
        Some(if direction < 6 { direction % 3 } else { 3 })
    },
};
