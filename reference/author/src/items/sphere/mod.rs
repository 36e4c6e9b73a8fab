//! Items of task 2, step 2: spheres.

mod roots;
mod surface;

use judging::exam::ExamQuestion;
use protocol::{Ray, Shape};

use crate::items::place::Place;
use crate::items::{DeclaredItem, draw_items};
use crate::oracle::sphere::Sphere;
use crate::oracle::{Ray64, scan};
use crate::seed::{Rng, Seed};

/// Returns the items of the task `sphere`.
pub fn items(seed: Seed) -> Vec<DeclaredItem> {
    let all = [
        roots::NEAR_SIDE,
        roots::BESIDE,
        roots::RADIUS,
        roots::BEHIND,
        roots::FROM_INSIDE,
        roots::FAR_ROOT,
        roots::RANGE_MAX,
        roots::RANGE_WITHIN,
        surface::POSITION,
        surface::NORMAL,
        surface::UV,
        surface::UV_RADIUS,
        surface::ORIGIN_AND_MATERIAL,
        surface::PICTURE,
    ];
    draw_items(seed, &all)
}

fn random_sphere(rng: &mut Rng, radius: f64) -> Sphere {
    Sphere {
        center: rng.point(3.0).as_vec3().as_dvec3(),
        radius: f64::from(radius as f32),
    }
}

fn shape(sphere: &Sphere, shape: u32) -> Shape {
    Shape::Sphere {
        center: sphere.center.as_vec3(),
        radius: sphere.radius as f32,
        shape,
    }
}

/// Returns a ray from outside that passes the centre at a distance of `approach` radii.
fn ray_passing_at(rng: &mut Rng, sphere: &Sphere, approach: f64) -> Ray {
    let dir = rng.direction();
    let offset = rng.perpendicular_to(dir) * approach * sphere.radius;
    let back = sphere.radius * rng.uniform(1.5, 4.0);
    super::ray(sphere.center + offset - back * dir, sphere.center + offset)
}

fn hitting_ray(rng: &mut Rng, sphere: &Sphere) -> Ray {
    let approach = rng.uniform(0.05, 0.85);
    ray_passing_at(rng, sphere, approach)
}

fn missing_ray(rng: &mut Rng, sphere: &Sphere) -> Ray {
    let approach = rng.uniform(1.15, 2.5);
    ray_passing_at(rng, sphere, approach)
}

fn ray_from_inside(rng: &mut Rng, sphere: &Sphere) -> Ray {
    let origin = sphere.center + rng.direction() * rng.uniform(0.1, 0.8) * sphere.radius;
    super::ray(origin, origin + rng.direction())
}

fn sphere_question(
    judged: &[&str],
    sphere: &Sphere,
    number: u32,
    rays: impl IntoIterator<Item = Ray>,
) -> ExamQuestion {
    super::shape_question(judged, shape(sphere, number), rays)
}

/// Creates one question per radius, with rays of one kind and some rays that miss.
fn table_questions(
    rng: &mut Rng,
    judged: &[&str],
    radii: &[f64],
    kind: impl Fn(&mut Rng, &Sphere) -> Ray,
) -> Vec<ExamQuestion> {
    let table = |&radius: &f64| {
        let sphere = random_sphere(rng, radius);
        let rays = hits_and_misses(rng, &sphere, [12, 5], &kind);
        sphere_question(judged, &sphere, 0, rng.shuffled(rays))
    };
    radii.iter().map(table).collect()
}

/// Creates the same questions as [`table_questions`], about a sphere that is as large and as far
/// from the origin as things in the Cornell box, and about one with a radius of a hundredth.
fn placed_questions(
    rng: &mut Rng,
    judged: &[&str],
    kind: impl Fn(&mut Rng, &Sphere) -> Ray,
) -> Vec<ExamQuestion> {
    let places: [fn(&mut Rng) -> Place; 2] = [Place::room, Place::miniature];
    let question = |place: fn(&mut Rng) -> Place| {
        let sphere = random_sphere(rng, 1.0);
        let rays = hits_and_misses(rng, &sphere, [8, 4], &kind);
        let place = place(rng);
        let (shape, rays) = place.table(&(shape(&sphere, 0), rng.shuffled(rays)));
        super::shape_question(judged, shape, rays)
    };
    places.map(question).into()
}

/// Returns so many rays of one kind, followed by so many that miss.
fn hits_and_misses(
    rng: &mut Rng,
    sphere: &Sphere,
    [hits, misses]: [usize; 2],
    kind: impl Fn(&mut Rng, &Sphere) -> Ray,
) -> Vec<Ray> {
    let hits = (0..hits).map(|_| unambiguous_ray(rng, sphere, |rng| kind(rng, sphere)));
    let mut rays: Vec<Ray> = hits.collect();
    rays.extend((0..misses).map(|_| missing_ray(rng, sphere)));
    rays
}

/// Returns an unambiguous ray of one kind. It does not hit the sphere near a pole, where texture
/// coordinates are sensitive to rounding.
fn unambiguous_ray(rng: &mut Rng, sphere: &Sphere, mut kind: impl FnMut(&mut Rng) -> Ray) -> Ray {
    rng.retry(|rng| {
        let ray = kind(rng);
        let ray64 = Ray64::from(&ray);
        let is_off_poles = sphere
            .intersect(&ray64, 0)
            .is_none_or(|hit| hit.normal.y.abs() < 0.97);
        (is_off_poles && scan::is_unambiguous(&ray64, &shape(sphere, 0))).then_some(ray)
    })
}
