//! Which of the two roots counts, if any.

use grader::exam::{ExamQuestion, HitCheck, Item};
use protocol::Ray;

use super::{
    hitting_ray, item, missing_ray, random_sphere, ray_from_inside, ray_passing_at,
    sphere_question, table_questions, unambiguous_ray,
};
use crate::oracle::Ray64;
use crate::seed::{Rng, Seed};

pub(super) fn near_side(seed: Seed) -> Item {
    item(
        "near_side",
        1,
        [
            "from outside, the near side is hit",
            "Of the two roots the smaller is met first. Mind that the ray's origin must be taken \
             relative to the sphere's centre.",
        ],
        table_questions(
            "sphere.near_side",
            seed,
            &[HitCheck::Distance],
            &[1.0, 1.0, 1.0],
            hitting_ray,
        ),
    )
}

pub(super) fn beside(seed: Seed) -> Item {
    let mut draw = seed.rng("sphere.beside");
    let mut table = |radius: f64| {
        let ball = random_sphere(&mut draw, radius);
        let mut rays: Vec<Ray> = (0..8).map(|_| missing_ray(&mut draw, &ball)).collect();
        rays.extend((0..2).map(|_| hitting_ray(&mut draw, &ball)));
        // A sphere that is somewhat too large or too small is noticed by those that just pass it
        // and those that just meet it.
        for (approach, count) in [([1.15, 1.25], 4), ([0.75, 0.85], 2)] {
            rays.extend((0..count).map(|_| {
                let approach = draw.uniform(approach[0], approach[1]);
                ray_passing_at(&mut draw, &ball, approach)
            }));
        }
        sphere_question(&[], &ball, 0, draw.shuffled(rays))
    };
    item(
        "beside",
        1,
        [
            "a ray that passes beside the sphere misses it",
            "Then the quadratic has no real root: look at what stands below the square root before \
             you take it.",
        ],
        vec![table(1.0), table(0.6), table(2.0)],
    )
}

pub(super) fn radius(seed: Seed) -> Item {
    item(
        "radius",
        1,
        [
            "spheres of any radius are hit where they are",
            "The radius comes into the quadratic's c, squared.",
        ],
        table_questions(
            "sphere.radius",
            seed,
            &[HitCheck::Distance],
            &[0.3, 0.7, 2.0, 5.0],
            hitting_ray,
        ),
    )
}

pub(super) fn behind(seed: Seed) -> Item {
    let mut draw = seed.rng("sphere.behind");
    let mut table = |radius: f64| {
        let ball = random_sphere(&mut draw, radius);
        let rays = (0..16).map(|i| {
            let ray = hitting_ray(&mut draw, &ball);
            if i % 2 == 0 {
                ray
            } else {
                Ray::new(ray.origin, -ray.dir)
            }
        });
        let rays = rays.collect();
        sphere_question(&[HitCheck::Distance], &ball, 0, rays)
    };
    item(
        "behind",
        1,
        [
            "a sphere behind the ray is missed",
            "There both roots are negative, and so outside of ray.range.",
        ],
        vec![table(1.0), table(1.5)],
    )
}

pub(super) fn from_inside(seed: Seed) -> Item {
    item(
        "from_inside",
        1,
        [
            "from inside, the far side is hit",
            "The near root is negative there, the far one is not: see which of them lies in \
             ray.range. Both t and everything that follows from it are the far one's.",
        ],
        table_questions(
            "sphere.from_inside",
            seed,
            &[HitCheck::Distance],
            &[1.0, 2.0],
            ray_from_inside,
        ),
    )
}

/// Rays through a sphere, each with a range that is made of its two roots.
fn range_questions(
    name: &str,
    seed: Seed,
    range: impl Fn(&mut Rng, usize, [f64; 2]) -> (f64, f64),
) -> Vec<ExamQuestion> {
    let mut draw = seed.rng(name);
    let mut table = |radius: f64| {
        let ball = random_sphere(&mut draw, radius);
        let rays = (0..16).map(|i| {
            unambiguous_ray(&mut draw, &ball, |draw| {
                let ray = draw.retry(|draw| {
                    let ray = hitting_ray(draw, &ball);
                    let [near, far] = ball.intersect_line(&Ray64::from(&ray)).roots;
                    (far - near > 0.4).then_some(ray)
                });
                let (min, max) = range(draw, i, ball.intersect_line(&Ray64::from(&ray)).roots);
                ray.within(min as f32, max as f32)
            })
        });
        let rays = rays.collect();
        sphere_question(&[HitCheck::Distance], &ball, 0, rays)
    };
    vec![table(1.0), table(2.0)]
}

pub(super) fn far_root(seed: Seed) -> Item {
    let range = |draw: &mut Rng, i: usize, [near, far]: [f64; 2]| {
        // Begins before the sphere, within it, or behind it.
        let from = match i % 3 {
            0 => draw.uniform(0.0, near - 0.05),
            1 => draw.uniform(near + 0.05, far - 0.05),
            _ => far + 0.05,
        };
        (from, far + draw.uniform(0.1, 3.0))
    };
    item(
        "far_root",
        1,
        [
            "if the near side lies before the range, the far side is hit",
            "The range's start need not be 0. The near root outside and the far one inside: the far \
             one counts.",
        ],
        range_questions("sphere.far_root", seed, range),
    )
}

pub(super) fn range_max(seed: Seed) -> Item {
    let range = |draw: &mut Rng, i: usize, [near, far]: [f64; 2]| {
        // Ends before the sphere, within it, or behind it.
        let max = match i % 3 {
            0 => near - draw.uniform(0.03, 0.3),
            1 => draw.uniform(near + 0.05, far - 0.05),
            _ => far + draw.uniform(0.05, 1.0),
        };
        (0.0, max)
    };
    item(
        "range_max",
        1,
        [
            "only what is met before the end of the range counts",
            "A ray that ends inside the sphere still hits its near side: each root is looked at by \
             itself.",
        ],
        range_questions("sphere.range_max", seed, range),
    )
}

pub(super) fn range_within(seed: Seed) -> Item {
    let range = |draw: &mut Rng, i: usize, [near, far]: [f64; 2]| {
        let size = far - near;
        // Between the roots, behind both, or around the first.
        match i % 3 {
            0 => (near + 0.1 * size, far - draw.uniform(0.1, 0.3) * size),
            1 => (far + 0.05, far + draw.uniform(1.0, 3.0)),
            _ => (near - 0.1, near + 0.5 * size),
        }
    };
    item(
        "range_within",
        1,
        [
            "a range that holds neither side is a miss",
            "Between the roots the ray is inside the sphere, and meets nothing; beyond both it has \
             left it.",
        ],
        range_questions("sphere.range_within", seed, range),
    )
}
