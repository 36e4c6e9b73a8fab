//! Task 2, step 2: spheres.

use glam::{DVec3, Vec3, dvec3};
use grader::exam::{Asked, Item, Part, Task};
use protocol::{Ray, Shape};

use super::picture;
use crate::oracle::sphere::Ball;
use crate::oracle::{Beam, scan};
use crate::seed::{Draw, Seed};

/// The items of the task `sphere`.
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 14] = [
        near_side,
        beside,
        radius,
        behind,
        from_inside,
        far_root,
        range_max,
        range_within,
        position,
        normal,
        uv,
        uv_radius,
        origin_and_material,
        picture,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

fn item(name: &str, points: u32, text: [&str; 2], questions: Vec<Asked>) -> Item {
    super::item(Task::Sphere, name, points, text, questions)
}

fn ball(draw: &mut Draw, radius: f64) -> Ball {
    Ball {
        center: draw.point(3.0).as_vec3().as_dvec3(),
        radius: f64::from(radius as f32),
    }
}

fn shape(ball: &Ball, material: u32) -> Shape {
    Shape::Sphere {
        center: ball.center.as_vec3(),
        radius: ball.radius as f32,
        material,
    }
}

/// A ray from outside that passes the centre at this distance, in radii.
fn passing(draw: &mut Draw, ball: &Ball, approach: f64) -> Ray {
    let dir = draw.direction();
    let aside = draw.across(dir) * approach * ball.radius;
    let back = ball.radius * draw.uniform(1.5, 4.0);
    super::ray(ball.center + aside - back * dir, ball.center + aside)
}

fn hit(draw: &mut Draw, ball: &Ball) -> Ray {
    let approach = draw.uniform(0.05, 0.85);
    passing(draw, ball, approach)
}

fn miss(draw: &mut Draw, ball: &Ball) -> Ray {
    let approach = draw.uniform(1.15, 2.5);
    passing(draw, ball, approach)
}

fn inside(draw: &mut Draw, ball: &Ball) -> Ray {
    let origin = ball.center + draw.direction() * draw.uniform(0.1, 0.8) * ball.radius;
    super::ray(origin, origin + draw.direction())
}

fn asked(judged: &[Part], ball: &Ball, material: u32, rays: Vec<Ray>) -> Asked {
    super::shapes(judged, vec![shape(ball, material)], rays)
}

/// Questions about a sphere of each radius: rays of some kind, and some that miss.
fn tables(
    name: &str,
    seed: Seed,
    judged: &[Part],
    radii: &[f64],
    kind: impl Fn(&mut Draw, &Ball) -> Ray,
) -> Vec<Asked> {
    let mut draw = seed.draw(name);
    let table = |&radius: &f64| {
        let ball = ball(&mut draw, radius);
        let mut rays: Vec<Ray> = (0..12)
            .map(|_| clear(&mut draw, &ball, |draw| kind(draw, &ball)))
            .collect();
        rays.extend((0..5).map(|_| miss(&mut draw, &ball)));
        asked(judged, &ball, 0, draw.shuffled(rays))
    };
    radii.iter().map(table).collect()
}

/// A ray of some kind about which there is no doubt; and no meeting so near to a pole that its
/// texture coordinates would be doubtful.
fn clear(draw: &mut Draw, ball: &Ball, mut kind: impl FnMut(&mut Draw) -> Ray) -> Ray {
    draw.until(|draw| {
        let ray = kind(draw);
        let beam = Beam::from(&ray);
        let off_poles = ball
            .meet(&beam, 0)
            .is_none_or(|met| met.normal.y.abs() < 0.97);
        (off_poles && scan::is_clear(&beam, &shape(ball, 0))).then_some(ray)
    })
}

fn near_side(seed: Seed) -> Item {
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

fn beside(seed: Seed) -> Item {
    let mut draw = seed.draw("sphere.beside");
    let mut table = |radius: f64| {
        let ball = ball(&mut draw, radius);
        let mut rays: Vec<Ray> = (0..12).map(|_| miss(&mut draw, &ball)).collect();
        rays.extend((0..4).map(|_| hit(&mut draw, &ball)));
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

fn radius(seed: Seed) -> Item {
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

fn behind(seed: Seed) -> Item {
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

fn from_inside(seed: Seed) -> Item {
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

fn far_root(seed: Seed) -> Item {
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

fn range_max(seed: Seed) -> Item {
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

fn range_within(seed: Seed) -> Item {
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

fn either(draw: &mut Draw, ball: &Ball) -> Ray {
    if draw.coin() {
        hit(draw, ball)
    } else {
        inside(draw, ball)
    }
}

fn position(seed: Seed) -> Item {
    item(
        "position",
        1,
        [
            "position is the point of the meeting, in world space",
            "It is the ray's point at the distance t. A point relative to the centre still has the \
             centre to be added.",
        ],
        tables("sphere.position", seed, &[Part::Position], &[0.8, 2.0], hit),
    )
}

fn normal(seed: Seed) -> Item {
    let judged = [Part::Normal, Part::UnitNormal];
    let outside = tables("sphere.normal", seed, &judged, &[0.5, 3.0], hit);
    let inside = tables("sphere.normal.inside", seed, &judged, &[2.0], inside);
    item(
        "normal",
        1,
        [
            "the normal points away from the centre, with length one, also from inside",
            "From the centre to the meeting, divided by its length. It belongs to the surface, not \
             to the ray: it is never flipped toward it.",
        ],
        outside.into_iter().chain(inside).collect(),
    )
}

fn uv(seed: Seed) -> Item {
    item(
        "uv",
        1,
        [
            "uv comes from the direction from the centre",
            "Sphere::uv is given: call it with the direction from the centre to the meeting, not \
             with the position or the ray's direction.",
        ],
        tables("sphere.uv", seed, &[Part::Uv], &[1.0, 1.0], hit),
    )
}

fn uv_radius(seed: Seed) -> Item {
    item(
        "uv_radius",
        1,
        [
            "uv does not depend on the radius",
            "Sphere::uv wants a direction of length one: from the centre to the meeting is a vector \
             as long as the radius.",
        ],
        tables("sphere.uv_radius", seed, &[Part::Uv], &[0.4, 2.5], either),
    )
}

fn origin_and_material(seed: Seed) -> Item {
    let mut draw = seed.draw("sphere.origin_and_material");
    let mut table = |material: u32| {
        let ball = ball(&mut draw, 1.2);
        let mut rays: Vec<Ray> = (0..6).map(|_| hit(&mut draw, &ball)).collect();
        rays.extend((0..3).map(|_| miss(&mut draw, &ball)));
        asked(&[Part::Origin, Part::Material], &ball, material, rays)
    };
    item(
        "origin_and_material",
        1,
        [
            "the answer names the ray's origin and the sphere's material",
            "Both are copied: origin from the ray that was asked, also if you moved it to the \
             sphere's centre for the sums; material from the sphere.",
        ],
        vec![table(0), table(3), table(99)],
    )
}

fn picture(seed: Seed) -> Item {
    let mut draw = seed.draw("sphere.picture");
    let mut sphere = |x: f64, y: f64, z: f64, radius: f64| {
        let center = dvec3(x, y, z) + draw.point(0.1);
        Shape::Sphere {
            center: center.as_vec3(),
            radius: radius as f32,
            material: 0,
        }
    };
    // No centre is so high or low that its sphere would show a pole.
    let from_outside = vec![
        sphere(0.2, 0.0, -5.0, 1.2),
        sphere(-1.6, 0.3, -4.0, 0.7),
        sphere(1.5, -0.2, -3.5, 0.5),
        sphere(-0.8, -0.3, -3.0, 0.45),
        sphere(2.6, 0.4, -7.0, 1.6),
    ];
    let from_inside = vec![sphere(0.0, 0.0, -0.5, 3.0), sphere(0.9, 0.1, -2.0, 0.4)];
    item(
        "picture",
        2,
        [
            "a picture of spheres is right in hit, depth, normal and uv",
            "Some seen from outside, and one from inside. If all pixels of one are wrong, see what \
             sets it apart: its radius, or where the camera is.",
        ],
        vec![
            picture::shapes(picture::from_origin(64), from_outside),
            picture::shapes(
                picture::narrow(Vec3::ZERO, DVec3::NEG_Z, 0.6, 32),
                from_inside,
            ),
        ],
    )
}
