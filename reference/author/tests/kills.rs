//! Every known mistake loses points in its own task; and the table says in which items. With
//! `-- --nocapture` it is printed.

mod solver;

use author::items::{bbox, build, camera, sphere, traverse, triangle};
use author::seed::Seed;
use grader::exam::Item;

use crate::solver::{Solver, boxes, cameras, spheres, trees, triangles, walks};

const SEEDS: [u64; 2] = [2025, 11];

/// Asserts that each of these loses at least a point with any seed, and prints where.
fn assert_killed<'a>(
    items: fn(Seed) -> Vec<Item>,
    wrong: impl Iterator<Item = (&'a str, Solver)> + Clone,
) {
    for seed in SEEDS {
        let items = items(Seed(seed));
        for (name, solver) in wrong.clone() {
            let (lost, points) = solver.losses(&items);
            println!("{seed:5} {name:45} −{points:2}  {}", lost.join(" "));
            assert!(points > 0, "with seed {seed}, \"{name}\" costs nothing");
        }
    }
}

/// Asserts that this solver gets nothing.
fn assert_nothing(items: fn(Seed) -> Vec<Item>, name: &str, solver: Solver) {
    for seed in SEEDS {
        for item in items(Seed(seed)) {
            assert_eq!(solver.points(&item), 0, "{name} passes {}", item.id);
        }
    }
}

#[test]
fn cameras() {
    let with = |camera| Solver {
        camera,
        ..Solver::RIGHT
    };
    assert_killed(
        camera::items,
        cameras::WRONG_CAMERAS
            .into_iter()
            .map(|(name, wrong)| (name, with(wrong))),
    );
    assert_nothing(
        camera::items,
        "straight ahead",
        with(cameras::WRONG_CAMERAS[0].1),
    );
}

#[test]
fn triangles() {
    let with = |triangle| Solver {
        triangle,
        ..Solver::RIGHT
    };
    let wrong = triangles::WRONG_TRIANGLES;
    assert_killed(
        triangle::items,
        wrong.into_iter().map(|(name, wrong)| (name, with(wrong))),
    );
    assert_nothing(triangle::items, "never", with(wrong[0].1));
}

#[test]
fn spheres() {
    let with = |sphere| Solver {
        sphere,
        ..Solver::RIGHT
    };
    let wrong = spheres::WRONG_SPHERES;
    assert_killed(
        sphere::items,
        wrong.into_iter().map(|(name, wrong)| (name, with(wrong))),
    );
    assert_nothing(sphere::items, "never", with(wrong[0].1));
}

#[test]
fn a_constant_hit_passes_nothing() {
    let triangle: triangles::TriangleHit = |ray, vertices, material| {
        let target = (vertices[0].position + vertices[1].position + vertices[2].position) / 3.0;
        let [.., (_, hit)] = triangles::TRIANGLES;
        hit(
            &protocol::Ray::new(ray.origin, target - ray.origin),
            vertices,
            material,
        )
    };
    let sphere: spheres::SphereHit = |ray, center, radius, material| {
        let [(_, hit), ..] = spheres::SPHERES;
        hit(
            &protocol::Ray::new(ray.origin, center - ray.origin),
            center,
            radius,
            material,
        )
    };
    let solver = Solver {
        triangle,
        sphere,
        ..Solver::RIGHT
    };
    assert_nothing(triangle::items, "always", solver);
    assert_nothing(sphere::items, "always", solver);
}

#[test]
fn bounding_boxes() {
    let with = |bbox| Solver {
        bbox,
        ..Solver::RIGHT
    };
    let wrong = boxes::WRONG_BOXES;
    assert_killed(
        bbox::items,
        wrong.into_iter().map(|(name, wrong)| (name, with(wrong))),
    );
    assert_nothing(bbox::items, "never", with(wrong[0].1));
    assert_nothing(bbox::items, "always", with(wrong[1].1));
}

#[test]
fn builders() {
    let with = |build| Solver {
        build,
        ..Solver::RIGHT
    };
    let wrong = trees::WRONG_TREES;
    assert_killed(
        build::items,
        wrong.into_iter().map(|(name, wrong)| (name, with(wrong))),
    );
    for (name, wrong) in &wrong[..3] {
        assert_nothing(build::items, name, with(*wrong));
    }
}

#[test]
fn walks() {
    let with = |walk| Solver {
        walk,
        ..Solver::RIGHT
    };
    let wrong = walks::wrong::WRONG_WALKS;
    assert_killed(
        traverse::items,
        wrong.into_iter().map(|(name, wrong)| (name, with(wrong))),
    );
    for (name, wrong) in &wrong[..2] {
        assert_nothing(traverse::items, name, with(*wrong));
    }
}

#[test]
fn the_slides_pseudo_code_to_the_letter_costs_a_little() {
    for seed in SEEDS {
        let items = traverse::items(Seed(seed));
        let (name, walk) = walks::whole::SLIDES;
        let (lost, points) = Solver {
            walk,
            ..Solver::RIGHT
        }
        .losses(&items);
        println!("{seed:5} {name:45} −{points:2}  {}", lost.join(" "));
        assert!((1..=6).contains(&points), "{points}: {lost:?}");
    }
}
