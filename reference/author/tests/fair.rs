//! Every honest formula, in single precision, gets all points, and with room to spare.

mod solver;

use author::items::{bbox, build, camera, sphere, traverse, triangle};
use author::seed::Seed;
use glam::Vec3;
use grader::exam::{Asked, Hit, Item, Key, Part, RayPart};
use protocol::{Answer, Outcome, Ray, Trace};

use crate::solver::{Solver, boxes, cameras, spheres, triangles, walks};

const SEEDS: [u64; 4] = [2025, 1, 2, 3];

/// All items of a task but those about cost, of which the tests' own trees know nothing.
fn items(task: fn(Seed) -> Vec<Item>, seed: u64) -> Vec<Item> {
    let mut items = task(Seed(seed));
    items.retain(|item| !item.id.starts_with("build.cost") && item.id != "build.one_split");
    items
}

/// Asserts that each of these gets all points of the task, and that no answer is off by half of
/// what is tolerated; prints how far the worst is.
fn assert_fair(task: fn(Seed) -> Vec<Item>, honest: &[(&str, Solver)]) {
    for seed in SEEDS {
        let items = items(task, seed);
        for (name, solver) in honest {
            let (lost, points) = solver.losses(&items);
            assert_eq!(points, 0, "{name}, seed {seed}: {lost:?}");

            let errors = items.iter().map(|item| {
                let asked = item.questions.iter();
                let error = asked.map(|asked| error(asked, &solver.answer(&asked.question)));
                (error.fold(0.0, f64::max), &item.id)
            });
            let (worst, id) = errors
                .max_by(|a, b| a.0.total_cmp(&b.0))
                .expect("some items");
            println!("{seed:5} {name:30} {worst:.3} of what is tolerated, in {id}");
            assert!(worst < 0.5, "{name}, seed {seed}: {worst} in {id}");
        }
    }
}

#[test]
fn cameras() {
    let honest = cameras::CAMERAS.map(|(name, camera)| {
        let right = Solver::RIGHT;
        (name, Solver { camera, ..right })
    });
    assert_fair(camera::items, &honest);
}

#[test]
fn triangles() {
    let honest = triangles::TRIANGLES.map(|(name, triangle)| {
        let right = Solver::RIGHT;
        (name, Solver { triangle, ..right })
    });
    assert_fair(triangle::items, &honest);
}

#[test]
fn spheres() {
    let honest = spheres::SPHERES.map(|(name, sphere)| {
        let right = Solver::RIGHT;
        (name, Solver { sphere, ..right })
    });
    assert_fair(sphere::items, &honest);
}

#[test]
fn bounding_boxes() {
    let honest = boxes::BOXES.map(|(name, bbox)| {
        let right = Solver::RIGHT;
        (name, Solver { bbox, ..right })
    });
    assert_fair(bbox::items, &honest);
}

#[test]
fn builders() {
    assert_fair(build::items, &[("halves", Solver::RIGHT)]);
}

#[test]
fn walks() {
    let honest = walks::whole::WALKS.map(|(name, walk)| {
        let right = Solver::RIGHT;
        (name, Solver { walk, ..right })
    });
    assert_fair(traverse::items, &honest);
}

/// The worst error of all answers, by what is tolerated; infinite for a hit that should be a miss.
fn error(asked: &Asked, answer: &Answer) -> f64 {
    match (&asked.key, answer) {
        (Key::Rays { judged, directions }, Answer::Rays(rays)) => {
            worst(directions.iter().zip(rays).map(|(direction, ray)| {
                let ray = value(ray);
                judged
                    .iter()
                    .map(|part| ray_error(*part, ray, *direction))
                    .fold(0.0, f64::max)
            }))
        }
        (Key::Hits { judged, hits }, Answer::Hits(answers)) => {
            worst(hits.iter().zip(answers).map(|(hit, got)| {
                match (hit, value(got)) {
                    (None, None) => 0.0,
                    (Some(hit), Some(trace)) => judged
                        .iter()
                        .map(|part| hit_error(*part, trace, hit))
                        .fold(0.0, f64::max),
                    (None, Some(_)) | (Some(_), None) => f64::INFINITY,
                }
            }))
        }
        (Key::Spans { spans }, Answer::Spans(answers)) => worst(spans.iter().zip(answers).map(
            |(span, got)| match (span, value(got)) {
                (None, None) => 0.0,
                (Some(span), Some(got)) => length(got.min, span.min).max(length(got.max, span.max)),
                (None, Some(_)) | (Some(_), None) => f64::INFINITY,
            },
        )),
        // Counted, not measured: the other test asks the judge.
        (Key::FirstHits { .. } | Key::Tree { .. }, _) => 0.0,
        (key, answer) => panic!("{answer:?} is no answer to {key:?}"),
    }
}

fn worst(errors: impl Iterator<Item = f64>) -> f64 {
    errors.fold(0.0, f64::max)
}

fn value<T>(outcome: &Outcome<T>) -> &T {
    match outcome {
        Outcome::Value(value) => value,
        Outcome::Panicked(_) | Outcome::GivenUp => unreachable!("the tests' solvers answer"),
    }
}

fn length(got: f32, wanted: f32) -> f64 {
    if got == wanted {
        return 0.0;
    }
    f64::from((got - wanted).abs() / wanted.abs().max(1.0)) / 1e-4
}

fn direction(got: Vec3, wanted: Vec3) -> f64 {
    let unit = got.as_dvec3().normalize();
    unit.distance(wanted.as_dvec3()) / 1e-3
}

fn ray_error(part: RayPart, ray: &Ray, wanted: Vec3) -> f64 {
    match part {
        RayPart::Origin => f64::from(ray.origin.length()) / 1e-4,
        RayPart::Direction => direction(ray.dir, wanted),
        RayPart::UnitLength => f64::from((ray.dir.length() - 1.0).abs()) / 1e-3,
        RayPart::Range => 0.0,
    }
}

fn hit_error(part: Part, trace: &Trace, hit: &Hit) -> f64 {
    let point =
        |got: Vec3, wanted: Vec3| f64::from(got.distance(wanted) / wanted.length().max(1.0)) / 1e-4;
    match part {
        Part::Distance => length(trace.distance, hit.distance),
        Part::Position => point(trace.position, hit.position),
        Part::Normal => direction(trace.normal, hit.normal),
        Part::UnitNormal => f64::from((trace.normal.length() - 1.0).abs()) / 1e-3,
        Part::Uv => {
            let u = (trace.uv.x - hit.uv.x).abs();
            let v = (trace.uv.y - hit.uv.y).abs();
            f64::from(u.min((1.0 - u).abs()).max(v)) / 2e-3
        }
        Part::Origin | Part::Material => 0.0,
    }
}
