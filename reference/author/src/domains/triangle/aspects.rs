//! The aspects of calls to `Triangle::hit`.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use glam::{DVec3, Vec2};

use super::plane::{Plane, corner_normals, longest_side_and_altitude, vertices};
use crate::domains::Aspect;
use crate::domains::fields::{DIAGONALS, class_below, diagonal_class};
use crate::domains::shape::{DISTANCE, HISTORY, NUMBER, ORIGIN, ShapeCall};
use crate::oracle::scan;

/// The aspects of triangles.
pub(super) const SUBJECT_ASPECTS: &[Aspect<ShapeCall>] = &[
    Aspect::SIZE,
    Aspect::ROUND,
    Aspect::PLACE,
    Aspect::OCTANT,
    NUMBER,
    // The triangle's plane.
    Aspect::new(
        "plane",
        &["across x", "across y", "across z", "any"],
        |call| {
            Some((FACING.class)(call).map_or(3, |facing| if facing < 6 { facing % 3 } else { 3 }))
        },
    ),
    FACING,
    // The diagonal along which the triangle faces.
    Aspect::new("facing along a diagonal", DIAGONALS, |call| {
        let [p0, p1, p2] = scan::corners(&call.shape)?;
        diagonal_class((p1 - p0).cross(p2 - p0).as_vec3())
    }),
    // The proportions of the triangle.
    Aspect::new(
        "form",
        &[
            "wide",
            "narrow at p0",
            "narrow at p1",
            "narrow at p2",
            "flat at p0",
            "flat at p1",
            "flat at p2",
        ],
        |call| {
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
    ),
    // Triangles with almost no area.
    Aspect::new(
        "altitude",
        &[
            "below 0.6% of the longest side",
            "an edge below 1% of the longest side",
        ],
        |call| {
            let corners @ [p0, p1, p2] = scan::corners(&call.shape)?;
            let (longest, altitude) = longest_side_and_altitude(corners);
            let shortest = p0.distance(p1).min(p1.distance(p2)).min(p2.distance(p0));
            match altitude / longest {
                _ if shortest < 0.01 * longest => Some(1),
                ..0.006 => Some(0),
                _ => None,
            }
        },
    ),
    // The corner whose angle is a right angle or close to one. Most triangles have none.
    Aspect::new(
        "angles",
        &[
            "almost right at p0",
            "almost right at p1",
            "almost right at p2",
            "usual",
        ],
        |call| {
            let right = almost_right_corner(scan::corners(&call.shape)?);
            Some(right.unwrap_or(3))
        },
    ),
    // Triangles with one angle that is close to 90°, but not equal to it. The texture coordinates
    // at this corner differ so much from those at the other corners that the deviation from 90°
    // matters.
    Aspect::new(
        "almost right and far",
        &["at p0", "at p1", "at p2"],
        |call| {
            /// The minimum difference between texture coordinates.
            const LEAST: f32 = 5.0;
            let vertices = vertices(&call.shape)?;
            let corners = scan::corners(&call.shape)?;
            let corner = almost_right_corner(corners)?;
            let others = [(corner + 1) % 3, (corner + 2) % 3];
            let [side, other] = others.map(|it| (corners[it] - corners[corner]).normalize());
            let is_exact = side.dot(other).abs() < 0.4 * ALMOST_RIGHT;
            let far = others.map(|it| vertices[it].uv.distance(vertices[corner].uv) > LEAST);
            (!is_exact && far == [true, true]).then_some(corner)
        },
    ),
    // The edges of the triangle.
    Aspect::new(
        "edges",
        &[
            "one along x",
            "one along y",
            "one along z",
            "none along an axis",
        ],
        |call| {
            let corners = scan::corners(&call.shape)?;
            let is_along = |axis: usize, from: usize| {
                let edge = corners[(from + 1) % 3] - corners[from];
                (0..3).all(|other| other == axis || edge[other] == 0.0)
            };
            let axis = (0..3).find(|&axis| (0..3).any(|from| is_along(axis, from)));
            Some(axis.unwrap_or(3))
        },
    ),
    // The corner with a right angle between two edges along axes.
    Aspect::new(
        "two edges along axes",
        &["at p0", "at p1", "at p2"],
        |call| {
            let corners = scan::corners(&call.shape)?;
            (0..3).find(|&corner| {
                let edge = |other: usize| corners[(corner + other) % 3] - corners[corner];
                let is_along =
                    |edge: DVec3| edge.to_array().iter().filter(|it| **it != 0.0).count();
                is_along(edge(1)) == 1 && is_along(edge(2)) == 1
            })
        },
    ),
    // The texture coordinates of the corners.
    Aspect::new(
        "uv of the corners",
        &[
            "in [0, 1]",
            "beyond",
            "all equal",
            "with the same v",
            "almost equal",
            "beyond 4 tiles",
        ],
        |call| {
            let vertices = vertices(&call.shape)?;
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
    ),
    // The two corners with the same texture coordinates.
    Aspect::new("same uv", EQUAL, |call| {
        let vertices = vertices(&call.shape)?;
        equal_two(vertices.map(|vertex| vertex.uv))
    }),
    // The side of the triangle that the corners' normals point to.
    Aspect::new(
        "normals of the corners",
        &["to the front", "to the back"],
        |call| {
            let vertices = vertices(&call.shape)?;
            let [p0, p1, p2] = scan::corners(&call.shape)?;
            let front = (p1 - p0).cross(p2 - p0);
            Some(usize::from(vertices[0].normal.as_dvec3().dot(front) < 0.0))
        },
    ),
    // The two corners with the same normal.
    Aspect::new("same normal", EQUAL, |call| {
        equal_two(corner_normals(&call.shape)?)
    }),
    // The largest angle between the normals of two corners.
    Aspect::new(
        "spread of the normals",
        &["none", "to 3°", "to 45°", "to 90°", "beyond"],
        |call| {
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
    ),
];

/// The aspects of rays and of the points where they cross the triangle's plane.
pub(super) const RAY_ASPECTS: &[Aspect<ShapeCall>] = &[
    // The start of the ray relative to the triangle. A triangle's size is half of the longest side
    // of its box.
    Aspect::new(
        "start",
        &[
            "in front, up to 3 sizes away",
            "in front, up to 30 sizes away",
            "behind, up to 3 sizes away",
            "behind, up to 30 sizes away",
            "on the surface",
            "points away",
            "just in front or behind",
        ],
        |call| {
            let Plane {
                distance,
                slope,
                size,
                ..
            } = Plane::of(call)?;
            let sizes = distance / size;
            let side = if slope < 0.0 { 0 } else { 2 };
            Some(match sizes {
                ..-0.01 => 5,
                ..0.01 => 4,
                ..NEAR => 6,
                ..3.0 => side,
                _ => side + 1,
            })
        },
    ),
    ORIGIN,
    DISTANCE,
    // The cosine of the angle between the ray and the triangle's normal.
    Aspect::new(
        "cosine",
        &["below 0.01", "0.01 to 0.1", "0.1 to 0.5", "0.5 to 1", "1"],
        |call| {
            Some(class_below(
                &[0.01, 0.1, 0.5, 0.999_999],
                Plane::of(call)?.slope.abs(),
            ))
        },
    ),
    // The point where the ray's line crosses the plane.
    Aspect::new(
        "crossing",
        &[
            "inside",
            "just inside an edge",
            "just outside an edge",
            "outside",
            "far outside",
            "outside two edges",
        ],
        |call| {
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
    ),
    // The corner with the smallest weight.
    Aspect::new("least weight", &["p0", "p1", "p2"], |call| {
        let plane = Plane::of(call)?;
        (0..3).min_by(|&a, &b| plane.weights[a].total_cmp(&plane.weights[b]))
    }),
    // Weights that are small but still matter for the texture coordinates of a hit.
    Aspect::new("small weights", &["below a thousandth"], |call| {
        /// The minimum difference that matters.
        const LEAST: f64 = 3e-3;
        let vertices = vertices(&call.shape)?;
        let (plane, hit) = (Plane::of(call)?, call.hit()?);
        let mut corners = plane.weights.into_iter().zip(vertices);
        let shows = corners.any(|(weight, vertex)| {
            let difference = vertex.uv.as_dvec2().distance(hit.uv);
            weight < SMALL_WEIGHT && weight * difference > LEAST
        });
        shows.then_some(0)
    }),
    // The corner that a hit is close to.
    Aspect::new("close to a corner", &["p0", "p1", "p2"], |call| {
        /// The minimum weight of a corner that is close.
        const LEAST: f64 = 0.88;
        call.distance()?;
        let mut weights = Plane::of(call)?.weights.into_iter();
        weights.position(|weight| weight > LEAST)
    }),
    // The edge that a ray narrowly misses, named after the opposite corner.
    Aspect::new(
        "narrowly outside",
        &["opposite p0", "opposite p1", "opposite p2"],
        |call| {
            let plane = Plane::of(call)?;
            let mut weights = plane.weights.into_iter();
            let is_ahead = plane.ray64.is_in_range(plane.distance);
            let corner = weights.position(|weight| (-NARROW_MISS..0.0).contains(&weight))?;
            is_ahead.then_some(corner)
        },
    ),
    // The length of the interpolated normal before it is normalized.
    Aspect::new(
        "interpolated normal",
        &["shorter than 0.35", "to 0.6", "to 0.9", "longer"],
        |call| {
            Some(class_below(
                &[0.35, 0.6, 0.9],
                Plane::of(call)?.normal_length,
            ))
        },
    ),
    Aspect::DIRECTION,
    Aspect::DIAGONAL,
    // The axis that the ray is parallel to, in either direction. Triangles perpendicular to an axis
    // are rarely seen from both sides.
    Aspect::new("axis", &["along x", "along y", "along z", "any"], |call| {
        let direction = (Aspect::DIRECTION.class)(call)?;
        Some(if direction < 6 { direction % 3 } else { 3 })
    }),
    Aspect::RANGE,
    // The ends of the range relative to the point where the ray crosses the plane.
    Aspect::new(
        "end of the range",
        &[
            "just before or behind the plane",
            "just before or behind a distant plane",
            "anywhere",
        ],
        |call| {
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
    ),
    HISTORY,
];

/// The direction that the triangle faces.
const FACING: Aspect<ShapeCall> = Aspect::new(
    "facing",
    &[
        "+x",
        "+y",
        "+z",
        "-x",
        "-y",
        "-z",
        "almost along an axis",
        "any",
    ],
    |call| {
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
);

/// The largest narrow angle, in radians.
const NARROW: f64 = 0.045;

/// Returns the corner whose angle is a right angle or close to one.
pub(super) fn almost_right_corner(corners: [DVec3; 3]) -> Option<usize> {
    let cosine = |corner: usize| {
        let side = |other: usize| (corners[(corner + other) % 3] - corners[corner]).normalize();
        side(1).dot(side(2))
    };
    (0..3).find(|&corner| cosine(corner).abs() < ALMOST_RIGHT)
}

/// An angle counts as almost a right angle if the absolute value of its cosine is less than this.
pub(super) const ALMOST_RIGHT: f64 = 3e-3;

/// The largest difference between texture coordinates that count as almost equal.
pub(super) const TEXEL: f64 = 0.025;

/// The largest texture coordinate.
pub(super) const FAR_UV: f64 = 9.0;

/// Returns the largest difference between the texture coordinates of two corners.
pub(super) fn uv_extent(uvs: [Vec2; 3]) -> f64 {
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

/// The maximum distance between the plane and a point near it, as a multiple of the triangle's
/// size.
pub(super) const NEAR: f64 = 0.05;

/// The weight below which a point inside the triangle counts as just inside an edge.
pub(super) const EDGE: f64 = 0.02;

/// A ray narrowly misses an edge if it passes by within this distance, as a fraction of the
/// altitude.
pub(super) const NARROW_MISS: f64 = 7e-4;

/// Weights below this limit count as small.
pub(super) const SMALL_WEIGHT: f64 = 1e-3;

/// An end of the range is near the plane if it is within this distance, as a multiple of the
/// triangle's size.
pub(super) const END: f64 = 0.02;

/// A plane counts as distant from this distance on, as a multiple of the triangle's size.
const DISTANT: f64 = 20.0;
