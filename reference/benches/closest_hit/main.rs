//! Closest hits and builds per second: the reference, and the variant that is eight wide, beside the
//! crates `obvhs` and `bvh` and, where there is one, Embree; on one thread, turn by turn, in CPU time.
//! All must hit the same. How to run it, and what came of it: ../README.md.

use std::rc::Rc;
use std::time::Duration;

use reference::bvh::Bvh;
use reference::primitive::Primitive;
// Under the names that the variant's file has for them.
use reference::{bbox, primitive, triangle};

use crate::contenders::{
    Contender, CrateBvhTree, FullTraversal, MAX_LEAF_SIZE, NearestTraversal, Obvhs,
};
use crate::cost::timed;
use crate::embree::Embree;
use crate::mesh::{Mesh, meshes};
use crate::rays::Rays;
use crate::report::Report;

mod contenders;
mod cost;
mod embree;
mod mesh;
mod rays;
mod report;

// The variant's file as it stands, beside the reference's other four.
#[path = "../../variants/bvh/wide.rs"]
#[allow(dead_code, reason = "not all of it is measured")]
mod eight;

/// How often each is built, and each asked each kind of ray, unless `ROUNDS` says otherwise.
const ROUNDS: usize = 5;

/// How many rays one is asked before it is the next one's turn: some milliseconds, so that a slow
/// moment of the machine is everybody's, and yet enough that each finds its caches its own.
const RAYS_PER_TURN: usize = 1 << 15;

fn main() {
    let rounds = std::env::var("ROUNDS").map_or(ROUNDS, |text| text.parse().expect("a number"));
    let embree = Embree::open();
    if embree.is_none() {
        println!("EMBREE names no library: it is left out");
    }
    for mesh in meshes() {
        println!(
            "\n{}, {} triangles, median of {rounds} rounds",
            mesh.name,
            mesh.corners.len()
        );
        let mut report = Report::default();
        let trees = build_trees(&mesh, embree.as_ref(), rounds, &mut report);
        let rays = rays::all_kinds(&mesh, &trees.reference);
        let contenders = trees.contenders();
        for rays in &rays {
            measure_rays(&contenders, rays, rounds, &mut report);
        }
        println!("{report}");
    }
}

/// One tree of each.
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

/// Builds all trees, turn by turn.
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
        let (ours, wides) = (primitives.clone(), primitives.clone());
        let (reference, time) = timed(|| Bvh::build(ours, MAX_LEAF_SIZE));
        let mut round = vec![("reference", time)];
        let mut others: Vec<(&'static str, Box<dyn Contender>)> = Vec::new();

        let (tree, time) = timed(|| eight::Bvh::build(wides, MAX_LEAF_SIZE));
        others.push(("wide", Box::new(tree)));
        round.push(("wide", time));
        let (tree, time) = timed(|| Obvhs::build(&triangles));
        others.push(("obvhs", Box::new(tree)));
        round.push(("obvhs", time));
        let (tree, time) = timed(|| Rc::new(CrateBvhTree::build(&mesh.corners)));
        others.push(("bvh, nearest", Box::new(NearestTraversal(Rc::clone(&tree)))));
        others.push(("bvh, all", Box::new(FullTraversal(tree))));
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
    trees.expect("there is a round")
}

/// Sends the same rays to all, turn by turn, and compares what they hit.
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
        let (right, others) = distances.split_first().expect("the reference is there");
        for ((name, _), other) in contenders[1..].iter().zip(others) {
            check_agreement(name, rays.kind, right, other, report);
        }
    }
    for ((name, _), speeds) in contenders.iter().zip(speeds) {
        report.add(name, rays.kind, speeds);
    }
}

/// Speed is worth nothing without right answers. The last bits may differ, and so may what happens
/// exactly on an edge.
fn check_agreement(
    name: &'static str,
    kind: &str,
    right: &[f32],
    other: &[f32],
    report: &mut Report,
) {
    let same = |(a, b): &(&f32, &f32)| a == b || (**a - **b).abs() <= 1e-3 * a.max(1e-3);
    let differing = right.len() - right.iter().zip(other).filter(same).count();
    assert!(
        differing * 1000 <= right.len(),
        "{name}, {kind}: {differing} of {} rays hit something else",
        right.len()
    );
    report.record_mismatches(name, differing as f64 / right.len() as f64);
}
