//! The domains of single fields: their special values and magnitudes, and functions that pick
//! random values.

mod rays;

use std::collections::BTreeSet;

use glam::{DVec3, Vec3};
use protocol::Interval;

use crate::seed::Rng;

pub use rays::{
    HARDLY, almost_the_same_ray, history_class, is_almost_the_same_ray, is_mirrored,
    is_mirrored_start, is_same_line, mirrored, mirrored_start, moved, ray_toward, turned,
};

/// The largest coordinate of a scene.
pub const FURTHEST: f64 = 1000.0;

/// The largest distance between a shape and its viewer, as a multiple of the shape's size. The size
/// is half of the longest side, or the radius.
pub const FURTHEST_SIZES: f64 = 30.0;

/// The relative error of one operation in single precision.
pub const EPSILON: f64 = 6e-8;

/// The classes of lengths: decades, named after their lower limits.
pub const SIZES: &[&str] = &[
    "below 1e-4",
    "1e-4",
    "1e-3",
    "1e-2",
    "0.1",
    "1",
    "10",
    "100",
    "500",
];

/// All classes of lengths. Lengths of about one come first, since a report shows the first wrong
/// answer.
pub const EVERY_SIZE: &[usize] = &[5, 4, 6, 3, 7, 2, 8, 1, 0];
/// The classes of lengths that most items use. The other classes are tested where an absolute
/// threshold could matter.
pub const USUAL: &[usize] = &[5, 4, 6, 7, 8];
/// The classes of lengths below one tenth.
pub const SMALL: &[usize] = &[3, 2, 1, 0];
/// The classes of lengths so small that an absolute threshold could matter.
pub const TINY: &[usize] = &[0, 1, 2];

/// Returns the class of a length: its decade.
pub fn size_class(size: f64) -> usize {
    if size >= 500.0 {
        return SIZES.len() - 1;
    }
    // Rounding can make a power of ten slightly smaller.
    let decade = ((1.0 + 1e-6) * size).log10().floor() as i32 + 5;
    decade.clamp(0, SIZES.len() as i32 - 2) as usize
}

/// Picks a random length in this class. It is often exactly or almost a power of ten.
pub fn size(rng: &mut Rng, class: usize) -> f64 {
    let (least, most) = match class {
        0 => (2e-7, 1e-4),
        7 => (100.0, 500.0),
        8 => (500.0, FURTHEST),
        _ => {
            let least = 10f64.powi(class as i32 - 5);
            (least, 10.0 * least)
        }
    };
    match rng.index(6) {
        _ if class == 7 && rng.index(4) == 0 => ACROSS.0 + rng.uniform(0.0, ACROSS.1 - ACROSS.0),
        0 => least,
        1 => least * rng.log_uniform(1.0, 1.05),
        2 => most * rng.log_uniform(0.95, 1.0),
        _ => rng.log_uniform(1.05 * least, 0.95 * most),
    }
}

/// The classes of lengths, by how close they are to a power of ten.
pub const ROUND: &[&str] = &[
    "just above a power of ten",
    "just below a power of ten",
    "between",
];

/// Classifies a length by how close it is to a power of ten.
pub fn round_class(size: f64) -> usize {
    let log = size.log10();
    let above = 10f64.powf(log - log.floor());
    match above {
        ..1.05 => 0,
        9.5.. => 1,
        _ => 2,
    }
}

/// Returns the class of a number, given the largest number in each class but the last.
pub fn class_up_to<T: PartialOrd>(limits: &[T], number: T) -> usize {
    class_where(limits, |limit| number <= *limit)
}

/// Returns the class of a number, given each class's upper limit, which belongs to the next class.
pub fn class_below<T: PartialOrd>(limits: &[T], number: T) -> usize {
    class_where(limits, |limit| number < *limit)
}

/// Returns the class of a number, given the smallest number in each class but the last. The limits
/// decrease.
pub fn class_from<T: PartialOrd>(limits: &[T], number: T) -> usize {
    class_where(limits, |limit| number >= *limit)
}

fn class_where<T>(limits: &[T], is_within: impl Fn(&T) -> bool) -> usize {
    limits.iter().position(is_within).unwrap_or(limits.len())
}

/// The classes of distances along a ray.
pub const DISTANCES: &[&str] = &["below 1e-2", "1e-2", "1", "100", "2000", "3000"];

/// Returns the class of a distance along a ray.
pub fn distance_class(distance: f64) -> usize {
    class_below(&[1e-2, 1.0, 100.0, 2000.0, 3000.0], distance)
}

/// The classes of positions, by the largest coordinate as a multiple of the shape's size.
pub const PLACES: &[&str] = &[
    "around the origin",
    "1 size away",
    "10 sizes away",
    "100 sizes away",
    "1,000 sizes away",
];

/// Returns the class of a position.
pub fn place_class(position: DVec3, size: f64) -> usize {
    class_below(
        &[1.0, 10.0, 100.0, 1000.0],
        position.abs().max_element() / size,
    )
}

/// The range of sizes for shapes that are in one corner of a scene and seen from the opposite
/// corner. Smaller shapes are too far away for their size, and larger ones extend too far into the
/// scene.
const ACROSS: (f64, f64) = (106.0, 130.0);

/// Picks a random position for a shape of this size. No coordinate of the shape exceeds the largest
/// coordinate of a scene, and no coordinate of the position exceeds 5,000 times the size. Some
/// positions are on an axis or in a corner of the scene.
pub fn place(rng: &mut Rng, size: f64) -> DVec3 {
    let furthest = (FURTHEST - size).min(5000.0 * size);
    if (ACROSS.0..ACROSS.1).contains(&size) && rng.coin() {
        return furthest * rng.vector(0.98, 1.0) * signs(rng);
    }
    let mut position = match rng.index(PLACES.len()) {
        0 if rng.coin() => DVec3::ZERO,
        0 => rng.point(0.9 * size),
        class => {
            let sizes = 10f64.powi(class as i32 - 1) * rng.log_uniform(1.1, 9.0);
            (size * sizes).min(furthest) * rng.vector(0.3, 1.0) * signs(rng)
        }
    };
    if rng.index(12) == 0 {
        // Half of these positions are straight ahead of a camera.
        position = if rng.coin() {
            -position.abs() * DVec3::Z
        } else {
            position * DVec3::AXES[rng.index(3)]
        };
    }
    position.clamp(DVec3::splat(-furthest), DVec3::splat(furthest))
}

/// Picks three random signs.
fn signs(rng: &mut Rng) -> DVec3 {
    DVec3::from_array([rng.sign(), rng.sign(), rng.sign()])
}

/// The octants, by the signs of x, y and z.
pub const OCTANTS: &[&str] = &["+++", "-++", "+-+", "--+", "++-", "-+-", "+--", "---"];

/// Returns the octant of a vector, or `None` if one of its components is 0.
pub fn octant(vector: DVec3) -> Option<usize> {
    let is_inside = vector.abs().min_element() > 0.0;
    is_inside.then_some(vector.is_negative_bitmask() as usize)
}

/// The classes of directions: along an axis, in a coordinate plane, or in an octant.
pub const DIRECTIONS: &[&str] = &[
    "along +x",
    "along +y",
    "along +z",
    "along -x",
    "along -y",
    "along -z",
    "in the yz-plane",
    "in the zx-plane",
    "in the xy-plane",
    "+++",
    "-++",
    "+-+",
    "--+",
    "++-",
    "-+-",
    "+--",
    "---",
    "almost along an axis",
    "almost in a plane",
];

/// Direction components below this limit count as almost 0.
const ALMOST_ZERO: f32 = 0.01;

/// Returns the class of a direction.
pub fn direction_class(dir: Vec3) -> Option<usize> {
    let components = dir.to_array();
    let is_zero = components.map(|component| component == 0.0);
    let zeros = is_zero.iter().filter(|zero| **zero).count();
    let small = components
        .iter()
        .filter(|component| component.abs() < ALMOST_ZERO);
    match zeros {
        _ if small.clone().count() > zeros => Some(if small.count() == 2 { 17 } else { 18 }),
        0 => Some(9 + octant(dir.as_dvec3())?),
        1 => Some(6 + is_zero.iter().position(|zero| *zero)?),
        2 => {
            let axis = is_zero.iter().position(|zero| !zero)?;
            Some(if dir[axis] > 0.0 { axis } else { 3 + axis })
        }
        _ => None,
    }
}

/// Picks a random direction: along or close to an axis, in or close to a coordinate plane, or any
/// other direction. Zeros can have either sign.
pub fn direction(rng: &mut Rng) -> DVec3 {
    let dir = rng.retry(|rng| {
        let dir = rng.direction();
        (dir.abs().min_element() > 2.0 * f64::from(ALMOST_ZERO)).then_some(dir)
    });
    let axis = rng.index(3);
    let zeros = &[axis, (axis + 1) % 3][..rng.index(3)];
    let size = if rng.index(4) > 0 {
        0.0
    } else {
        rng.log_uniform(1e-5, 0.5 * f64::from(ALMOST_ZERO))
    };
    let mut dir = dir;
    for &zero in zeros {
        dir[zero] = 0.0;
    }
    dir = dir.normalize();
    for &zero in zeros {
        dir[zero] = size * rng.sign();
    }
    dir.normalize()
}

/// The classes of directions along a diagonal, with components of exactly the same size.
pub const DIAGONALS: &[&str] = &[
    "in the yz-plane",
    "in the zx-plane",
    "in the xy-plane",
    "of a cube",
];

/// Returns the class of a direction along a diagonal.
pub fn diagonal_class(dir: Vec3) -> Option<usize> {
    let [x, y, z] = dir.abs().to_array();
    match (x == y, y == z, z == x) {
        (true, true, _) => Some(3),
        (_, true, _) if x == 0.0 => Some(0),
        (_, _, true) if y == 0.0 => Some(1),
        (true, _, _) if z == 0.0 => Some(2),
        _ => None,
    }
}

/// Picks a random direction along a diagonal of a cube or of one of its faces.
pub fn diagonal(rng: &mut Rng) -> DVec3 {
    let mut dir = DVec3::ONE;
    if rng.index(4) > 0 {
        dir[rng.index(3)] = 0.0;
    }
    (signs(rng) * dir).normalize()
}

/// The classes of ranges.
pub const RANGES: &[&str] = &[
    "from 0 to ∞",
    "from 0 to a nearby end",
    "from a later start to ∞",
    "from a later start to a nearby end",
    "from 0 to a distant end",
    "from a later start to a distant end",
];

/// The end of a range that reaches beyond everything in a scene.
const FAR: f32 = 1e4;

/// Returns the class of a range.
pub fn range_class(range: Interval) -> Option<usize> {
    let starts_later = usize::from(range.min > 0.0);
    Some(match range.max {
        f32::INFINITY => 2 * starts_later,
        FAR.. => 4 + starts_later,
        _ => 1 + 2 * starts_later,
    })
}

/// Picks a random range whose ends are at distances up to `furthest`.
pub fn range(rng: &mut Rng, furthest: f64) -> Interval {
    let min = if rng.coin() {
        0.0
    } else {
        rng.uniform(0.0, furthest)
    };
    let max = match rng.index(6) {
        0..=1 => f64::INFINITY,
        2 if rng.index(3) == 0 => f32::MAX.into(),
        2 => rng.log_uniform(min.max(FAR.into()), 1e30),
        _ => rng.uniform(min, 1.2 * furthest),
    };
    Interval::new(min as f32, max as f32)
}

/// Picks a random range that begins or ends at this distance. Returns `None` if the distance is
/// negative.
pub fn range_with_end(rng: &mut Rng, end: f64) -> Option<Interval> {
    let end = end as f32;
    let range = if rng.coin() {
        Interval::new(end, f32::INFINITY)
    } else {
        Interval::new(0.0, end)
    };
    (end >= 0.0).then_some(range)
}

/// The classes of shape numbers.
pub const NUMBERS: &[&str] = &[
    "0",
    "1 to 255",
    "256 to 65535",
    "above 65535",
    "the largest",
];

/// Returns the class that a shape number belongs to.
pub fn number_class(number: u32) -> usize {
    match number {
        0 => 0,
        1..256 => 1,
        256..65536 => 2,
        65536..u32::MAX => 3,
        u32::MAX => 4,
    }
}

/// Picks a random shape number.
pub fn number(rng: &mut Rng) -> u32 {
    match rng.index(NUMBERS.len()) {
        0 => 0,
        1 => rng.integer(1, 255),
        2 => rng.integer(256, 65535),
        3 => rng.integer(65536, u32::MAX - 1),
        _ => u32::MAX,
    }
}

/// Returns random weights of a point inside a triangle. Each weight is at least `least`.
pub fn weights_inside(rng: &mut Rng, least: f64) -> [f64; 3] {
    let mut cuts = [rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0)];
    cuts.sort_by(f64::total_cmp);
    let parts = [cuts[0], cuts[1] - cuts[0], 1.0 - cuts[1]];
    parts.map(|part| least + (1.0 - 3.0 * least) * part)
}

/// Returns the base-two logarithm of a count, rounded to the nearest integer. The count must not be
/// 0.
pub fn powers_of_two(count: usize) -> usize {
    (count as f64).log2().round() as usize
}

/// Returns whether all values are distinct.
pub fn without_repetition<T: Ord>(values: impl IntoIterator<Item = T>) -> bool {
    let mut known = BTreeSet::new();
    values.into_iter().all(|value| known.insert(value))
}

/// Picks distinct random shape numbers.
pub fn numbers(rng: &mut Rng, count: usize) -> Vec<u32> {
    let mut known = BTreeSet::new();
    let mut fresh = || {
        rng.retry(|rng| {
            let number = number(rng);
            known.insert(number).then_some(number)
        })
    };
    (0..count).map(|_| fresh()).collect()
}
