//! Task 2, step 2: spheres.

mod roots;
mod surface;

use grader::exam::{ExamQuestion, HitCheck, Item, Task};
use protocol::{Ray, Shape};

use crate::oracle::sphere::Sphere;
use crate::oracle::{Ray64, scan};
use crate::seed::{Rng, Seed};

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

fn item(name: &str, points: u32, text: [&str; 2], questions: Vec<ExamQuestion>) -> Item {
    super::item(Task::Sphere, name, points, text, questions)
}

fn random_sphere(draw: &mut Rng, radius: f64) -> Sphere {
    Sphere {
        center: draw.point(3.0).as_vec3().as_dvec3(),
        radius: f64::from(radius as f32),
    }
}

fn shape(ball: &Sphere, material: u32) -> Shape {
    Shape::Sphere {
        center: ball.center.as_vec3(),
        radius: ball.radius as f32,
        material,
    }
}

/// A ray from outside that passes the centre at this distance, in radii.
fn ray_passing_at(draw: &mut Rng, ball: &Sphere, approach: f64) -> Ray {
    let dir = draw.direction();
    let aside = draw.perpendicular_to(dir) * approach * ball.radius;
    let back = ball.radius * draw.uniform(1.5, 4.0);
    super::ray(ball.center + aside - back * dir, ball.center + aside)
}

fn hitting_ray(draw: &mut Rng, ball: &Sphere) -> Ray {
    let approach = draw.uniform(0.05, 0.85);
    ray_passing_at(draw, ball, approach)
}

fn missing_ray(draw: &mut Rng, ball: &Sphere) -> Ray {
    let approach = draw.uniform(1.15, 2.5);
    ray_passing_at(draw, ball, approach)
}

fn ray_from_inside(draw: &mut Rng, ball: &Sphere) -> Ray {
    let origin = ball.center + draw.direction() * draw.uniform(0.1, 0.8) * ball.radius;
    super::ray(origin, origin + draw.direction())
}

fn sphere_question(
    judged: &[HitCheck],
    ball: &Sphere,
    material: u32,
    rays: Vec<Ray>,
) -> ExamQuestion {
    super::shapes_question(judged, vec![shape(ball, material)], rays)
}

/// Questions about a sphere of each radius: rays of some kind, and some that miss.
fn table_questions(
    name: &str,
    seed: Seed,
    judged: &[HitCheck],
    radii: &[f64],
    kind: impl Fn(&mut Rng, &Sphere) -> Ray,
) -> Vec<ExamQuestion> {
    let mut draw = seed.rng(name);
    let table = |&radius: &f64| {
        let ball = random_sphere(&mut draw, radius);
        let mut rays: Vec<Ray> = (0..12)
            .map(|_| unambiguous_ray(&mut draw, &ball, |draw| kind(draw, &ball)))
            .collect();
        rays.extend((0..5).map(|_| missing_ray(&mut draw, &ball)));
        sphere_question(judged, &ball, 0, draw.shuffled(rays))
    };
    radii.iter().map(table).collect()
}

/// A ray of some kind about which there is no doubt; and no meeting so near to a pole that its
/// texture coordinates would be doubtful.
fn unambiguous_ray(draw: &mut Rng, ball: &Sphere, mut kind: impl FnMut(&mut Rng) -> Ray) -> Ray {
    draw.retry(|draw| {
        let ray = kind(draw);
        let beam = Ray64::from(&ray);
        let off_poles = ball
            .intersect(&beam, 0)
            .is_none_or(|met| met.normal.y.abs() < 0.97);
        (off_poles && scan::is_unambiguous(&beam, &shape(ball, 0))).then_some(ray)
    })
}
