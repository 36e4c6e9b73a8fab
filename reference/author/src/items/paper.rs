//! Questions with small whole numbers, which people can work out on paper. They come first in their
//! tasks, so that the report shows them first.

use glam::{DVec3, Vec3};
use judging::exam::ExamQuestion;
use protocol::{Interval, Ray, Shape, Vertex};

use super::{meshes, shape_question};
use crate::oracle::bbox::Bounds;
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;
use crate::tree::{Tree, construction, decoy};

/// The number of rays that hit a box. The same number of rays miss it.
const BOX_RAYS_OF_EACH_KIND: usize = 3;

/// Returns a point whose coordinates are whole numbers from −4 to 4.
fn whole_point(rng: &mut Rng) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| f64::from(rng.integer(0, 8)) - 4.0))
}

/// Returns the unit vectors of the three axes in random order, each with a random sign.
fn axes(rng: &mut Rng) -> [DVec3; 3] {
    let first = rng.index(3);
    let step = if rng.coin() { 1 } else { 2 };
    [first, first + step, first + 2 * step].map(|axis| rng.sign() * DVec3::AXES[axis % 3])
}

/// Returns a ray without negative zeros, which would look odd on paper.
fn paper_ray(origin: DVec3, dir: DVec3) -> Ray {
    Ray::new(origin.as_vec3() + Vec3::ZERO, dir.as_vec3() + Vec3::ZERO)
}

/// Creates a question with rays that hit a triangle from the front and rays that miss it.
/// All rays are perpendicular to the triangle. The triangle's legs are parallel to two axes and
/// have length 4, so the weights are multiples of a quarter.
pub(super) fn triangle(rng: &mut Rng) -> ExamQuestion {
    let corner = whole_point(rng);
    let [right, up, _] = axes(rng);
    let front = right.cross(up);
    let vertex = |u: f64, v: f64| {
        let position = corner + 4.0 * (u * right + v * up);
        let uv = glam::dvec2(u, v).as_vec2();
        Vertex::new(position.as_vec3(), front.as_vec3(), uv)
    };
    let shape = Shape::Triangle {
        vertices: [vertex(0.0, 0.0), vertex(1.0, 0.0), vertex(0.0, 1.0)],
        shape: rng.integer(1, 9),
    };
    let inside = rng.shuffled(vec![(1.0, 1.0), (2.0, 1.0), (1.0, 2.0)]);
    // One ray beyond each edge.
    let outside = rng.shuffled(vec![(-1.0, 2.0), (2.0, -1.0), (3.0, 2.0)]);
    let rays = inside.into_iter().chain(outside).map(|(x, y)| {
        let distance = f64::from(rng.integer(1, 9));
        let origin = corner + x * right + y * up + distance * front;
        paper_ray(origin, -front)
    });
    let rays: Vec<Ray> = rays.collect();
    shape_question(&["distance"], shape, rays)
}

/// Creates a question with rays that hit a sphere from outside and rays that miss it. All
/// rays are parallel to an axis. The radius is 5, so half a chord is 5, 4 or 3.
pub(super) fn sphere(rng: &mut Rng) -> ExamQuestion {
    let center = whole_point(rng);
    let shape = Shape::Sphere {
        center: center.as_vec3(),
        radius: 5.0,
        shape: rng.integer(1, 9),
    };
    let beside = [0.0, 3.0, 4.0, 6.0, 7.0];
    let rays = beside.map(|beside| {
        let [along, across, _] = axes(rng);
        let ahead = f64::from(rng.integer(6, 15));
        let origin = center + beside * across - ahead * along;
        paper_ray(origin, along)
    });
    shape_question(&["distance"], shape, rays)
}

/// Returns a box and rays in the directions (±1, ±2, ±2) / 3, with the axes in any order. The rays
/// that hit the box come first, followed by the rays that miss it.
pub(super) fn bbox(rng: &mut Rng) -> (Bounds, Vec<(Ray, Interval)>) {
    let min = whole_point(rng);
    let size = [(); 3].map(|()| f64::from(rng.integer(2, 5)));
    let bounds = Bounds {
        min,
        max: min + DVec3::from_array(size),
    };
    let queries = [true, false].map(|is_hit| {
        rng.list(BOX_RAYS_OF_EACH_KIND, |rng| {
            let ray = rng.retry(|rng| box_ray(rng, &bounds, is_hit));
            (ray, Interval::AHEAD)
        })
    });
    (bounds, queries.concat())
}

/// Returns a tree over four triangles, one behind the other, and rays through them from either end.
/// All rays are parallel to an axis. The first ray hits or touches at least two triangles, and the
/// last ray misses all of them. All distances are whole numbers.
pub(super) fn tree(rng: &mut Rng) -> (Tree, Vec<Ray>) {
    rng.retry(|rng| {
        let corner = whole_point(rng);
        let [along, right, up] = axes(rng);
        let at = |depth: f64, x: f64, y: f64| corner + depth * along + x * right + y * up;
        // The edges that are parallel to an axis have even coordinates, and the rays have odd
        // coordinates.
        let triangles = (0..4).map(|index| {
            let depth = f64::from(3 * index + rng.integer(0, 1));
            let [x, y] = [(); 2].map(|()| -2.0 * f64::from(rng.integer(0, 1)));
            let legs = [[x, y], [x + 4.0, y], [x, y + 4.0]];
            meshes::flat_triangle(legs.map(|[x, y]| at(depth, x, y)), index)
        });
        let tree = construction::median_split(triangles.collect(), 1);
        let ray = |rng: &mut Rng| {
            let [x, y] = [(); 2].map(|()| 2.0 * f64::from(rng.integer(0, 2)) - 1.0);
            let ahead = f64::from(rng.integer(1, 9));
            if rng.coin() {
                paper_ray(at(-ahead, x, y), along)
            } else {
                paper_ray(at(10.0 + ahead, x, y), -along)
            }
        };
        // In a few of these trees, no ray hits two triangles away from their edges.
        let rays = [2..=4, 1..=4, 1..=4, 0..=0].map(|counts| {
            rng.attempt(1000, |rng| {
                let ray = ray(rng);
                let ray64 = Ray64::from(&ray);
                let hits = tree.shapes.iter();
                let hits = hits.filter(|shape| scan::intersect(&ray64, shape).is_some());
                (counts.contains(&hits.count()) && decoy::is_fair(&tree, &[ray])).then_some(ray)
            })
        });
        let rays: Option<Vec<Ray>> = rays.into_iter().collect();
        Some((tree, rays?))
    })
}

/// Picks a random ray that starts outside the box. Returns `None` unless the ray clearly hits the
/// box, or clearly misses it, as `is_hit` requires.
fn box_ray(rng: &mut Rng, bounds: &Bounds, is_hit: bool) -> Option<Ray> {
    let [one, other, third] = axes(rng);
    let dir = one + 2.0 * other + 2.0 * third;
    let origin = 3.0 * whole_point(rng);
    let ray = paper_ray(origin, dir);
    let [a, b] = [bounds.min, bounds.max].map(|planes| 3.0 * (planes - origin) / dir);
    let (enter, leave) = (a.min(b).max_element(), a.max(b).min_element());
    let is_clear = enter >= 1.0 && (leave - enter).abs() >= 1.0;
    let is_as_required = bounds.span(&Ray64::from(&ray)).is_some() == is_hit;
    (is_clear && is_as_required).then_some(ray)
}

#[cfg(test)]
mod tests {
    use judging::exam::{ExpectedRows, Key};

    use super::*;
    use crate::seed::Seed;

    fn rng() -> Rng {
        Seed(1).rng("paper")
    }

    #[test]
    fn distances_are_whole_numbers_and_half_of_the_rays_miss() {
        for question in [triangle(&mut rng()), sphere(&mut rng())] {
            let Key::Table {
                rows: ExpectedRows::Hits(hits),
                ..
            } = &question.key
            else {
                panic!("{:?}", question.key);
            };
            let distances: Vec<f32> = hits.iter().flatten().map(|hit| hit.distance).collect();
            assert_eq!(distances.len(), 3);
            assert!(
                distances.iter().all(|distance| distance.fract() == 0.0),
                "{distances:?}"
            );
            assert!(hits[..3].iter().all(Option::is_some), "{hits:?}");
        }
    }

    #[test]
    fn distances_in_a_tree_are_whole_numbers_and_the_last_ray_misses() {
        let mut rng = rng();
        // About one in a hundred arrangements of triangles is rejected, so test many.
        for _ in 0..500 {
            let (tree, rays) = tree(&mut rng);
            let hits = rays.iter().map(|ray| tree.expected_hit(&Ray64::from(ray)));
            let distances: Vec<Option<f64>> = hits.map(|hit| Some(hit?.distance)).collect();
            assert!(
                matches!(distances[..], [Some(_), Some(_), Some(_), None]),
                "{distances:?}"
            );
            let mut distances = distances.into_iter().flatten();
            assert!(distances.all(|distance| distance.fract() == 0.0));
        }
    }

    #[test]
    fn times_in_a_box_are_multiples_of_one_and_a_half() {
        let (bounds, queries) = bbox(&mut rng());
        let spans = queries
            .iter()
            .map(|(ray, _)| bounds.span(&Ray64::from(ray)));
        let spans: Vec<Option<(f64, f64)>> = spans.collect();
        assert!(spans[..3].iter().all(Option::is_some) && spans[3..].iter().all(Option::is_none));
        for (enter, leave) in spans.into_iter().flatten() {
            let is_nice = |time: f64| (time / 1.5 - (time / 1.5).round()).abs() < 1e-5;
            assert!(is_nice(enter) && is_nice(leave), "{enter} {leave}");
        }
    }
}
