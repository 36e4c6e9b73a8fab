//! Every honest formula, in single precision, gets all points, and with room to spare.

mod solver;

use author::items::{bbox, build, camera, sphere, traverse, triangle};
use author::seed::Seed;
use grader::exam::{Asked, Item};
use grader::judge::measure;
use protocol::Answer;

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

/// How far off an answer is, in all that the judge holds against it.
fn error(asked: &Asked, answer: &Answer) -> f64 {
    let measured = measure(asked, answer).into_iter();
    measured
        .flat_map(|measured| [Some(measured.off), measured.count])
        .flatten()
        .fold(0.0, |worst, deviation| worst.max(deviation.value))
}
