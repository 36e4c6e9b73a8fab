//! Generates random calls to `Bvh::build` from its domain.

use glam::DVec3;
use judging::exam::{ExamQuestion, TreeCheck};
use protocol::Shape;

use crate::domains::Balance;
use crate::domains::build::{BuildCall, DRAWN};
use crate::domains::fields::{self, FURTHEST};
use crate::items::meshes;
use crate::items::transform::Transform;
use crate::seed::Rng;

/// The arrangement of some of the primitives. The others are scattered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arrangement {
    /// Scattered in a cube.
    Scattered,
    /// Boxes that are flat along one axis.
    FlatBoxes,
    /// Centres in a plane perpendicular to an axis.
    Plane,
    /// Centres in a row along an axis.
    Row,
    /// All centres coincide.
    Concentric,
    /// All primitives are equal.
    Equal,
    /// Two of the primitives are equal.
    EqualPair,
    /// One primitive is far from all others.
    Outlier,
    /// Most primitives are much smaller than the largest one.
    DifferentSizes,
    /// Some primitives are triangles without area.
    WithoutArea,
    /// All primitives are triangles on a line along an axis.
    Line,
}

/// Generates random questions about `count` trees. Each tree has at most `most` primitives, which
/// are in one of these arrangements. Each class of each aspect occurs, unless `belongs` rejects the
/// calls in that class.
pub(super) fn questions(
    rng: &mut Rng,
    checks: &[TreeCheck],
    count: usize,
    (arrangements, most): (&[Arrangement], usize),
    belongs: impl Fn(&BuildCall) -> bool,
) -> Vec<ExamQuestion> {
    let mut balance = Balance::new(DRAWN);
    let calls = (0..count).map(|index| {
        let arrangement = arrangements[index % arrangements.len()];
        let chosen = balance.choose(rng, |rng| {
            let call = call(rng, arrangement, index, most);
            belongs(&call).then_some(call)
        });
        let BuildCall {
            shapes,
            max_leaf_size,
        } = chosen.expect("at least one of the drawn calls is accepted");
        let numbers = fields::numbers(rng, shapes.len());
        let shapes = meshes::with_numbers(shapes, numbers);
        ExamQuestion::tree(shapes, max_leaf_size, checks, None)
    });
    calls.collect()
}

/// Picks a random call. The axis of a plane or a row depends on `index`.
fn call(rng: &mut Rng, arrangement: Arrangement, index: usize, most: usize) -> BuildCall {
    let count = count(rng, most);
    let kind = rng.index(4);
    let shapes = arranged(rng, arrangement, kind, count, index % 3);
    let size = rng.index(fields::SIZES.len());
    let mut transform = transform_of_size(rng, &shapes, size);
    if arrangement == Arrangement::Concentric {
        transform = transform.exact();
    }
    BuildCall {
        max_leaf_size: leaf_size(rng, count),
        shapes: transform.shapes(&shapes),
    }
}

/// Picks a random primitive count: from 0 to 10, or close to a power of two.
pub(super) fn count(rng: &mut Rng, most: usize) -> usize {
    rng.retry(|rng| {
        let count = match rng.index(16) {
            small @ ..=10 => small,
            large => (1 << (large - 7)) + rng.index(3) - 1,
        };
        (count <= most).then_some(count)
    })
}

/// Picks a random leaf size, i.e. the maximum number of primitives in a leaf: either any number, or
/// one close to the primitive count.
pub(super) fn leaf_size(rng: &mut Rng, count: usize) -> u32 {
    let count = count as u32;
    let size = match rng.index(11) {
        0 => 1,
        1 => 2,
        2 => rng.integer(3, 4),
        3 => rng.integer(5, 8),
        4 => rng.integer(9, 32),
        5 => rng.integer(33, 255),
        6 => rng.integer(256, 1000),
        7 => count,
        8 => count + 1,
        9 => count.saturating_sub(1),
        _ => count / 2,
    };
    size.clamp(1, 1000)
}

/// Picks a random transform that gives the shapes, taken together, a size in this class.
pub(super) fn transform_of_size(rng: &mut Rng, shapes: &[Shape], size: usize) -> Transform {
    rng.retry(|rng| {
        let size = fields::size(rng, size);
        let center = fields::place(rng, size);
        let largest = center.abs().max_element() + size;
        let transform = Transform::around(shapes, size, center);
        (largest <= FURTHEST && transform.keeps_digits(shapes)).then_some(transform)
    })
}

/// Returns primitives of this kind in this arrangement, inside the cube from −1 to 1.
fn arranged(
    rng: &mut Rng,
    arrangement: Arrangement,
    kind: usize,
    count: usize,
    axis: usize,
) -> Vec<Shape> {
    let size = rng.log_uniform(0.03, 0.4);
    let mut axes = DVec3::ONE;
    if matches!(arrangement, Arrangement::Plane | Arrangement::FlatBoxes) {
        axes[axis] = 0.0;
    } else if matches!(arrangement, Arrangement::Row | Arrangement::Line) {
        axes = DVec3::AXES[axis];
    } else if arrangement == Arrangement::Concentric {
        axes = DVec3::ZERO;
    }
    // Spheres have exactly these centres, but the boxes of triangles may have other centres.
    let has_centers = matches!(
        arrangement,
        Arrangement::Plane | Arrangement::Row | Arrangement::Concentric
    );
    let kind = if has_centers { 2 } else { kind };
    let mut shapes: Vec<Shape> = (0..count)
        .map(|index| {
            let center = axes * rng.point(1.0);
            let size = size * rng.uniform(0.5, 1.0);
            match arrangement {
                Arrangement::FlatBoxes => flat(rng, kind, center, size, axis),
                Arrangement::Concentric => shell(index),
                Arrangement::Outlier if index == 0 => {
                    let far = 30.0 * rng.direction();
                    primitive(rng, kind, far, size)
                }
                Arrangement::DifferentSizes => {
                    // Keep the centres of small primitives near each other.
                    let size = match index {
                        0 => 1.0,
                        1 => 5e-3,
                        _ => rng.log_uniform(5e-3, 1.0),
                    };
                    let center = size * rng.vector(0.5, 2.0);
                    primitive(rng, kind, center, size)
                }
                Arrangement::Line => {
                    let end = center + size * rng.sign() * axes;
                    meshes::flat_triangle([center, end, center], 0)
                }
                Arrangement::WithoutArea if index % 3 == 0 => without_area(rng, center, size),
                Arrangement::Scattered
                | Arrangement::Plane
                | Arrangement::Row
                | Arrangement::Equal
                | Arrangement::EqualPair
                | Arrangement::Outlier
                | Arrangement::WithoutArea => primitive(rng, kind, center, size),
            }
        })
        .collect();
    if arrangement == Arrangement::Equal && count > 0 {
        shapes = vec![shapes[0]; count];
    } else if arrangement == Arrangement::EqualPair && count > 1 {
        shapes[0] = shapes[1];
    }
    rng.shuffled(shapes)
}

/// Returns a primitive around a point: a triangle, a flat triangle, a sphere, or a random choice
/// among these three kinds.
pub(super) fn primitive(rng: &mut Rng, kind: usize, center: DVec3, size: f64) -> Shape {
    match kind {
        0 => meshes::random_triangle(rng, center, size),
        1 => meshes::random_flat_triangle(rng, center, size),
        2 => meshes::sphere(center, size),
        _ => {
            let kind = rng.index(3);
            primitive(rng, kind, center, size)
        }
    }
}

/// Returns a triangle with two or three corners at the same point.
fn without_area(rng: &mut Rng, center: DVec3, size: f64) -> Shape {
    let other = if rng.coin() {
        center
    } else {
        center + size * rng.direction()
    };
    meshes::flat_triangle([center, other, center], 0)
}

/// Returns a triangle in a plane perpendicular to an axis.
fn flat(rng: &mut Rng, kind: usize, center: DVec3, size: f64, axis: usize) -> Shape {
    let [x, y] = [1, 2].map(|next| size * rng.sign() * DVec3::AXES[(axis + next) % 3]);
    let corners = [center, center + x, center + y];
    let is_smooth = kind == 0 || (kind == 3 && rng.coin());
    if is_smooth {
        meshes::triangle(rng, corners)
    } else {
        meshes::flat_triangle(corners, 0)
    }
}

/// Returns one of many spheres around the origin. Their centres and radii are multiples of a power
/// of two, so they still have a common centre after they have been moved.
fn shell(index: usize) -> Shape {
    meshes::sphere(DVec3::ZERO, (index + 3) as f64 / 128.0)
}
