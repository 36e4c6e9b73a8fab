//! Shows how the work grows with the number of triangles: plots the number of boxes and triangles
//! each ray is tested against and the number of build calls each triangle is part of. The work is
//! counted rather than timed, so the plot is the same on every machine. It is written to
//! `reference/benches/scaling.svg`, or compared with that file if the argument is `--check`.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use reference::bvh::{Bvh, Node};
use reference::primitive::Primitive;

use crate::count::count_tests;
use crate::plot::plot;

mod count;
mod mesh;
#[path = "../numbers.rs"]
mod numbers;
mod plot;

const UPDATE_COMMAND: &str = "cargo bench -p benches --bench scaling";
/// The number of rays per mesh.
const RAYS: usize = 2000;
/// The maximum number of triangles in a leaf.
const MAX_LEAF_SIZE: usize = 4;
/// For each mesh, the number of pieces that each edge of the cube is divided into. With n pieces,
/// the mesh has 12 n² triangles. From one mesh to the next, the number of triangles grows by a
/// factor of about √10.
const PIECES: [u32; 9] = [3, 5, 9, 16, 29, 51, 91, 162, 289];

/// The counts for one mesh.
struct Row {
    triangles: usize,
    /// The average number of box tests per ray.
    boxes: f64,
    /// The average number of triangle tests per ray.
    primitives: f64,
    /// The number of calls that build a node.
    calls: usize,
    /// The average number of these calls that a triangle is part of.
    handled: f64,
}

fn main() -> ExitCode {
    println!("triangles     boxes/ray     triangles/ray   build calls   calls/triangle");
    let rows: Vec<Row> = PIECES.into_iter().map(measure).collect();
    let svg = plot(&rows);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scaling.svg");
    if std::env::args().any(|argument| argument == "--check") {
        if fs::read_to_string(&path).is_ok_and(|found| found == svg) {
            return ExitCode::SUCCESS;
        }
        eprintln!(
            "{} is out of date: update it with `{UPDATE_COMMAND}`",
            path.display()
        );
        return ExitCode::FAILURE;
    }
    match fs::write(&path, svg) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("cannot write {}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}

fn measure(pieces: u32) -> Row {
    let shapes = mesh::bumpy_ball(pieces);
    let primitives = shapes.iter().map(Primitive::new).collect();
    let bvh = Bvh::build(primitives, MAX_LEAF_SIZE);
    let count = count_tests(&bvh, &mesh::rays(RAYS));
    let row = Row {
        triangles: shapes.len(),
        boxes: count.boxes as f64 / RAYS as f64,
        primitives: count.primitives as f64 / RAYS as f64,
        calls: bvh.nodes.len(),
        handled: count_subtree(&bvh, &bvh.nodes[bvh.root]).handled as f64 / shapes.len() as f64,
    };
    let Row {
        triangles,
        boxes,
        primitives,
        calls,
        handled,
    } = &row;
    println!("{triangles:9}   {boxes:11.1}   {primitives:15.1}   {calls:11}   {handled:14.1}");
    row
}

/// The number of triangles below a node, and the sum of this number over the node and all of its
/// descendants.
struct SubtreeCounts {
    triangles: usize,
    handled: usize,
}

fn count_subtree(bvh: &Bvh, node: &Node) -> SubtreeCounts {
    if node.is_leaf() {
        return SubtreeCounts {
            triangles: node.size,
            handled: node.size,
        };
    }
    let [l, r] = [node.l, node.r].map(|child| count_subtree(bvh, &bvh.nodes[child]));
    let triangles = l.triangles + r.triangles;
    SubtreeCounts {
        triangles,
        handled: triangles + l.handled + r.handled,
    }
}
