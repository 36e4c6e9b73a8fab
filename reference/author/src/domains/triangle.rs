//! The domain of `Triangle::hit`.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use glam::{BVec2, BVec3, DVec2, DVec3, Vec2, Vec3};
use protocol::{Ray, Shape, Vertex};

use super::fields::{self, FURTHEST, FURTHEST_SIZES};
use super::shape::{
    self, DIRECTION, DISTANCE, HISTORY, NUMBER, OCTANT, PLACE, RANGE, SIZE, ShapeCall,
};
use super::{Aspect, FunctionDomain, Generator, not_asked};
use crate::oracle::bbox::Bounds;
use crate::oracle::{Ray64, scan, triangle};
use crate::seed::Rng;

/// The domain of `Triangle::hit`.
pub static TRIANGLE: FunctionDomain<ShapeCall> = FunctionDomain {
    pairs: &[["size", "axis"], ["size", "start"]],
    calls: shape::calls,
    function: "Triangle::hit",
    subject_aspects: &[
        SIZE, PLACE, OCTANT, NUMBER, PLANE, FACING, FORM, ANGLES, EDGE_ALONG, TILES, NORMALS,
        SPREAD,
    ],
    aspects: &[
        START,
        DISTANCE,
        COSINE,
        CROSSING,
        LEAST_WEIGHT,
        DIRECTION,
        AXIS,
        RANGE,
        HISTORY,
    ],
    not_asked: &[
        not_asked("distance", &[], &["`None`"], "A miss has no distance."),
        not_asked(
            "start",
            &["leads away"],
            &[],
            "A ray that leads away from the triangle hits nothing.",
        ),
        not_asked(
            "start",
            &["on the surface"],
            &[],
            "The start itself is in the range only if the range begins there, and ends of ranges keep a margin. So such a ray hits nothing.",
        ),
        not_asked(
            "crossing",
            &["just outside an edge", "outside", "far outside"],
            &[],
            "Outside the triangle, nothing is hit.",
        ),
        not_asked(
            "crossing",
            &["just inside an edge"],
            &[
                "`None`", "distance", "normal", "origin", "position", "shape",
            ],
            "Only `triangle.outside` and `triangle.uv_corners` ask rays close to an edge, so that a mistake there costs few points. The small weights show in the texture coordinates.",
        ),
        not_asked(
            "form",
            &[
                "narrow at p0",
                "narrow at p1",
                "narrow at p2",
                "flat at p0",
                "flat at p1",
                "flat at p2",
            ],
            &["normal", "uv", "origin", "position", "shape"],
            "In a narrow or flat triangle, the weights of a usual formula in single precision are wrong by more than the tolerances allow, so an item that judges normals or texture coordinates has none. The other quantities do not depend on the weights.",
        ),
        not_asked(
            "cosine",
            &["below 0.01"],
            &["normal", "uv"],
            "At so small a cosine, the weights of a usual formula in single precision are seldom exact enough, so an exam may ask only the other quantities.",
        ),
        not_asked(
            "place",
            &["1,000 sizes away"],
            &["normal", "uv"],
            "So far from the origin, rounding the corners changes the weights by more than the tolerances of normals and texture coordinates allow.",
        ),
        not_asked(
            "distance",
            &["2000"],
            &["normal", "origin", "position", "shape", "uv"],
            "Only the largest triangles are hit so far away, so an exam may ask it for the distance alone.",
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

/// The direction in which the triangle faces.
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

/// The form of the triangle.
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

/// The angles of the triangle, almost all of which are usual.
const ANGLES: Aspect<ShapeCall> = Aspect {
    name: "angles",
    classes: &[
        "almost right at p0",
        "almost right at p1",
        "almost right at p2",
        "usual",
    ],
    class: |call| {
        let corners = scan::corners(&call.shape)?;
        let cosine = |corner: usize| {
            let side = |other: usize| (corners[(corner + other) % 3] - corners[corner]).normalize();
            side(1).dot(side(2))
        };
        let right = (0..3).find(|&corner| cosine(corner).abs() < ALMOST_RIGHT);
        Some(right.unwrap_or(3))
    },
};

/// The largest cosine of an angle that is almost right.
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

/// The largest angle that counts as narrow, in radians.
const NARROW: f64 = 0.045;

/// The texture coordinates of the corners.
const TILES: Aspect<ShapeCall> = Aspect {
    name: "uv of the corners",
    classes: &["in [0, 1]", "beyond", "all equal", "with the same v"],
    class: |call| {
        let Shape::Triangle { vertices, .. } = call.shape else {
            return None;
        };
        let unit = 0.0..=1.0;
        let uvs = vertices.map(|vertex| vertex.uv);
        let is_inside = |uv: &Vec2| uv.to_array().iter().all(|it| unit.contains(it));
        let (same_u, same_v) = (all_equal(uvs.map(|uv| uv.x)), all_equal(uvs.map(|uv| uv.y)));
        Some(match (same_u, same_v) {
            (true, true) => 2,
            (false, true) => 3,
            _ => usize::from(!uvs.iter().all(is_inside)),
        })
    },
};

fn all_equal(values: [f32; 3]) -> bool {
    values.iter().all(|value| *value == values[0])
}

/// The side to which the normals of the corners point.
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

/// The axis that the ray is parallel to. A triangle across an axis is seldom seen from both sides.
const AXIS: Aspect<ShapeCall> = Aspect {
    name: "axis",
    classes: &["along x", "along y", "along z", "any"],
    class: |call| {
        let direction = (DIRECTION.class)(call)?;
        Some(if direction < 6 { direction % 3 } else { 3 })
    },
};

/// The largest angle between the normals of two corners.
const SPREAD: Aspect<ShapeCall> = Aspect {
    name: "spread of the normals",
    classes: &["none", "to 45°", "to 90°", "beyond"],
    class: |call| {
        let normals = corner_normals(&call.shape)?;
        let cosine = |from: usize| normals[from].dot(normals[(from + 1) % 3]);
        let least = (0..3).map(cosine).fold(f64::INFINITY, f64::min);
        Some(match least {
            _ if normals[0] == normals[1] && normals[1] == normals[2] => 0,
            FRAC_1_SQRT_2.. => 1,
            0.0.. => 2,
            _ => 3,
        })
    },
};

fn corner_normals(shape: &Shape) -> Option<[DVec3; 3]> {
    let Shape::Triangle { vertices, .. } = shape else {
        return None;
    };
    Some(vertices.map(|vertex| vertex.normal.as_dvec3()))
}

/// The start of the ray, seen from the triangle. Its size is half of its box's longest side.
const START: Aspect<ShapeCall> = Aspect {
    name: "start",
    classes: &[
        "in front, up to 3 sizes away",
        "in front, up to 30 sizes away",
        "behind, up to 3 sizes away",
        "behind, up to 30 sizes away",
        "on the surface",
        "leads away",
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

/// The distance from the plane that counts as near, in sizes.
const NEAR: f64 = 0.05;

/// The cosine between the ray and the triangle's normal.
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
    ],
    class: |call| {
        Some(match Plane::of(call)?.least_weight() {
            EDGE.. => 0,
            0.0.. => 1,
            -0.02.. => 2,
            -1.0.. => 3,
            _ => 4,
        })
    },
};

/// The largest weight at which a point counts as just inside an edge.
const EDGE: f64 = 0.02;

/// The corner with the smallest weight.
const LEAST_WEIGHT: Aspect<ShapeCall> = Aspect {
    name: "least weight",
    classes: &["p0", "p1", "p2"],
    class: |call| {
        let plane = Plane::of(call)?;
        (0..3).min_by(|&a, &b| plane.weights[a].total_cmp(&plane.weights[b]))
    },
};

/// The point where a call's ray crosses the plane of the triangle.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// The ray.
    pub ray64: Ray64,
    /// The distance along the ray, which is negative if the ray leads away from the plane.
    pub distance: f64,
    /// The weights of the corners.
    pub weights: [f64; 3],
    /// The ray's direction times the normal (p1 − p0) × (p2 − p0), which has length one. Negative if
    /// the ray comes from the front.
    pub slope: f64,
    /// The length of the sum of the corners' normals, times the weights.
    normal_length: f64,
    /// The distance of the ray's start from the triangle, in sizes.
    start: f64,
    /// The smallest altitude.
    altitude: f64,
    /// The longest side.
    longest: f64,
    /// Half of the longest side of the triangle's box.
    size: f64,
    /// The largest coordinate of the ray and the triangle.
    coordinates: f64,
}

impl Plane {
    /// Returns the point where a call's ray crosses the plane, or `None` if it is parallel to it.
    pub fn of(call: &ShapeCall) -> Option<Plane> {
        let corners @ [p0, p1, p2] = scan::corners(&call.shape)?;
        let ray64 = Ray64::from(&call.ray);
        let crossing = triangle::intersect_plane(&ray64, corners)?;
        let normal = (p1 - p0).cross(p2 - p0);
        let longest = p0.distance(p1).max(p1.distance(p2)).max(p2.distance(p0));
        let points = corners.into_iter().chain([ray64.origin]);
        let weighted = corner_normals(&call.shape).map(|[n0, n1, n2]| {
            let [w0, w1, w2] = crossing.weights;
            w0 * n0 + w1 * n1 + w2 * n2
        });
        let bounds = scan::bounds(&call.shape);
        let beside = ray64.origin - ray64.origin.clamp(bounds.min, bounds.max);
        Some(Plane {
            normal_length: weighted.map_or(1.0, DVec3::length),
            start: beside.length() / call.size(),
            ray64,
            distance: crossing.distance,
            weights: crossing.weights,
            slope: normal.normalize().dot(ray64.dir),
            altitude: normal.length() / longest,
            longest,
            size: call.size(),
            coordinates: points
                .map(|point| point.abs().max_element())
                .fold(0.0, f64::max),
        })
    }

    /// Returns the smallest weight, which is negative outside the triangle.
    pub fn least_weight(&self) -> f64 {
        self.weights.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Returns whether the range of the ray is from 0 to ∞.
    pub fn is_unlimited(&self) -> bool {
        self.ray64.min == 0.0 && self.ray64.max == f64::INFINITY
    }

    /// Returns whether the ray crosses the plane inside the triangle, whatever its range is.
    pub fn is_inside(&self) -> bool {
        self.least_weight() >= 0.0
    }

    fn is_hit(&self) -> bool {
        self.is_inside() && self.ray64.is_in_range(self.distance)
    }

    /// Returns how wrong the distance may be if it is computed in single precision by a usual formula,
    /// such as (n · p0 − n · origin) / (n · direction).
    fn distance_error(&self) -> f64 {
        let slenderness = self.longest / self.altitude;
        let lengths = self.coordinates + self.distance.abs();
        let determinant = slenderness * (self.distance.abs() + self.longest);
        1.5 * EPSILON * (lengths + determinant) / self.slope.abs()
    }

    /// Returns how wrong a weight may be if it is computed in single precision by a usual formula. Some
    /// divide by the square of the area.
    fn weight_error(&self) -> f64 {
        let position = 2.0 * self.distance_error() + 4.0 * EPSILON * self.coordinates;
        position / self.altitude + 4.0 * EPSILON * (self.longest / self.altitude).powi(2)
    }

    /// Returns whether every correct formula in single precision agrees on whether the triangle is hit.
    pub fn is_clear(&self) -> bool {
        /// The least distance from an edge, in altitudes.
        const EDGE_MARGIN: f64 = 5e-4;
        /// The least cosine at which edges are tested.
        const EDGE_COSINE: f64 = 0.1;
        /// The least distance from an edge of a ray at a smaller cosine, in altitudes.
        const GRAZING_MARGIN: f64 = 0.1;
        /// The least difference between a distance and an end of the range, in sizes.
        const END_MARGIN: f64 = 0.0101;
        let margin = if self.slope.abs() < EDGE_COSINE {
            GRAZING_MARGIN
        } else {
            EDGE_MARGIN
        };
        let margin = margin.max(4.0 * self.weight_error());
        if self.start > FURTHEST_SIZES || self.coordinates > FURTHEST {
            return false;
        }
        if self.slope.abs() < 3.5e-3 || self.least_weight().abs() < margin {
            return false;
        }
        let margin = (END_MARGIN * self.size).max(4.0 * self.distance_error());
        let mut ends = [self.ray64.min, self.ray64.max].into_iter();
        !self.is_inside() || ends.all(|end| (self.distance - end).abs() >= margin)
    }

    /// Returns whether every correct formula in single precision computes the quantity of this name well
    /// within its tolerance.
    pub fn is_exact(&self, quantity: &str) -> bool {
        /// The largest part of a tolerance that errors may take.
        const PART: f64 = 0.5;
        if !self.is_hit() {
            return true;
        }
        let scale = self.coordinates.max(self.distance);
        match quantity {
            "distance" | "position" => self.distance_error() <= PART * 1e-4 * scale,
            "normal" => {
                /// The least length of a sum whose direction is well known.
                const LEAST: f64 = 0.3;
                let error = 2.0 * self.weight_error() / self.normal_length;
                self.normal_length > LEAST && error <= PART * 1e-3
            }
            // Corners may differ by five tiles.
            "uv" => 5.0 * self.weight_error() <= PART * 2e-3,
            _ => true,
        }
    }
}

/// The relative error of one operation in single precision.
const EPSILON: f64 = 6e-8;

/// Draws a triangle of this size. It faces along an axis, almost so, or in any direction, and may be
/// narrow at a corner.
fn drawn_shape(rng: &mut Rng, size: usize) -> Shape {
    let size = fields::size(rng, size);
    let corners = corners(rng);
    let bounds = Bounds::around(corners);
    let factor = 2.0 * size / (bounds.max - bounds.min).max_element();
    let start = if rng.index(6) == 0 {
        -factor * corners[0]
    } else {
        fields::place(rng, size) - factor * bounds.center()
    };
    let corners = corners.map(|corner| (start + factor * corner).as_vec3());
    let [p0, p1, p2] = corners.map(|corner| corner.as_dvec3());
    let side = rng.sign() * (p1 - p0).cross(p2 - p0).normalize();
    let vertices = with_attributes(rng, corners, side);
    Shape::Triangle {
        vertices,
        shape: fields::number(rng),
    }
}

/// Draws normals, which more or less point to a side, and texture coordinates.
fn with_attributes(rng: &mut Rng, corners: [Vec3; 3], side: DVec3) -> [Vertex; 3] {
    let common = (side + 0.7 * rng.direction()).normalize();
    let spread = [0.0, 0.4, 0.8, 2.0, 2.0][rng.index(5)];
    let (least, most) = if rng.coin() { (0.0, 1.0) } else { (-2.0, 3.0) };
    let tile = DVec2::new(rng.uniform(least, most), rng.uniform(least, most));
    let (same_u, same_v) =
        [(true, true), (false, true), (false, false), (false, false)][rng.index(4)];
    corners.map(|corner| {
        let normal = (common + spread * rng.direction()).normalize();
        let uv = DVec2::new(rng.uniform(least, most), rng.uniform(least, most));
        let uv = DVec2::select(BVec2::new(same_u, same_v), tile, uv);
        Vertex::new(corner, normal.as_vec3(), uv.as_vec2())
    })
}

/// Returns a call whose answer differs in what is judged: another triangle is hit, or at another place.
fn similar(call: &ShapeCall, judged: &[&str]) -> ShapeCall {
    let Shape::Triangle { vertices, .. } = call.shape else {
        return *call;
    };
    let of_corners = ["normal", "uv", "shape"];
    if of_corners.iter().any(|name| judged.contains(name)) {
        let mut similar = call.with_other_number();
        if let Shape::Triangle { vertices, .. } = &mut similar.shape {
            // Each corner has what another one had.
            let [a, b, c] = vertices.map(|vertex| (vertex.normal, vertex.uv));
            for (vertex, (normal, uv)) in vertices.iter_mut().zip([b, c, a]) {
                (vertex.normal, vertex.uv) = (normal, uv + Vec2::splat(0.25));
            }
        }
        similar
    } else if judged.contains(&"position") {
        call.moved_to_origin(vertices[0].position)
    } else {
        call.smaller()
    }
}

/// Draws the corners of a triangle with sides of about one.
fn corners(rng: &mut Rng) -> [DVec3; 3] {
    let (axis, kind) = (rng.index(3), rng.index(4));
    let tilt = match kind {
        0 | 1 => 0.0,
        2 => rng.log_uniform(1e-6, 1e-3),
        _ => 1.0,
    };
    // Often, one edge is along an axis in the triangle's plane.
    let (from, along) = (rng.index(3), (axis + 1 + rng.index(2)) % 3);
    let has_edge_along = rng.index(3) == 0;
    let mut corners = rng.retry(|rng| {
        let mut corners = [(); 3].map(|()| {
            let mut corner = rng.point(1.0);
            corner[axis] *= tilt;
            corner
        });
        if has_edge_along {
            let start = corners[from];
            let end = &mut corners[(from + 1) % 3];
            *end = DVec3::select(
                BVec3::from_array([0, 1, 2].map(|it| it == along)),
                *end,
                start,
            );
        }
        let [p0, p1, p2] = corners;
        let longest = p0.distance(p1).max(p1.distance(p2)).max(p2.distance(p0));
        let altitude = (p1 - p0).cross(p2 - p0).length() / longest;
        (altitude > 0.3 * longest && longest > 0.5).then_some(corners)
    });
    let corner = rng.index(3);
    let (second, third) = ((corner + 1) % 3, (corner + 2) % 3);
    match rng.index(5) {
        // The side opposite a corner is so short that the corner is narrow.
        0 => corners[third] = corners[second].lerp(corners[third], rng.uniform(0.015, 0.03)),
        // A corner is so close to the side opposite it that the triangle is flat there.
        1 => {
            let foot = corners[second].lerp(corners[third], rng.uniform(0.3, 0.7));
            corners[corner] = foot.lerp(corners[corner], rng.log_uniform(0.01, 0.04));
        }
        // The angle at a corner is almost right.
        2 => {
            let side = corners[second] - corners[corner];
            let other = corners[third] - corners[corner];
            let part = other.dot(side) / side.length_squared();
            let slant = rng.sign() * rng.uniform(0.5, 0.9) * ALMOST_RIGHT;
            let across = other - part * side;
            let along = slant * across.length() / side.length();
            corners[third] = corners[corner] + across + along * side;
        }
        _ => {}
    }
    corners
}

/// Returns the weights of a point: inside, near an edge, or outside.
fn weights(rng: &mut Rng) -> [f64; 3] {
    let least = match rng.index(6) {
        0 | 1 => return fields::weights_inside(rng, EDGE),
        2 => rng.log_uniform(5e-4, EDGE),
        3 => -rng.log_uniform(5e-4, EDGE),
        4 => -rng.uniform(EDGE, 1.0),
        _ => -rng.uniform(1.0, 4.0),
    };
    let (corner, along) = (rng.index(3), rng.uniform(0.05, 0.95));
    let mut weights = [least; 3];
    weights[(corner + 1) % 3] = (1.0 - least) * along;
    weights[(corner + 2) % 3] = (1.0 - least) * (1.0 - along);
    weights
}

/// Draws a ray through the plane of a triangle. Returns `None` if it would start too far away.
fn ray(rng: &mut Rng, shape: &Shape) -> Option<Ray> {
    let [p0, p1, p2] = scan::corners(shape)?;
    let [w0, w1, w2] = weights(rng);
    let target = w0 * p0 + w1 * p1 + w2 * p2;
    let front = (p1 - p0).cross(p2 - p0).normalize();
    let bounds = scan::bounds(shape);
    let size = 0.5 * (bounds.max - bounds.min).max_element();
    let kind = rng.index(6);
    let dir = match kind {
        0 => {
            let cosine = rng.sign() * rng.log_uniform(3.5e-3, 0.1);
            let along = rng.perpendicular_to(front);
            (1.0 - cosine * cosine).sqrt() * along + cosine * front
        }
        1 => rng.sign() * front,
        _ => fields::direction(rng),
    };
    let ahead = size
        * match rng.index(6) {
            // The shorter the way, the smaller the cosine at which rounding still allows an exact answer.
            _ if kind == 0 && rng.coin() => rng.log_uniform(NEAR, 1.0),
            0 => rng.log_uniform(NEAR, 3.0),
            1 => rng.log_uniform(0.0102, NEAR),
            2 | 3 => rng.uniform(3.0, 28.0),
            4 => 0.0,
            _ => -rng.log_uniform(0.05, 28.0),
        };
    let (origin, dir) = fields::ray_toward(rng, target, dir, ahead, size)?;
    let range = fields::range(rng, ahead.max(0.0) + 2.0 * size);
    Some(Ray::new(origin.as_vec3(), dir.as_vec3()).within(range.min, range.max))
}

/// Draws triangles of these sizes, each with rays that belong to an idea, every other one a hit. All
/// correct formulas compute the judged quantities within their tolerances.
pub fn tables(
    rng: &mut Rng,
    judged: &[&str],
    sizes: &[usize],
    belongs: impl Fn(&Plane) -> bool,
) -> Vec<(Shape, Vec<Ray>)> {
    let is_fair = |plane: &Plane| plane.is_clear() && judged.iter().all(|it| plane.is_exact(it));
    let generator = Generator {
        domain: &TRIANGLE,
        subject: &drawn_shape,
        input: &ray,
        similar: &|call| similar(call, judged),
        fits: &|call| Plane::of(call).is_some_and(|plane| is_fair(&plane) && belongs(&plane)),
    };
    generator.tables(rng, sizes)
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;
    use crate::domains::Call;
    use crate::seed::Seed;

    /// The distance to the plane, and the weights as ratios of dot products, in single precision.
    fn distance(ray: &Ray, shape: &Shape) -> Option<f32> {
        let Shape::Triangle { vertices, .. } = shape else {
            return None;
        };
        let [p0, p1, p2] = [0, 1, 2].map(|corner| vertices[corner].position);
        let (e1, e2) = (p1 - p0, p2 - p0);
        let face = e1.cross(e2);
        let t = face.dot(p0 - ray.origin) / face.dot(ray.dir);
        let point = ray.at(t) - p0;
        let area = face.dot(face);
        let (u, v) = (
            point.cross(e2).dot(face) / area,
            e1.cross(point).dot(face) / area,
        );
        let is_inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (is_inside && ray.range.contains(t)).then_some(t)
    }

    #[test]
    fn a_usual_formula_in_single_precision_stays_within_the_tolerances() {
        for seed in 0..8 {
            let mut rng = Seed(seed).rng("triangle");
            for (shape, rays) in tables(&mut rng, &["distance"], fields::EVERY_SIZE, |_| true) {
                for ray in rays {
                    let plane = Plane::of(&ShapeCall::new(shape, ray)).expect("a triangle");
                    let got = distance(&ray, &shape);
                    assert_eq!(got.is_some(), plane.is_hit(), "{ray:?} {shape:?}");
                    let error = got.map_or(0.0, |got| f64::from(got) - plane.distance);
                    let scale = plane.coordinates.max(plane.distance);
                    assert!(error.abs() < 0.5e-4 * scale, "{ray:?} {shape:?}");
                }
            }
        }
    }

    #[test]
    fn edges_and_ends_of_ranges_are_not_clear() {
        let corner =
            |x: f32, y: f32| Vertex::new(glam::vec3(x, y, -5.0), glam::Vec3::Z, Vec2::ZERO);
        let shape = Shape::Triangle {
            vertices: [corner(-1.0, -1.0), corner(1.0, -1.0), corner(-1.0, 1.0)],
            shape: 0,
        };
        let is_clear = |x: f32, max: f32| {
            let ray = Ray::new(glam::vec3(x, -0.5, 0.0), glam::Vec3::NEG_Z).within(0.0, max);
            Plane::of(&ShapeCall::new(shape, ray))
                .expect("a triangle")
                .is_clear()
        };
        assert!(is_clear(-0.9, 9.0) && is_clear(-0.998, 9.0) && is_clear(-1.002, 9.0));
        assert!(!is_clear(-0.9999, 9.0) && !is_clear(-1.0001, 9.0));
        assert!(!is_clear(-0.9, 5.01) && is_clear(-0.9, 4.9));
    }
}
