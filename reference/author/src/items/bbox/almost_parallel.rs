//! Rays that are almost parallel to a face of a box but still cross the plane of this face. The
//! times are wrong if a small constant is added to the direction, or if a small component is
//! treated as 0.

use glam::DVec3;
use judging::exam::ExamQuestion;
use protocol::{Interval, Ray};

use super::bbox_question;
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

/// The number of rays that hit. The same number of rays miss.
const QUERIES_OF_EACH_KIND: usize = 12;

/// Creates a question with rays that hit a box, followed by the same number of rays that miss it.
pub(super) fn question(rng: &mut Rng) -> ExamQuestion {
    // The planes are so close to the origin that no common formula loses digits.
    let mut corner = || rng.vector(0.2, 0.4).as_vec3().as_dvec3();
    let bounds = Bounds {
        min: -corner(),
        max: corner(),
    };
    let mut queries = Vec::new();
    for is_hit in [true, false] {
        for number in 0..QUERIES_OF_EACH_KIND {
            let ray = ray_that_crosses_a_plane(rng, &bounds, number, is_hit);
            queries.push((ray, Interval::AHEAD));
        }
    }
    bbox_question(bounds, queries)
}

/// Returns a ray that is almost parallel to a face of the box. A ray that hits the box crosses the
/// plane of this face where it enters or leaves the box. A ray that misses the box crosses this
/// plane outside the face.
fn ray_that_crosses_a_plane(rng: &mut Rng, bounds: &Bounds, number: usize, is_hit: bool) -> Ray {
    let (along, across) = (number % 3, (number + 1) % 3);
    let third = 3 - along - across;
    let enters = number.is_multiple_of(2);
    let size = bounds.max - bounds.min;
    let mut dir = DVec3::ZERO;
    dir[along] = rng.sign();
    let (least, most) = if (number / 2).is_multiple_of(2) {
        (0.0006, 0.0009)
    } else {
        (0.001, 0.003)
    };
    dir[across] = rng.sign() * rng.uniform(least, most);
    dir[third] = rng.uniform(-0.02, 0.02);
    let dir = dir.normalize();

    // The point where the ray crosses the plane.
    let moves_up = dir[across] > 0.0;
    let mut point = bounds.center() + 0.2 * rng.point(1.0) * size;
    point[across] = if enters == moves_up {
        bounds.min[across]
    } else {
        bounds.max[across]
    };
    if !is_hit {
        // A ray that enters the slab at this point has already left the box, and a ray that leaves
        // the slab at this point hasn't reached the box yet.
        let beyond = rng.uniform(0.8, 1.2) * size[along];
        let forward = if enters { 1.0 } else { -1.0 };
        point[along] = bounds.center()[along] + forward * dir[along].signum() * beyond;
    }
    let origin = point - rng.uniform(2.0, 4.0) * dir;
    Ray::new(origin.as_vec3(), dir.as_vec3())
}
