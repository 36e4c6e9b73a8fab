//! What a tree saves, counted: how many boxes and primitives a ray is tested with, and how often a
//! primitive is handled while the tree is built, against the number of triangles. Nothing is timed, so
//! the plot is the same on every machine: `scaling.svg` beside this folder, which this writes, or
//! with `--check` compares.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use crate::bvh::{Bvh, Node};
use crate::count::count_tests;
use crate::plot::plot;

mod count;
mod mesh;
mod plot;

// The reference's `bvh.rs` as it stands, on boxes and primitives that count.
#[path = "count/bbox.rs"]
mod bbox;
#[path = "../../src/bvh.rs"]
#[allow(dead_code, unused_imports, reason = "its tests do not run here")]
mod bvh;
#[path = "count/primitive.rs"]
mod primitive;
#[path = "../../src/sphere.rs"]
#[allow(dead_code, unused_imports, reason = "only triangles are counted here")]
mod sphere;
#[path = "../../src/triangle.rs"]
#[allow(dead_code, unused_imports, reason = "its tests do not run here")]
mod triangle;

const UPDATE_COMMAND: &str = "cargo bench -p benches --bench scaling";
/// How many rays each mesh is asked.
const RAYS: usize = 2000;
/// At most so many triangles in a leaf.
const MAX_LEAF_SIZE: usize = 4;
/// Pieces along an edge of a cube, whose six faces make a mesh of 12 n² triangles: half a decade
/// from one to the next.
const PIECES: [u32; 9] = [3, 5, 9, 16, 29, 51, 91, 162, 289];

/// What was counted for one mesh.
struct Row {
    triangles: usize,
    /// Tests of boxes for each ray.
    boxes: f64,
    /// Tests of triangles for each ray.
    primitives: f64,
    /// Calls that build a node.
    calls: usize,
    /// How many of these calls a triangle takes part in.
    handled: f64,
}

fn main() -> ExitCode {
    println!("triangles   boxes a ray   triangles a ray   build calls   handled, each");
    let rows: Vec<Row> = PIECES.into_iter().map(measure).collect();
    let svg = plot(&rows);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scaling.svg");
    if std::env::args().any(|argument| argument == "--check") {
        if fs::read_to_string(&path).is_ok_and(|found| found == svg) {
            return ExitCode::SUCCESS;
        }
        eprintln!(
            "{} is not as counted: mend it with `{UPDATE_COMMAND}`",
            path.display()
        );
        return ExitCode::FAILURE;
    }
    match fs::write(&path, svg) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("can not write {}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}

fn measure(pieces: u32) -> Row {
    let shapes = mesh::bumpy_ball(pieces);
    let primitives = shapes.iter().map(primitive::Primitive::new).collect();
    let bvh = Bvh::build(primitives, MAX_LEAF_SIZE);
    let rays = mesh::rays(RAYS);
    let ((), count) = count_tests(|| {
        for ray in &rays {
            bvh.hit(ray);
        }
    });
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
    println!("{triangles:9}   {boxes:11.1}   {primitives:15.1}   {calls:11}   {handled:13.1}");
    row
}

/// What is below a node: how many triangles, and how many all the nodes there were made of.
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
