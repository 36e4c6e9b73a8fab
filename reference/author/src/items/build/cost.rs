//! What a tree costs.

use grader::exam::{Asked, Item, Key};
use protocol::{Question, Shape};

use super::item;
use crate::items::meshes;
use crate::oracle::bbox::Bounds;
use crate::oracle::{scan, sweep};
use crate::seed::{Draw, Seed};

/// A question about the cost alone.
pub(super) fn cost(shapes: Vec<Shape>, max_leaf_size: u32) -> Asked {
    let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
    let sweep_cost = Some(sweep::cost(&boxes, max_leaf_size as usize));
    let question = Question::Build {
        shapes,
        max_leaf_size,
    };
    let key = Key::Tree {
        judged: Vec::new(),
        sweep_cost,
    };
    Asked::new(question, key)
}

fn cost_item(name: &str, points: u32, text: [&str; 2], draw_of: Draw, mesh: Mesh) -> Item {
    let mut draw = draw_of;
    let shapes = mesh(&mut draw);
    let shapes = meshes::numbered(draw.shuffled(shapes));
    item(name, points, text, vec![cost(shapes, 4)])
}

type Mesh = fn(&mut Draw) -> Vec<Shape>;

pub(super) fn cost_strands(seed: Seed) -> Item {
    cost_item(
        "cost_strands",
        1,
        [
            "all three axes are tried: strands along x, y and z",
            "The cheapest of the partitions along all axes counts, at every node anew: not always \
             the same axis, and not the longest.",
        ],
        seed.draw("build.cost_strands"),
        |draw| meshes::strands(draw, 750),
    )
}

pub(super) fn cost_sheets(seed: Seed) -> Item {
    cost_item(
        "cost_sheets",
        1,
        [
            "the areas decide: sheets above each other",
            "S_A and S_B are the areas of the boxes around *all* primitives of a side: join the \
             buckets from the left and from the right.",
        ],
        seed.draw("build.cost_sheets"),
        |draw| meshes::sheets(draw, 900),
    )
}

pub(super) fn cost_town(seed: Seed) -> Item {
    cost_item(
        "cost_town",
        2,
        [
            "areas and numbers decide together: crowds on an open field",
            "C = C_trav + S_A/S_N · N_A + S_B/S_N · N_B: keep the cheapest partition so far, and \
             its cost.",
        ],
        seed.draw("build.cost_town"),
        |draw| meshes::town(draw, 1200),
    )
}
