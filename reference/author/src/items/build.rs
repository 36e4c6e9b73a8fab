//! Task 3, step 1: building trees. What comes back is a tree, and is judged part by part.

use glam::{DVec3, dvec3};
use grader::exam::{Asked, Item, Key, Task, TreePart};
use protocol::{Question, Shape};

use super::meshes;
use crate::oracle::bbox::Bounds;
use crate::oracle::{scan, sweep};
use crate::seed::{Draw, Seed};

use TreePart::{Contains, LeafSize, Partition, Stops, Tight};

/// The items of the task `build`.
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 15] = [
        partition,
        contains,
        tight,
        leaf_size,
        stops,
        negative,
        coincident,
        concentric,
        coplanar,
        collinear,
        outlier,
        one_or_none,
        cost_strands,
        cost_sheets,
        cost_town,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

/// An item with one question more than its idea: without a tree, or with all in one leaf, it is
/// wrong. Its primitives lie far apart, so that no heuristic would rather keep them together.
fn item(name: &str, points: u32, text: [&str; 2], mut questions: Vec<Asked>) -> Item {
    let mut draw = Seed(0).draw("build.control");
    let soup = meshes::soup(&mut draw, 24, 2.0, 0.1);
    questions.push(asked(&[Partition, LeafSize], soup, 4));
    super::item(Task::Build, name, points, text, questions)
}

fn asked(judged: &[TreePart], shapes: Vec<Shape>, max_leaf_size: u32) -> Asked {
    Asked {
        question: Question::Build {
            shapes,
            max_leaf_size,
        },
        key: Key::Tree {
            judged: judged.to_vec(),
            sweep_cost: None,
        },
    }
}

/// A question about the cost alone.
fn cost(shapes: Vec<Shape>, max_leaf_size: u32) -> Asked {
    let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
    let sweep_cost = Some(sweep::cost(&boxes, max_leaf_size as usize));
    Asked {
        question: Question::Build {
            shapes,
            max_leaf_size,
        },
        key: Key::Tree {
            judged: Vec::new(),
            sweep_cost,
        },
    }
}

/// Soups of several sizes, for leaves of several sizes.
fn soups(name: &str, seed: Seed, judged: &[TreePart], sizes: &[(usize, u32)]) -> Vec<Asked> {
    soups_of(0.2, name, seed, judged, sizes)
}

/// The same of primitives of this size.
fn soups_of(
    size: f64,
    name: &str,
    seed: Seed,
    judged: &[TreePart],
    sizes: &[(usize, u32)],
) -> Vec<Asked> {
    let mut draw = seed.draw(name);
    let question = |&(count, max_leaf_size): &(usize, u32)| {
        let shapes = meshes::soup(&mut draw, count, 3.0, size);
        asked(judged, shapes, max_leaf_size)
    };
    sizes.iter().map(question).collect()
}

fn partition(seed: Seed) -> Item {
    item(
        "partition",
        2,
        [
            "every primitive is in exactly one leaf",
            "A partition loses nothing and doubles nothing: the primitives of a node go to one of \
             its children each, and start and size of the leaves count all of them once.",
        ],
        soups(
            "build.partition",
            seed,
            &[Partition],
            &[(37, 1), (90, 2), (200, 4), (120, 8)],
        ),
    )
}

fn contains(seed: Seed) -> Item {
    item(
        "contains",
        2,
        [
            "every box holds all that is below it",
            "If a box misses some of its primitives, the bucket in which a primitive was counted may \
             not be the side to which it was moved.",
        ],
        soups("build.contains", seed, &[Contains], &[(64, 1), (300, 4)]),
    )
}

fn tight(seed: Seed) -> Item {
    item(
        "tight",
        1,
        [
            "no box is larger than what is below it needs",
            "A node's box is the union of its primitives' boxes. One that starts at the origin \
             instead of BBox::EMPTY, or is its parent's, is too large.",
        ],
        soups("build.tight", seed, &[Tight], &[(64, 1), (150, 4)]),
    )
}

fn leaf_size(seed: Seed) -> Item {
    item(
        "leaf_size",
        2,
        [
            "no leaf holds more than max_leaf_size primitives",
            "Split until a node has at most so many, whatever the heuristic says of it.",
        ],
        // So large that the heuristic alone would rather not split some of them.
        soups_of(
            2.5,
            "build.leaf_size",
            seed,
            &[LeafSize],
            &[(100, 1), (60, 2), (150, 4), (150, 8)],
        ),
    )
}

fn stops(seed: Seed) -> Item {
    item(
        "stops",
        1,
        [
            "a node with at most max_leaf_size primitives is a leaf",
            "max_leaf_size itself is small enough: compare with <=.",
        ],
        soups(
            "build.stops",
            seed,
            &[Stops],
            &[(64, 2), (150, 4), (160, 8)],
        ),
    )
}

fn negative(seed: Seed) -> Item {
    let mut draw = seed.draw("build.negative");
    let far = dvec3(-20.0, -30.0, -10.0);
    let chips = (0..80).map(|_| {
        let center = far + draw.point(4.0);
        meshes::chip(&mut draw, center, 0.5)
    });
    let shapes = meshes::numbered(chips);
    item(
        "negative",
        1,
        [
            "coordinates below zero are no exception",
            "A box that grows from zero never gets below it, and a cast to usize turns what is \
             negative into 0.",
        ],
        vec![asked(&[Partition, Contains, Tight], shapes, 2)],
    )
}

fn coincident(seed: Seed) -> Item {
    let mut draw = seed.draw("build.coincident");
    let center = draw.point(2.0);
    let same = meshes::chip(&mut draw, center, 0.5);
    let all = meshes::numbered(vec![same; 20]);
    let mut some = meshes::soup(&mut draw, 30, 3.0, 0.4);
    some.extend(vec![same; 17]);
    item(
        "coincident",
        1,
        [
            "primitives in the same place are split by count",
            "If all centers coincide, all are in one bucket and no plane separates them: see that \
             both sides get some, or it never ends.",
        ],
        vec![
            asked(&[Partition, LeafSize], all.clone(), 1),
            asked(&[Partition, LeafSize], all, 4),
            asked(
                &[Partition, LeafSize],
                meshes::numbered(draw.shuffled(some)),
                2,
            ),
        ],
    )
}

fn concentric(seed: Seed) -> Item {
    let mut draw = seed.draw("build.concentric");
    let center = draw.point(2.0).as_vec3();
    let shells = (1..=13).map(|i| Shape::Sphere {
        center,
        radius: 0.25 * i as f32,
        material: 0,
    });
    item(
        "concentric",
        1,
        [
            "shells around one center are split by count",
            "Their boxes differ, and still their centers coincide: what is divided by the extent of \
             the centers is divided by zero.",
        ],
        vec![asked(
            &[Partition, LeafSize, Contains],
            meshes::numbered(shells),
            2,
        )],
    )
}

fn coplanar(seed: Seed) -> Item {
    let mut draw = seed.draw("build.coplanar");
    let question = |axis: usize| {
        let mut height = DVec3::ZERO;
        height[axis] = draw.uniform(-2.0, 2.0);
        let (x, y) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
        let cells = (0..64).map(|cell| {
            let corner = height + f64::from(cell % 8) * x + f64::from(cell / 8) * y;
            meshes::facet([corner, corner + x, corner + y], 0)
        });
        asked(&[Partition, LeafSize, Contains], meshes::numbered(cells), 2)
    };
    item(
        "coplanar",
        1,
        [
            "a flat grid is no exception",
            "Along one axis all centers coincide: what is divided by their extent there is not a \
             number, and must not become a bucket.",
        ],
        [0, 1, 2].map(question).to_vec(),
    )
}

fn collinear(_: Seed) -> Item {
    let question = |axis: usize| {
        let row = (0..40).map(|i| {
            let center = 0.75 * f64::from(i) * DVec3::AXES[axis];
            Shape::Sphere {
                center: center.as_vec3(),
                radius: 0.25,
                material: 0,
            }
        });
        asked(&[Partition, LeafSize, Contains], meshes::numbered(row), 3)
    };
    item(
        "collinear",
        1,
        [
            "a row is no exception, along whichever axis",
            "Along two axes all centers coincide. The third must be found, be it x, y or z.",
        ],
        [0, 1, 2].map(question).to_vec(),
    )
}

fn outlier(seed: Seed) -> Item {
    let mut draw = seed.draw("build.outlier");
    let mut crowd = |far: f64| {
        let mut shapes = meshes::soup(&mut draw, 40, 1.0, 0.1);
        let center = far * draw.direction();
        shapes.push(meshes::chip(&mut draw, center, 0.5));
        meshes::numbered(draw.shuffled(shapes))
    };
    let judged = [Partition, LeafSize, Contains];
    let questions = vec![
        asked(&judged, crowd(100.0), 2),
        asked(&judged, crowd(1000.0), 2),
    ];
    // Growing by a quarter from one to the next: over a thousand times from end to end.
    let growing = (0..32).map(|i| {
        let size = 1e-3 * 1.25f64.powi(i);
        meshes::chip(&mut draw, 4.0 * size * DVec3::ONE, size)
    });
    let growing = meshes::numbered(growing);
    item(
        "outlier",
        1,
        [
            "one far from all others does not spoil the tree",
            "Then all others are in one bucket. The split is still one: they are in a smaller node \
             than before, with buckets of its own.",
        ],
        questions
            .into_iter()
            .chain([asked(&judged, growing, 1)])
            .collect(),
    )
}

fn one_or_none(seed: Seed) -> Item {
    let mut draw = seed.draw("build.one_or_none");
    let judged = [Partition, LeafSize, Contains];
    let one = meshes::soup(&mut draw, 1, 2.0, 0.5);
    let two = meshes::soup(&mut draw, 2, 2.0, 0.5);
    item(
        "one_or_none",
        1,
        [
            "no primitives, one, or two: a tree of its own each",
            "Of nothing: no nodes, or one leaf of size 0. Of one: one leaf.",
        ],
        vec![
            asked(&judged, Vec::new(), 4),
            asked(&judged, one, 1),
            asked(&judged, two.clone(), 1),
            asked(&judged, two, 4),
        ],
    )
}

fn cost_item(name: &str, points: u32, text: [&str; 2], draw_of: Draw, mesh: Mesh) -> Item {
    let mut draw = draw_of;
    let shapes = mesh(&mut draw);
    let shapes = meshes::numbered(draw.shuffled(shapes));
    item(name, points, text, vec![cost(shapes, 4)])
}

type Mesh = fn(&mut Draw) -> Vec<Shape>;

fn cost_strands(seed: Seed) -> Item {
    cost_item(
        "cost_strands",
        2,
        [
            "all three axes are tried: strands along x, y and z",
            "The cheapest of the partitions along all axes counts, at every node anew: not always \
             the same axis, and not the longest.",
        ],
        seed.draw("build.cost_strands"),
        |draw| meshes::strands(draw, 750),
    )
}

fn cost_sheets(seed: Seed) -> Item {
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

fn cost_town(seed: Seed) -> Item {
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
