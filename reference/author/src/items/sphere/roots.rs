//! Which of the two roots counts, if any.

use grader::exam::{Asked, Item, Part};
use protocol::Ray;

use super::{asked, ball, clear, hit, inside, item, miss, passing, tables};
use crate::oracle::Beam;
use crate::seed::{Draw, Seed};

pub(super) fn near_side(seed: Seed) -> Item {
    item(
        "near_side",
        1,
        [
            "from outside, the near side is hit",
            "Of the two roots the smaller is met first. Mind that the ray's origin must be taken \
             relative to the sphere's centre.",
        ],
        tables(
            "sphere.near_side",
            seed,
            &[Part::Distance],
            &[1.0, 1.0, 1.0],
            hit,
        ),
    )
}

pub(super) fn beside(seed: Seed) -> Item {
    let mut draw = seed.draw("sphere.beside");
    let mut table = |radius: f64| {
        let ball = ball(&mut draw, radius);
        let mut rays: Vec<Ray> = (0..8).map(|_| miss(&mut draw, &ball)).collect();
        rays.extend((0..2).map(|_| hit(&mut draw, &ball)));
        // A sphere that is somewhat too large or too small is noticed by those that just pass it
        // and those that just meet it.
        for (approach, count) in [([1.15, 1.25], 4), ([0.75, 0.85], 2)] {
            rays.extend((0..count).map(|_| {
                let approach = draw.uniform(approach[0], approach[1]);
                passing(&mut draw, &ball, approach)
            }));
        }
        asked(&[], &ball, 0, draw.shuffled(rays))
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
        tables(
            "sphere.radius",
            seed,
            &[Part::Distance],
            &[0.3, 0.7, 2.0, 5.0],
            hit,
        ),
    )
}

pub(super) fn behind(seed: Seed) -> Item {
    let mut draw = seed.draw("sphere.behind");
    let mut table = |radius: f64| {
        let ball = ball(&mut draw, radius);
        let rays = (0..16).map(|i| {
            let ray = hit(&mut draw, &ball);
            if i % 2 == 0 {
                ray
            } else {
                Ray::new(ray.origin, -ray.dir)
            }
        });
        let rays = rays.collect();
        asked(&[Part::Distance], &ball, 0, rays)
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
        tables(
            "sphere.from_inside",
            seed,
            &[Part::Distance],
            &[1.0, 2.0],
            inside,
        ),
    )
}

/// Rays through a sphere, each with a range that is made of its two roots.
fn ranges(
    name: &str,
    seed: Seed,
    range: impl Fn(&mut Draw, usize, [f64; 2]) -> (f64, f64),
) -> Vec<Asked> {
    let mut draw = seed.draw(name);
    let mut table = |radius: f64| {
        let ball = ball(&mut draw, radius);
        let rays = (0..16).map(|i| {
            clear(&mut draw, &ball, |draw| {
                let ray = draw.until(|draw| {
                    let ray = hit(draw, &ball);
                    let [near, far] = ball.passage(&Beam::from(&ray)).roots;
                    (far - near > 0.4).then_some(ray)
                });
                let (min, max) = range(draw, i, ball.passage(&Beam::from(&ray)).roots);
                ray.within(min as f32, max as f32)
            })
        });
        let rays = rays.collect();
        asked(&[Part::Distance], &ball, 0, rays)
    };
    vec![table(1.0), table(2.0)]
}

pub(super) fn far_root(seed: Seed) -> Item {
    let range = |draw: &mut Draw, i: usize, [near, far]: [f64; 2]| {
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
        ranges("sphere.far_root", seed, range),
    )
}

pub(super) fn range_max(seed: Seed) -> Item {
    let range = |draw: &mut Draw, i: usize, [near, far]: [f64; 2]| {
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
        ranges("sphere.range_max", seed, range),
    )
}

pub(super) fn range_within(seed: Seed) -> Item {
    let range = |draw: &mut Draw, i: usize, [near, far]: [f64; 2]| {
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
        ranges("sphere.range_within", seed, range),
    )
}
