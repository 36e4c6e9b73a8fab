//! Items about the cost of a tree.

use judging::exam::{ExamQuestion, Key};
use judging::symptom::Symptom;
use protocol::{Question, Shape};

use super::draw::transform_of_size;
use crate::domains::fields;
use crate::items::{Declaration, meshes};
use crate::oracle::bbox::Bounds;
use crate::oracle::buckets::{self, BucketExtent, BucketedBuilder, SideRule};
use crate::oracle::{scan, sweep};
use crate::seed::Rng;

/// Creates a question about a tree that is judged only by its cost.
pub(super) fn cost_question(shapes: Vec<Shape>, max_leaf_size: u32) -> ExamQuestion {
    let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
    let sweep_cost = Some(sweep::cost(&boxes, max_leaf_size as usize));
    ExamQuestion::tree(shapes, max_leaf_size, &[], sweep_cost)
}

/// The maximum cost of a correct builder's tree, relative to the exact sweep's tree. The judge
/// gives full marks up to 1.12.
const MAX_CORRECT_COST: f64 = 1.06;

/// The minimum cost of a tree whose builder compares only the two buckets next to a plane, relative
/// to the exact sweep's tree. Meshes with a lower cost are not used, because they would hide this
/// common mistake.
const MIN_ADJACENT_COST: f64 = 1.2;

/// Creates a question for each pair of a primitive count and a maximum leaf size. Correct builders
/// come close to the exact sweep's cost in all of them. `draw` returns a random question, or `None`
/// to be called again.
fn questions(
    rng: &mut Rng,
    sizes: &[(usize, u32)],
    draw: impl Fn(&mut Rng, usize, u32) -> Option<ExamQuestion>,
) -> Vec<ExamQuestion> {
    let is_fair = |question: &ExamQuestion| highest_correct_cost(question) <= MAX_CORRECT_COST;
    let question = |&(count, max_leaf_size): &(usize, u32)| {
        rng.retry(|rng| draw(rng, count, max_leaf_size).filter(is_fair))
    };
    sizes.iter().map(question).collect()
}

/// Creates questions about random meshes. The meshes' sizes and positions are picked at random from
/// the domain. On these meshes, builders that compare only adjacent buckets don't come close to the
/// exact sweep.
fn mesh_questions(rng: &mut Rng, mesh: Mesh, sizes: &[(usize, u32)]) -> Vec<ExamQuestion> {
    questions(rng, sizes, |rng, count, max_leaf_size| {
        let shapes = shuffled(rng, mesh, count);
        let question = cost_question(shapes.clone(), max_leaf_size);
        let is_wanted = highest_correct_cost(&question) <= MAX_CORRECT_COST
            && lowest_adjacent_cost(&question) >= MIN_ADJACENT_COST;
        is_wanted.then(|| cost_question(placed(rng, &shapes), max_leaf_size))
    })
}

/// Creates questions about trees over scenes of the largest allowed extent. In each of the upper
/// nodes, the box's area times the number of primitives is above 1e10.
fn huge_questions(rng: &mut Rng, sizes: &[(usize, u32)]) -> Vec<ExamQuestion> {
    questions(rng, sizes, |rng, count, max_leaf_size| {
        let shapes = meshes::galaxy(rng, count);
        let question = cost_question(rng.shuffled(shapes), max_leaf_size);
        (lowest_adjacent_cost(&question) >= MIN_ADJACENT_COST).then_some(question)
    })
}

/// Creates questions about a few clumps of spheres. Some clumps have many times as many spheres as
/// others. This makes splitting by count expensive, even if a builder splits this way only above
/// the last levels or only below the root.
fn clumps_questions(rng: &mut Rng, sizes: &[(usize, u32)]) -> Vec<ExamQuestion> {
    /// The minimum cost of a tree that is partly split by count, relative to the exact sweep's
    /// tree.
    const LEAST: f64 = 1.25;
    questions(rng, sizes, |rng, count, max_leaf_size| {
        let shapes = shuffled(rng, meshes::clumps, count);
        let shapes = placed(rng, &shapes);
        let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
        let most = max_leaf_size as usize;
        let builder = BucketedBuilder {
            count: 16,
            extent: BucketExtent::Centers,
            sides: SideRule::AllBuckets,
        };
        let cost = |is_halved: &dyn Fn(usize) -> bool| {
            buckets::cost_with_halves(&boxes, most, builder, is_halved)
        };
        let by_count = cost(&|number| number > 4 * most).min(cost(&|number| number < count));
        let question = cost_question(shapes, max_leaf_size);
        (by_count >= LEAST * cost_of_sweep(&question)).then_some(question)
    })
}

/// Creates questions about a few long lanes of spheres. The best split is between two lanes and
/// therefore not along the axis of the largest extent.
fn lanes_questions(rng: &mut Rng, sizes: &[(usize, u32)]) -> Vec<ExamQuestion> {
    questions(rng, sizes, |rng, count, max_leaf_size| {
        let shapes = shuffled(rng, meshes::lanes, count);
        Some(cost_question(placed(rng, &shapes), max_leaf_size))
    })
}

/// A function that generates a random mesh of this many primitives.
type Mesh = fn(&mut Rng, usize) -> Vec<Shape>;

/// Returns the primitives of a mesh in random order, numbered in this order.
fn shuffled(rng: &mut Rng, mesh: Mesh, count: usize) -> Vec<Shape> {
    let shapes = mesh(rng, count);
    meshes::number_shapes(rng.shuffled(shapes))
}

/// Returns the shapes with a random size and position from the domain.
fn placed(rng: &mut Rng, shapes: &[Shape]) -> Vec<Shape> {
    let size = rng.index(fields::SIZES.len());
    transform_of_size(rng, shapes, size).shapes(shapes)
}

/// Returns the cost of the exact sweep's tree.
fn cost_of_sweep(question: &ExamQuestion) -> f64 {
    let Key::Tree {
        sweep_cost: Some(sweep),
        ..
    } = question.key
    else {
        unreachable!("{question:?} is not about a tree's cost")
    };
    sweep
}

/// Returns the highest relative cost among correct bucketed builders. For some meshes, all planes
/// that a builder considers narrowly miss the best split, which makes its tree expensive.
fn highest_correct_cost(question: &ExamQuestion) -> f64 {
    let extents = [BucketExtent::Centers, BucketExtent::Bounds];
    let counts = [8, 10, 12, 16, 17, 24, 25, 32].into_iter();
    let costs = counts.flat_map(|count| {
        extents.map(|extent| {
            let builder = BucketedBuilder {
                count,
                extent,
                sides: SideRule::AllBuckets,
            };
            relative_cost(question, builder)
        })
    });
    costs.fold(0.0, f64::max)
}

/// Returns the lowest relative cost among builders that compare only the two buckets next to a
/// plane. For some meshes, such builders find good planes by luck.
fn lowest_adjacent_cost(question: &ExamQuestion) -> f64 {
    let costs = [8, 12, 16, 24, 32].map(|count| {
        let builder = BucketedBuilder {
            count,
            extent: BucketExtent::Centers,
            sides: SideRule::AdjacentBuckets,
        };
        relative_cost(question, builder)
    });
    costs.into_iter().fold(f64::INFINITY, f64::min)
}

/// Returns the cost of a bucketed builder's tree divided by the cost of the exact sweep's tree.
pub fn relative_cost(question: &ExamQuestion, builder: BucketedBuilder) -> f64 {
    let Question::Build {
        shapes,
        max_leaf_size,
    } = &question.question
    else {
        unreachable!("{question:?} is not about a tree")
    };
    let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
    buckets::cost(&boxes, *max_leaf_size as usize, builder) / cost_of_sweep(question)
}

pub(super) const COST_STRANDS: Declaration = Declaration {
    id: "build.cost_strands",
    title: "strands along x, y and z are split along the best of the three axes",
    look: "At every node, compare partitions along all three axes by the same cost. It depends on \
        the areas of the boxes around whole primitives and on the numbers of primitives. The \
        cheapest partition need not be along the longest axis.",
    look_fits: &[Symptom::of("SAH cost")],
    section: "building.md#try-all-three-axes-at-every-node",
    tests: &["Builds the tree with…", "Use 8 or more buckets…"],
    questions: |rng| mesh_questions(rng, meshes::strands, &[(128, 1), (256, 2), (1023, 4)]),
    ..Declaration::ALONE
};

pub(super) const COST_SHEETS: Declaration = Declaration {
    id: "build.cost_sheets",
    title: "the split of stacked sheets depends on the areas of both sides",
    look: "S_A and S_B are the areas of the boxes around *all* primitives of each side: merge the \
        buckets from the left for one side, and from the right for the other.",
    look_fits: &[Symptom::of("SAH cost")],
    section: "building.md#areas-and-counts-in-the-cost-formula",
    tests: &["Builds the tree with…", "Use 8 or more buckets…"],
    questions: |rng| {
        let sheets = mesh_questions(rng, meshes::sheets, &[(255, 2), (512, 1)]);
        let lanes = lanes_questions(rng, &[(1300, 4), (2100, 8)]);
        [sheets, lanes].concat()
    },
    ..Declaration::ALONE
};

pub(super) const COST_TOWN: Declaration = Declaration {
    id: "build.cost_town",
    points: 2,
    title: "the split of dense clusters in empty space depends on areas and counts",
    look: "C = C_trav + S_A/S_N · N_A + S_B/S_N · N_B: keep the cheapest partition so far, \
           together with its cost.",
    look_fits: &[Symptom::of("SAH cost")],
    section: "building.md#keep-track-of-the-best-cost",
    tests: &["Builds the tree with…", "Use 8 or more buckets…"],
    questions: |rng| {
        let town = mesh_questions(rng, meshes::town, &[(512, 1), (2048, 4)]);
        let huge = huge_questions(rng, &[(1900, 4), (4300, 8)]);
        let [few, more] = [(20, 45), (46, 100)].map(|(min, max)| rng.integer(min, max) as usize);
        let larger = [
            (180, 16, 24),
            (220, 25, 32),
            (350, 33, 45),
            (420, 46, 60),
            (900, 70, 160),
        ];
        let mut sizes = vec![(few, 1), (more, 1)];
        sizes.extend(larger.map(|(count, min, max)| (count, rng.integer(min, max))));
        [town, huge, clumps_questions(rng, &sizes)].concat()
    },
    ..Declaration::ALONE
};
