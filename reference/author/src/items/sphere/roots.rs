//! Items about which of the two roots counts, if any.

use judging::exam::ExamQuestion;
use protocol::Ray;

use super::{
    hitting_ray, missing_ray, placed_questions, random_sphere, ray_from_inside, ray_passing_at,
    sphere_question, table_questions, unambiguous_ray,
};
use crate::items::place::dust;
use crate::items::{Declaration, groups, reversed_if};
use crate::oracle::Ray64;
use crate::seed::Rng;

pub(super) const NEAR_SIDE: Declaration = Declaration {
    id: "sphere.near_side",
    title: "from outside, the near side is hit",
    look: "Work out both roots by hand for the ray shown, with one form of the formula from start \
           to end, and compare them with those in your code. From outside, the smaller root is the \
           distance; a negative discriminant is a miss.",
    section: "sphere.md#the-quadratic-equation",
    questions: |rng| table_questions(rng, &["distance"], &[1.0, 1.0, 1.0], hitting_ray),
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const BESIDE: Declaration = Declaration {
    id: "sphere.beside",
    title: "a ray that passes beside the sphere misses it",
    look: "Without a real root there is no hit, and with two there may be one: work out the value \
           under the square root for the ray shown, before you take the root.",
    section: "sphere.md#the-square-root-of-a-negative-number",
    questions: |rng| {
        let mut table = |radius: f64| {
            let sphere = random_sphere(rng, radius);
            let mut rays: Vec<Ray> = (0..8).map(|_| missing_ray(rng, &sphere)).collect();
            rays.extend((0..2).map(|_| hitting_ray(rng, &sphere)));
            // Rays that barely miss and rays that barely hit reveal a sphere that is slightly too large
            // or too small.
            for (approach, count) in [([1.15, 1.25], 4), ([0.75, 0.85], 2)] {
                rays.extend((0..count).map(|_| {
                    let approach = rng.uniform(approach[0], approach[1]);
                    ray_passing_at(rng, &sphere, approach)
                }));
            }
            sphere_question(&[], &sphere, 0, rng.shuffled(rays))
        };
        vec![table(1.0), table(0.6), table(2.0)]
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const RADIUS: Declaration = Declaration {
    id: "sphere.radius",
    title: "spheres of any radius are hit at the right distance",
    look: "The square of the radius is part of the quadratic's c. Spheres can be tiny, and so can \
           distances: compare each root with ray.range, not with a small constant.",
    section: "sphere.md#the-radius-is-not-always-one",
    questions: |rng| {
        let (judged, radii) = (["distance"], [0.3, 0.7, 2.0, 5.0]);
        let [placed, tiny] =
            &mut ["sphere.radius.placed", "sphere.radius.tiny"].map(|it| rng.sequence(it));
        let tiny = table_questions(tiny, &judged, &[1.0], hitting_ray);
        let mut questions = table_questions(rng, &judged, &radii, hitting_ray);
        questions.extend(placed_questions(placed, &judged, hitting_ray));
        questions.extend(tiny.into_iter().map(dust));
        questions
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const BEHIND: Declaration = Declaration {
    id: "sphere.behind",
    title: "a sphere behind the ray is missed",
    look: "Behind the ray both roots are negative, and so outside ray.range; ahead of it both are \
           positive. Work out both for the ray shown.",
    section: "sphere.md#the-near-root-can-be-out-of-range",
    questions: |rng| {
        let mut table = |radius: f64| {
            let sphere = random_sphere(rng, radius);
            let rays = (0..16).map(|i| reversed_if(i % 2 == 1, hitting_ray(rng, &sphere)));
            sphere_question(&["distance"], &sphere, 0, rays)
        };
        vec![table(1.0), table(1.5)]
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const FROM_INSIDE: Declaration = Declaration {
    id: "sphere.from_inside",
    title: "from inside, the far side is hit",
    look: "In every direction from inside, the near root is negative and the far one is positive. \
           Nothing but the roots and ray.range decides whether there is a hit, and the root that \
           is in the range is its distance.",
    section: "sphere.md#the-near-root-can-be-out-of-range",
    questions: |rng| {
        let (judged, placed) = (["distance"], &mut rng.sequence("sphere.from_inside.placed"));
        let near = table_questions(rng, &judged, &[1.0, 2.0], ray_from_inside);
        [near, placed_questions(placed, &judged, ray_from_inside)].concat()
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

/// Creates questions with rays through a sphere, where `range` computes each ray's range from its
/// index and its two roots.
fn range_questions(
    rng: &mut Rng,
    range: impl Fn(&mut Rng, usize, [f64; 2]) -> (f64, f64),
) -> Vec<ExamQuestion> {
    let mut table = |radius: f64| {
        let sphere = random_sphere(rng, radius);
        let rays = (0..16).map(|i| {
            unambiguous_ray(rng, &sphere, |rng| {
                let ray = rng.retry(|rng| {
                    let ray = hitting_ray(rng, &sphere);
                    let [near, far] = sphere.intersect_line(&Ray64::from(&ray)).roots;
                    (far - near > 0.4).then_some(ray)
                });
                let (min, max) = range(rng, i, sphere.intersect_line(&Ray64::from(&ray)).roots);
                ray.within(min as f32, max as f32)
            })
        });
        sphere_question(&["distance"], &sphere, 0, rays)
    };
    vec![table(1.0), table(2.0), dust(table(1.0))]
}

/// Creates a question with rays that go on from a hit, as through glass: those that have entered the
/// sphere hit its far side, and those that have left it miss.
fn rays_from_the_surface(rng: &mut Rng) -> ExamQuestion {
    let sphere = random_sphere(rng, 1.5);
    let rays = (0..12).map(|i| {
        let ray = hitting_ray(rng, &sphere);
        let ray64 = Ray64::from(&ray);
        let origin = ray64
            .at(sphere.intersect_line(&ray64).roots[i % 2])
            .as_vec3();
        Ray { origin, ..ray }.within(0.05, f32::INFINITY)
    });
    sphere_question(&["distance"], &sphere, 0, rays)
}

pub(super) const FAR_ROOT: Declaration = Declaration {
    id: "sphere.far_root",
    title: "if the near side is before the range, the far side is hit",
    look: "The range need not start at 0. If the near root is outside the range and the far root \
           is inside, the far root counts.",
    section: "sphere.md#the-near-root-can-be-out-of-range",
    questions: |rng| {
        let range = |rng: &mut Rng, i: usize, [near, far]: [f64; 2]| {
            // The range starts before the sphere, inside it, or behind it.
            let from = match i % 3 {
                0 => rng.uniform(0.0, near - 0.05),
                1 => rng.uniform(near + 0.05, far - 0.05),
                _ => far + 0.05,
            };
            (from, far + rng.uniform(0.1, 3.0))
        };
        let from_the_surface = &mut rng.sequence("sphere.rays_from_the_surface");
        let mut questions = range_questions(rng, range);
        questions.push(rays_from_the_surface(from_the_surface));
        questions
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const RANGE_MAX: Declaration = Declaration {
    id: "sphere.range_max",
    title: "only hits before the end of the range count",
    look: "Compare each root by itself with both ends of ray.range. The ray can end before the \
           sphere, inside it or behind it: which of the two roots are in the range of the ray \
           shown?",
    section: "sphere.md#check-each-root-by-itself",
    questions: |rng| {
        let range = |rng: &mut Rng, i: usize, [near, far]: [f64; 2]| {
            // The range ends before the sphere, inside it, or behind it.
            let max = match i % 3 {
                0 => near - rng.uniform(0.03, 0.3),
                1 => rng.uniform(near + 0.05, far - 0.05),
                _ => far + rng.uniform(0.05, 1.0),
            };
            (0.0, max)
        };
        range_questions(rng, range)
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};

pub(super) const RANGE_WITHIN: Declaration = Declaration {
    id: "sphere.range_within",
    title: "a ray whose range contains neither root misses",
    look: "Between the roots the ray is inside the sphere and hits nothing; beyond both it has \
           left the sphere. A root is a hit if and only if it is in ray.range, however small it \
           is.",
    section: "sphere.md#check-each-root-by-itself",
    questions: |rng| {
        let range = |rng: &mut Rng, i: usize, [near, far]: [f64; 2]| {
            let size = far - near;
            // The range is between the roots, behind both, or around the first one.
            match i % 3 {
                0 => (near + 0.1 * size, far - rng.uniform(0.1, 0.3) * size),
                1 => (far + 0.05, far + rng.uniform(1.0, 3.0)),
                _ => (near - 0.1, near + 0.5 * size),
            }
        };
        range_questions(rng, range)
    },
    ..Declaration::in_group(groups::SPHERE_HITS)
};
