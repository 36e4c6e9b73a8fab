//! Task 2, step 2: spheres.

mod roots;
mod surface;

use grader::exam::{Asked, Item, Part, Task};
use protocol::{Ray, Shape};

use crate::oracle::sphere::Ball;
use crate::oracle::{Beam, scan};
use crate::seed::{Draw, Seed};

/// The items of the task `sphere`.
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 14] = [
        roots::near_side,
        roots::beside,
        roots::radius,
        roots::behind,
        roots::from_inside,
        roots::far_root,
        roots::range_max,
        roots::range_within,
        surface::position,
        surface::normal,
        surface::uv,
        surface::uv_radius,
        surface::origin_and_material,
        surface::picture,
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
