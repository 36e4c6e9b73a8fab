//! Measures closest hits per second and build times of the reference, the variant `wide`, the
//! crates `obvhs` and `bvh`, and Embree, if its library is available. These contenders take turns
//! on one thread and must find the same hits. Only CPU time is measured. ../README.md describes how
//! to run this benchmark and lists the results.

use std::rc::Rc;
use std::time::Duration;

use reference::bvh::Bvh;
use reference::primitive::Primitive;
use variants::bvh::wide;

use crate::contenders::{Contender, CrateBvhTree, MAX_LEAF_SIZE, Obvhs, Traversed};
use crate::cost::timed;
use crate::embree::Embree;
use crate::mesh::{Mesh, meshes};
use crate::rays::Rays;
use crate::report::Report;

mod contenders;
mod cost;
mod embree;
mod mesh;
#[path = "../numbers.rs"]
mod numbers;
mod rays;
mod report;

/// The default number of rounds. In each round, every contender builds its tree and traces all
/// rays. The variable `ROUNDS` overrides this number.
const ROUNDS: usize = 5;

/// The width and height of the picture, in pixels.
const SIDE: u32 = 512;
/// The width and height for the short form of the benchmark.
const SHORT_SIDE: u32 = 32;

/// The number of rays a contender traces before it is the next contender's turn. The number is
/// small enough (a few milliseconds) that a temporary slowdown of the machine affects all
/// contenders, and large enough that the caches fill with the contender's own data.
const RAYS_PER_TURN: usize = 1 << 15;

fn main() {
    // In the short form, all that matters is whether the hits agree.
    let is_short = std::env::args().any(|argument| argument == "--check");
    let (rounds, side) = if is_short {
        (1, SHORT_SIDE)
    } else {
        (ROUNDS, SIDE)
    };
    let rounds =
        std::env::var("ROUNDS").map_or(rounds, |text| text.parse().expect("ROUNDS is a number"));
    let embree = Embree::open();
    if embree.is_none() {
        println!("EMBREE is not set: leaving out Embree");
    }
    for mesh in meshes() {
        println!(
            "\n{}, {} triangles, median of {rounds} rounds",
            mesh.name,
            mesh.corners.len()
        );
        let mut report = Report::default();
        let trees = build_trees(&mesh, embree.as_ref(), rounds, &mut report);
        let rays = rays::all_kinds(&mesh, &trees.reference, side);
        let contenders = trees.contenders();
        for rays in &rays {
            measure_rays(&contenders, rays, rounds, &mut report);
        }
        println!("{report}");
    }
}

/// The trees, one for each contender.
struct Trees<'a> {
    reference: Bvh,
    others: Vec<(&'static str, Box<dyn Contender + 'a>)>,
}

impl Trees<'_> {
    fn contenders(&self) -> Vec<(&'static str, &dyn Contender)> {
        let others = self.others.iter();
        let others = others.map(|(name, tree)| (*name, tree.as_ref()));
        [("reference", &self.reference as &dyn Contender)]
            .into_iter()
            .chain(others)
            .collect()
    }
}

/// Builds all trees once per round and reports the times. Returns the trees from the last round.
fn build_trees<'a>(
    mesh: &Mesh,
    embree: Option<&'a Embree>,
    rounds: usize,
    report: &mut Report,
) -> Trees<'a> {
    let primitives: Vec<Primitive> = mesh.shapes().map(|shape| Primitive::new(&shape)).collect();
    let triangles = Obvhs::triangles(&mesh.corners);
    let mut times = Vec::new();
    let mut trees = None;
    for _ in 0..rounds {
        drop(trees.take());
        let input = primitives.clone();
        let (reference, time) = timed(|| Bvh::build(input, MAX_LEAF_SIZE));
        let mut round = vec![("reference", time)];
        let mut others: Vec<(&'static str, Box<dyn Contender>)> = Vec::new();

        let input = primitives.clone();
        let (tree, time) = timed(|| wide::Bvh::build(input, MAX_LEAF_SIZE));
        others.push(("wide", Box::new(tree)));
        round.push(("wide", time));
        let (tree, time) = timed(|| Obvhs::build(&triangles));
        others.push(("obvhs", Box::new(tree)));
        round.push(("obvhs", time));
        let (tree, time) = timed(|| Rc::new(CrateBvhTree::build(&mesh.corners)));
        for (name, is_ordered) in [("bvh, nearest", true), ("bvh, all", false)] {
            let tree = Rc::clone(&tree);
            others.push((name, Box::new(Traversed { tree, is_ordered })));
        }
        round.push(("bvh, nearest", time));
        if let Some(embree) = embree {
            let (tree, time) = timed(|| embree.build(mesh));
            others.push(("Embree", Box::new(tree)));
            round.push(("Embree", time));
        }
        times.push(round);
        trees = Some(Trees { reference, others });
    }
    let names = times[0].iter().map(|(name, _)| *name);
    for (i, name) in names.enumerate() {
        let millis = times.iter().map(|round| 1e3 * round[i].1.as_secs_f64());
        report.add(name, "build, ms", millis.collect());
    }
    trees.expect("there is at least one round")
}

/// Traces the same rays with all contenders, which take turns, and compares their hits.
fn measure_rays(
    contenders: &[(&'static str, &dyn Contender)],
    rays: &Rays,
    rounds: usize,
    report: &mut Report,
) {
    let mut speeds = vec![Vec::new(); contenders.len()];
    for _ in 0..rounds {
        let mut times = vec![Duration::ZERO; contenders.len()];
        let mut distances = vec![Vec::new(); contenders.len()];
        for turn in rays.rays.chunks(RAYS_PER_TURN) {
            for (i, (_, contender)) in contenders.iter().enumerate() {
                let (found, time) = timed(|| contender.distances(turn));
                times[i] += time;
                distances[i].extend(found);
            }
        }
        for (speeds, time) in speeds.iter_mut().zip(times) {
            speeds.push(rays.rays.len() as f64 / 1e6 / time.as_secs_f64());
        }
        let (expected, others) = distances
            .split_first()
            .expect("the reference is the first contender");
        for ((name, _), other) in contenders[1..].iter().zip(others) {
            check_agreement(name, rays.kind, expected, other, report);
        }
    }
    for ((name, _), speeds) in contenders.iter().zip(speeds) {
        report.add(name, rays.kind, speeds);
    }
}

/// Checks that a contender finds the same hits as the reference. The last bits of a distance may
/// differ, and a few rays may have different hits, e.g. exactly on an edge.
fn check_agreement(
    name: &'static str,
    kind: &str,
    expected: &[f32],
    other: &[f32],
    report: &mut Report,
) {
    let same = |(a, b): &(&f32, &f32)| a == b || (**a - **b).abs() <= 1e-3 * a.max(1e-3);
    let differing = expected.len() - expected.iter().zip(other).filter(same).count();
    assert!(
        differing * 1000 <= expected.len(),
        "{name}, {kind}: the hits of {differing} of {} rays differ from the reference's",
        expected.len()
    );
    report.record_mismatches(name, differing as f64 / expected.len() as f64);
}
