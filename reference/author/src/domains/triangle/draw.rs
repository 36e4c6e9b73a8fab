//! Generates random triangles, and rays through and past them.

use std::mem;

use glam::{BVec2, BVec3, DVec2, DVec3, Vec3, vec2};
use protocol::{Interval, Ray, Shape, Vertex};

use super::aspects::{
    ALMOST_RIGHT, EDGE, END, FAR_UV, NARROW_MISS, NEAR, RAY_ASPECTS, SMALL_WEIGHT, SUBJECT_ASPECTS,
    TEXEL, almost_right_corner,
};
use super::plane::{Plane, longest_side_and_altitude};
use crate::domains::fields::{self, FURTHEST};
use crate::domains::shape::{FOLLOW, ShapeCall};
use crate::domains::{Call, Change, Generator};
use crate::oracle::bbox::Bounds;
use crate::oracle::scan;
use crate::seed::Rng;

/// Generates random triangles of these sizes and, for each triangle, random rays that fit the idea
/// an item tests. Half of the rays are hits. Every correct formula computes the judged quantities
/// within their tolerances.
pub fn tables(
    rng: &mut Rng,
    judged: &[&str],
    sizes: &[usize],
    belongs: impl Fn(&Plane) -> bool,
) -> Vec<(Shape, Vec<Ray>)> {
    let is_fair = |plane: &Plane| plane.is_clear() && judged.iter().all(|it| plane.is_exact(it));
    let generator = Generator {
        subject_aspects: SUBJECT_ASPECTS,
        call_aspects: RAY_ASPECTS,
        subject: &drawn_shape,
        input: &ray,
        changes: CHANGES,
        // Items about a single quantity stay short.
        most_changes: if judged.len() > 2 { CHANGES.len() } else { 1 },
        follow: FOLLOW,
        fits: &|call| Plane::of(call).is_some_and(|plane| is_fair(&plane) && belongs(&plane)),
        differ: &|one, other| one.differs(other, judged),
    };
    generator.tables(rng, sizes)
}

/// Picks a random triangle of this size. It faces exactly or almost along an axis, along a
/// diagonal, or in any other direction. It may be narrow at a corner.
fn drawn_shape(rng: &mut Rng, size: usize) -> Shape {
    let size = fields::size(rng, size);
    let corners = corners(rng);
    let bounds = Bounds::around(corners);
    let factor = size / bounds.half_side();
    let start = if rng.index(6) == 0 {
        -factor * corners[0]
    } else {
        fields::place(rng, size) - factor * bounds.center()
    };
    let mut corners = corners.map(|corner| (start + factor * corner).as_vec3());
    if rng.index(3) == 0 {
        corners = facing_along_a_diagonal(rng, corners).unwrap_or(corners);
    }
    let [p0, p1, p2] = corners.map(|corner| corner.as_dvec3());
    let side = rng.sign() * (p1 - p0).cross(p2 - p0).normalize();
    let vertices = with_attributes(rng, corners, side);
    Shape::Triangle {
        vertices,
        shape: fields::number(rng),
    }
}

/// Picks random corners of a triangle whose sides are about one unit long.
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
        let (longest, altitude) = longest_side_and_altitude(corners);
        (altitude > 0.3 * longest && longest > 0.5).then_some(corners)
    });
    if rng.index(6) == 0 {
        return with_legs_along_axes(rng, (axis + 1) % 3, (axis + 2) % 3);
    }
    let corner = rng.index(3);
    let (second, third) = ((corner + 1) % 3, (corner + 2) % 3);
    match rng.index(5) {
        // The side opposite a corner is so short that the corner is narrow.
        0 => corners[third] = corners[second].lerp(corners[third], rng.log_uniform(0.004, 0.03)),
        // A corner is so close to the opposite side that the triangle is almost flat.
        1 => {
            let foot = corners[second].lerp(corners[third], rng.uniform(0.3, 0.7));
            let most = if rng.coin() { 0.014 } else { 0.04 };
            corners[corner] = foot.lerp(corners[corner], rng.log_uniform(0.01, most));
        }
        // The angle at a corner is almost a right angle.
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

/// Picks random corners of a triangle with a right angle between two sides along axes.
fn with_legs_along_axes(rng: &mut Rng, axis: usize, other: usize) -> [DVec3; 3] {
    let corner = rng.index(3);
    let mut corners = [rng.point(1.0); 3];
    let length = rng.uniform(0.6, 1.5);
    let other_length = if rng.coin() {
        length
    } else {
        rng.uniform(0.6, 1.5)
    };
    corners[(corner + 1) % 3][axis] += rng.sign() * length;
    corners[(corner + 2) % 3][other] += rng.sign() * other_length;
    corners
}

/// Moves the corners of a triangle so that its normal points exactly along a diagonal of a cube or
/// of one of the cube's faces. Returns `None` if the triangle would be narrow or too far away.
fn facing_along_a_diagonal(rng: &mut Rng, corners: [Vec3; 3]) -> Option<[Vec3; 3]> {
    /// The spacing of a grid, relative to the largest coordinate. The coordinates of the grid's
    /// points have so few digits that their sums are exact.
    const STEP: f32 = 1.0 / (1 << 20) as f32;
    let largest = corners.map(|corner| corner.abs().max_element());
    let largest = largest.into_iter().fold(0.0, f32::max);
    let step = largest.log2().ceil().exp2() * STEP;
    let on_grid = corners.map(|corner| (corner / step).round() * step);
    let diagonal = fields::diagonal(rng);
    let normal = (diagonal.signum() * diagonal.abs().ceil()).as_vec3();
    let axis = (0..3).find(|&axis| normal[axis] != 0.0)?;
    let first = on_grid[0];
    let moved = on_grid.map(|corner| {
        let mut side = corner - first;
        side[axis] = 0.0;
        side[axis] = -normal.dot(side) / normal[axis];
        first + side
    });
    let (longest, altitude) = longest_side_and_altitude(moved.map(|corner| corner.as_dvec3()));
    let is_inside = moved
        .iter()
        .all(|it| f64::from(it.abs().max_element()) < FURTHEST);
    (altitude > 0.3 * longest && is_inside).then_some(moved)
}

/// Picks random texture coordinates, and random normals that all point roughly to one side.
fn with_attributes(rng: &mut Rng, corners: [Vec3; 3], side: DVec3) -> [Vertex; 3] {
    let common = (side + 0.7 * rng.direction()).normalize();
    let spread = match rng.index(6) {
        0 => 0.0,
        1 => rng.log_uniform(0.008, 0.02),
        2 => rng.log_uniform(0.02, 0.8),
        3 => 0.8,
        _ => 2.0,
    };
    let (least, most) = [(0.0, 1.0), (-2.0, 3.0), (-FAR_UV, FAR_UV)][rng.index(3)];
    let tile = DVec2::new(rng.uniform(least, most), rng.uniform(least, most));
    let in_a_texel = rng.index(8) == 0;
    let texel = rng.log_uniform(0.005, 0.8 * TEXEL);
    let (same_u, same_v) =
        [(true, true), (false, true), (false, false), (false, false)][rng.index(4)];
    let mut vertices = corners.map(|corner| {
        let normal = (common + spread * rng.direction()).normalize();
        let uv = if in_a_texel {
            tile + texel * DVec2::new(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5))
        } else {
            DVec2::new(rng.uniform(least, most), rng.uniform(least, most))
        };
        let uv = DVec2::select(BVec2::new(same_u, same_v), tile, uv);
        Vertex::new(corner, normal.as_vec3(), uv.as_vec2())
    });
    // Often, two corners have the same normal or the same texture coordinates, or one corner has
    // very different texture coordinates.
    let [from, to, any] = [rng.index(3), rng.index(3), rng.index(3)];
    // At a corner whose angle is almost a right angle, very different texture coordinates make
    // wrong weights visible.
    let right = almost_right_corner(corners.map(|corner| corner.as_dvec3()));
    let right = right.filter(|_| rng.coin());
    let (far, kind) = right.map_or_else(|| (any, rng.index(6)), |corner| (corner, 2));
    match kind {
        0 => vertices[to].normal = vertices[from].normal,
        1 => vertices[to].uv = vertices[from].uv,
        2 => {
            let sign = if rng.coin() { 1.0 } else { -1.0 };
            for (corner, vertex) in vertices.iter_mut().enumerate() {
                let from_middle = if corner == far { 2.4 } else { -2.4 };
                let from_middle = from_middle + rng.uniform(-0.1, 0.1);
                vertex.uv = DVec2::splat(0.5 + sign * from_middle).as_vec2();
                vertex.uv.x += rng.uniform(-0.05, 0.05) as f32;
            }
        }
        _ => {}
    }
    vertices
}

/// Picks a random ray through the plane of a triangle. Returns `None` if it would start too far
/// away.
fn ray(rng: &mut Rng, shape: &Shape) -> Option<Ray> {
    let [p0, p1, p2] = scan::corners(shape)?;
    let [w0, w1, w2] = weights(rng);
    let target = w0 * p0 + w1 * p1 + w2 * p2;
    let front = (p1 - p0).cross(p2 - p0).normalize();
    let size = scan::bounds(shape).half_side();
    let kind = rng.index(7);
    let dir = match kind {
        0 => {
            let cosine = rng.sign() * rng.log_uniform(3.5e-3, 0.1);
            let along = rng.perpendicular_to(front);
            (1.0 - cosine * cosine).sqrt() * along + cosine * front
        }
        1 => rng.sign() * front,
        2 => fields::diagonal(rng),
        _ => fields::direction(rng),
    };
    let ahead = size
        * match rng.index(6) {
            // The shorter the distance, the smaller the cosine can be before rounding spoils the
            // answer.
            _ if kind == 0 && rng.coin() => rng.log_uniform(NEAR, 1.0),
            0 => rng.log_uniform(NEAR, 3.0),
            1 => rng.log_uniform(0.0102, NEAR),
            2 | 3 => rng.uniform(3.0, 28.0),
            4 => 0.0,
            _ => -rng.log_uniform(0.05, 28.0),
        };
    let (origin, dir) = fields::ray_toward(rng, target, dir, ahead, size)?;
    let ray = Ray::new(origin.as_vec3(), dir.as_vec3());
    let range = match rng.index(8) {
        0 => range_from_the_plane(rng, &ShapeCall::new(*shape, ray))?,
        _ => fields::range(rng, ahead.max(0.0) + 2.0 * size),
    };
    Some(ray.within(range.min, range.max))
}

/// Picks a random range that begins or ends just in front of or just behind the triangle's plane.
fn range_from_the_plane(rng: &mut Rng, call: &ShapeCall) -> Option<Interval> {
    let plane = Plane::of(call)?;
    let beside = plane.size * rng.log_uniform(0.0102, END);
    let end = plane.distance + rng.sign() * beside;
    fields::range_with_end(rng, end)
}

/// Picks random weights of a point that is inside, near a corner, near an edge, or outside.
fn weights(rng: &mut Rng) -> [f64; 3] {
    let least = match rng.index(8) {
        0 | 1 => return fields::weights_inside(rng, EDGE),
        6 => return close_to_a_corner(rng),
        7 => return beyond_a_corner(rng),
        2 if rng.coin() => rng.log_uniform(5e-4, SMALL_WEIGHT),
        2 => rng.log_uniform(5e-4, EDGE),
        3 if rng.coin() => -rng.log_uniform(5e-4, NARROW_MISS),
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

/// Picks random weights of a point that is close to a corner but not to an edge.
fn close_to_a_corner(rng: &mut Rng) -> [f64; 3] {
    let [one, other] = [(); 2].map(|()| rng.uniform(1.05 * EDGE, 2.5 * EDGE));
    let mut weights = [one; 3];
    let corner = rng.index(3);
    weights[corner] = 1.0 - one - other;
    weights[(corner + 1) % 3] = other;
    weights
}

/// Picks random weights of a point outside two edges.
fn beyond_a_corner(rng: &mut Rng) -> [f64; 3] {
    let mut weights = [(); 3].map(|()| -rng.log_uniform(1e-3, 1.0));
    let corner = rng.index(3);
    weights[corner] = 1.0 - weights[(corner + 1) % 3] - weights[(corner + 2) % 3];
    weights
}

/// The ways a triangle can differ from the previous one.
const CHANGES: &[Change<ShapeCall>] = &[
    ShapeCall::smaller,
    ShapeCall::with_other_number,
    ShapeCall::in_a_smaller_world,
    |call, random| with_exchanged(call, random, mem::swap),
    |call, random| {
        with_exchanged(call, random, |one, other| {
            mem::swap(&mut one.uv, &mut other.uv)
        })
    },
    |call, random| {
        with_exchanged(call, random, |one, other| {
            mem::swap(&mut one.normal, &mut other.normal);
        })
    },
    |call, _| {
        let [first, _, _] = scan::corners(&call.shape).unwrap_or_default();
        call.moved_to_origin(first.as_vec3())
    },
    // Each corner moves along a different axis.
    |call, random| with_other_corner(call, 0, call.offset_along(2, random)),
    |call, random| with_other_corner(call, 1, call.offset_along(0, random)),
    |call, random| with_other_corner(call, 2, call.offset_along(1, random)),
    |call, random| {
        with_other_attributes(call, random, |vertex| {
            let normal = vertex.normal.as_dvec3() + 0.8 * random;
            vertex.normal = normal.normalize().as_vec3();
        })
    },
    |call, random| {
        with_other_attributes(call, random, |vertex| {
            vertex.uv = vec2(vertex.uv.y, vertex.uv.x);
        })
    },
];

/// Returns the call with something swapped between two corners of the triangle.
fn with_exchanged(
    call: &ShapeCall,
    random: DVec3,
    exchange: impl Fn(&mut Vertex, &mut Vertex),
) -> ShapeCall {
    let mut changed = ShapeCall::new(call.shape, call.ray);
    if let Shape::Triangle { vertices, .. } = &mut changed.shape {
        vertices.rotate_left(random.max_position());
        let [one, other, _] = vertices;
        exchange(one, other);
        vertices.rotate_right(random.max_position());
    }
    changed
}

/// Returns the call with one corner of the triangle at a different position.
fn with_other_corner(call: &ShapeCall, corner: usize, offset: Vec3) -> ShapeCall {
    let mut changed = ShapeCall::new(call.shape, call.ray);
    if let Shape::Triangle { vertices, .. } = &mut changed.shape {
        vertices[corner].position += offset;
    }
    changed
}

/// Returns the call with a different normal or different texture coordinates at one corner of the
/// triangle.
fn with_other_attributes(
    call: &ShapeCall,
    random: DVec3,
    change: impl Fn(&mut Vertex),
) -> ShapeCall {
    let mut changed = ShapeCall::new(call.shape, call.ray);
    if let Shape::Triangle { vertices, .. } = &mut changed.shape {
        let corner = random.max_position();
        change(&mut vertices[corner]);
    }
    changed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domains::Call;
    use crate::seed::Seed;

    /// Computes the distance to the plane and the weights as ratios of dot products, in single
    /// precision.
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
}
