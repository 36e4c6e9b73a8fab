//! The item about a single split: primitives in a row for which one partition is by far the best.
//! Each side fits in a leaf, but all primitives together don't.

use glam::DVec3;
use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::Shape;

use super::cost::{cost_question, relative_cost};
use super::draw::transform_of_size;
use crate::domains::fields;
use crate::items::{Declaration, meshes};
use crate::oracle::bbox::Bounds;
use crate::oracle::buckets::{BucketExtent, BucketedBuilder, SideRule};
use crate::oracle::{scan, sweep};
use crate::seed::Rng;

/// Clumps of primitives along a row of length one.
#[derive(Clone, Copy)]
struct Layout<'a> {
    /// The start and end of each clump, and its number of primitives.
    clumps: &'a [(f64, f64, usize)],
    /// The size of the primitives in the first clump.
    first_size: f64,
    /// The size of all other primitives.
    size: f64,
    /// How exactly the centres line up.
    alignment: Alignment,
}

/// How exactly the centres of primitives line up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Alignment {
    /// Roughly in a row.
    Loose,
    /// Exactly in a row.
    Row,
    /// In a plane and roughly in a row.
    Plane,
    /// In a plane that also contains the primitives themselves, which are triangles.
    Flat,
}

/// All alignments.
const ALIGNMENTS: [Alignment; 4] = [
    Alignment::Row,
    Alignment::Plane,
    Alignment::Flat,
    Alignment::Loose,
];

const SMALL: f64 = 0.05;

impl<'a> Layout<'a> {
    /// Returns a layout of small primitives.
    const fn small(clumps: &'a [(f64, f64, usize)]) -> Self {
        Layout {
            clumps,
            first_size: SMALL,
            size: SMALL,
            alignment: Alignment::Loose,
        }
    }
}

/// Layouts of twelve primitives.
const LAYOUTS: [Layout<'static>; 5] = [
    // Three clumps. Two of them are close together. A builder that forgets the outermost bucket
    // ignores the clump at that end, so it may prefer to split between the two close clumps.
    Layout::small(&[(0.0, 0.02, 4), (0.74, 0.8, 4), (0.98, 1.0, 4)]),
    // Clumps with a gap from just above one quarter to just below one half. A builder with four
    // buckets doesn't have a plane in this gap.
    Layout::small(&[
        (0.0, 0.2, 4),
        (0.262, 0.27, 2),
        (0.485, 0.493, 2),
        (0.51, 1.0, 4),
    ]),
    // Three clumps. The first is the largest, but a builder that takes counts and boxes from
    // different buckets overlooks this clump and splits at the other gap.
    Layout::small(&[(0.0, 0.02, 6), (0.6, 0.62, 2), (0.98, 1.0, 4)]),
    // Three clumps. The first consists of large primitives, so it is best to split off this clump.
    // The other gap is wider, and a builder that treats primitives as points splits there.
    Layout {
        first_size: 1.2,
        size: 0.01,
        ..Layout::small(&[(0.0, 0.02, 4), (0.42, 0.44, 4), (0.98, 1.0, 4)])
    },
    // A large primitive beside the best gap. With sixteen buckets, only one plane is in this gap. A
    // builder that stores the cost of one plane with the next one splits on the wrong side of the
    // large primitive.
    Layout {
        first_size: 1.2,
        size: 0.02,
        ..Layout::small(&[
            (0.4385, 0.4385, 1),
            (0.0, 0.1, 3),
            (0.5615, 0.6, 7),
            (1.0, 1.0, 1),
        ])
    },
];

/// The layouts' leaf sizes. All primitives together never fit in a leaf.
const LEAF_SIZES: [usize; 5] = [8, 8, 8, 8, 10];

pub(super) const ONE_SPLIT: Declaration = Declaration {
    id: "build.one_split",
    title: "a row of primitives is split at the best plane",
    look: "Here one partition is much cheaper than all others. Work out its cost by hand from the \
           areas and the counts of its sides: does your code try this partition, does it compute \
           this cost, and does it split the root this way?",
    look_fits: &[Symptom::of("SAH cost")],
    section: "building.md#which-partitions-to-try",
    tests: &["Use 8 or more buckets…"],
    questions: one_split,
    ..Declaration::ALONE
};

/// A question that doesn't have a size or a position yet.
struct UnplacedQuestion {
    shapes: Vec<Shape>,
    max_leaf_size: usize,
    /// The axis of the best split.
    axis: usize,
    /// The smallest extent that the best split depends on.
    detail: f64,
}

impl UnplacedQuestion {
    fn new(shapes: Vec<Shape>, max_leaf_size: usize, axis: usize) -> UnplacedQuestion {
        UnplacedQuestion {
            shapes,
            max_leaf_size,
            axis,
            detail: f64::INFINITY,
        }
    }

    /// Returns the question with its primitives [placed](Self::placed) at random.
    fn question(&self, rng: &mut Rng, size: usize) -> Option<ExamQuestion> {
        let shapes = self.placed(rng, size)?;
        Some(cost_question(shapes, self.max_leaf_size as u32))
    }

    /// Returns the primitives moved to a random position. The position is so close to the origin that
    /// coordinates in single precision have enough digits for the detail, and the best split is
    /// still unambiguous. Returns `None` if such positions are rare or don't exist.
    fn placed(&self, rng: &mut Rng, size: usize) -> Option<Vec<Shape>> {
        /// The largest coordinate, as a multiple of the detail.
        const MOST: f64 = 1e5;
        /// The maximum number of positions to try.
        const ATTEMPTS: usize = 200;
        rng.attempt(ATTEMPTS, |rng| {
            let shapes = transform_of_size(rng, &self.shapes, size).shapes(&self.shapes);
            let [before, after] =
                [&self.shapes, &shapes].map(|all| Bounds::enclosing(all.iter().map(scan::bounds)));
            let detail = self.detail * after.diagonal() / before.diagonal();
            let largest = after.min.abs().max(after.max.abs()).max_element();
            (largest <= MOST * detail && is_unambiguous(&shapes, self.axis)).then_some(shapes)
        })
    }
}

/// The questions of the item so far.
struct Questions<'a> {
    rng: &'a mut Rng,
    /// The class of the first question's size, which grows by one class with each question.
    first_size: usize,
    questions: Vec<ExamQuestion>,
}

impl Questions<'_> {
    /// Adds a question. `draw` generates random primitives for which one split is by far the best.
    fn add(&mut self, draw: impl Fn(&mut Rng) -> UnplacedQuestion) {
        let size = (self.first_size + self.questions.len()) % fields::SIZES.len();
        let question = self.rng.retry(|rng| draw(rng).question(rng, size));
        self.questions.push(question);
    }
}

fn one_split(rng: &mut Rng) -> Vec<ExamQuestion> {
    let mut all = Questions {
        first_size: rng.index(fields::SIZES.len()),
        rng,
        questions: Vec::new(),
    };
    add_clumps(&mut all);
    add_few(&mut all);
    add_many(&mut all);
    add_outliers(&mut all);
    add_dense_ends(&mut all);
    add_strips(&mut all);
    let Questions { rng, questions, .. } = all;
    let tiny = (0..3).map(|axis| tiny_stack(rng, axis));
    questions.into_iter().chain(tiny).collect()
}

/// Returns a question about two layers of strips whose centres extend less than `f32::EPSILON` along
/// the axis of the best split. An axis with such a small extent must be tried, too.
fn tiny_stack(rng: &mut Rng, axis: usize) -> ExamQuestion {
    rng.retry(|rng| {
        let ratio = rng.log_uniform(0.01, 0.2);
        let stack = stack(rng, (4, axis == 1), ratio, axis);
        let shapes = stack.placed(rng, 0)?;
        let centers = Bounds::around(shapes.iter().map(|shape| scan::bounds(shape).center()));
        let extent = (centers.max - centers.min)[axis];
        let is_tiny = extent < f64::from(f32::EPSILON);
        is_tiny.then(|| cost_question(shapes, stack.max_leaf_size as u32))
    })
}

/// Adds questions about each layout of clumps along each axis.
fn add_clumps(all: &mut Questions) {
    /// The factors by which the layouts' primitive counts are multiplied. One layout with a gap
    /// then has over 1,024 primitives.
    const TIMES: [usize; 12] = [1, 5, 2, 20, 1, 96, 1, 5, 2, 20, 1, 50];
    for (number, layout) in LAYOUTS.into_iter().enumerate() {
        for axis in 0..3 {
            let times = TIMES[(3 * number + axis) % TIMES.len()];
            let clumps = layout.clumps.iter();
            let clumps: Vec<_> = clumps.map(|&(from, to, n)| (from, to, times * n)).collect();
            let alignment = if number >= 3 {
                Alignment::Loose
            } else {
                ALIGNMENTS[(number + axis) % ALIGNMENTS.len()]
            };
            let layout = Layout {
                clumps: &clumps,
                alignment,
                ..layout
            };
            let is_mirrored = (number + axis).is_multiple_of(2);
            all.add(|rng| {
                let shapes = row(rng, &layout, axis, is_mirrored);
                UnplacedQuestion::new(shapes, times * LEAF_SIZES[number], axis)
            });
        }
    }
}

/// Adds questions about a few primitives: one more than fits in a leaf.
fn add_few(all: &mut Questions) {
    for (index, count) in [3, 4, 5, 6, 8].into_iter().enumerate() {
        let alignment = match index % 2 {
            0 => Alignment::Loose,
            _ => ALIGNMENTS[index / 2 % ALIGNMENTS.len()],
        };
        all.add(|rng| {
            let axis = rng.index(3);
            let shapes = few(rng, (count, alignment), axis, index % 2 == 0);
            UnplacedQuestion::new(shapes, count - 1, axis)
        });
    }
    for count in 3..=6 {
        all.add(|rng| {
            let axis = rng.index(3);
            UnplacedQuestion::new(uneven(rng, count, axis), count - 1, axis)
        });
    }
}

/// Adds questions about two clusters of many primitives.
fn add_many(all: &mut Questions) {
    for count in [16_usize, 64, 129, 256, 513, 1100] {
        all.add(|rng| {
            let (axis, is_mirrored) = (rng.index(3), rng.coin());
            let largest = 6 * count / 10 + chunk_size(count);
            let leaf_size = (largest + rng.index(count - largest)).min(1000);
            UnplacedQuestion::new(many(rng, count, axis, is_mirrored), leaf_size, axis)
        });
    }
}

/// Adds questions about a cluster and, far from it, a few outliers. The cluster has more than sixteen
/// times as many primitives as there are outliers.
fn add_outliers(all: &mut Questions) {
    for (least, most) in [(18, 60), (100, 180), (250, 400)] {
        all.add(|rng| {
            let (count, chunk) = in_whole_chunks(rng.integer(least, most) as usize);
            // If there are very many primitives, the outliers are a single chunk.
            let far = chunk * (1 + rng.index((count.min(200) / (20 * chunk)).max(1)));
            let (axis, is_mirrored) = (rng.index(3), rng.coin());
            let clumps = [(0.0, 0.01, far), (0.9, 1.0, count - far)];
            let leaf_size = count - 1 - rng.index(far);
            let shapes = row(rng, &Layout::small(&clumps), axis, is_mirrored);
            UnplacedQuestion::new(shapes, leaf_size, axis)
        });
    }
}

/// Adds questions about a dense cluster at one end. The gap beside the cluster ends just short of one
/// seventh of the way along the row, so that no builder with fewer than 8 buckets has a plane there.
fn add_dense_ends(all: &mut Questions) {
    for (least, most) in [(12, 40), (41, 110), (111, 250), (251, 600)] {
        all.add(|rng| {
            let (count, chunk) = in_whole_chunks(rng.integer(least, most) as usize);
            let dense = 6 * count / 10 / chunk * chunk;
            let (axis, is_mirrored) = (rng.index(3), rng.coin());
            let clumps = [(0.0, 5e-4, dense), (0.141, 1.0, count - dense)];
            let shapes = row(rng, &Layout::small(&clumps), axis, is_mirrored);
            UnplacedQuestion::new(shapes, dense, axis)
        });
    }
}

/// Returns the largest primitive count up to `most` that is a multiple of its chunk size, along
/// with that chunk size. If clusters consist of whole chunks, a chunk ends in the gap between them.
fn in_whole_chunks(most: usize) -> (usize, usize) {
    let numbers = (1..=most).rev().map(|count| (count, chunk_size(count)));
    let mut whole = numbers.filter(|(count, chunk)| count % chunk == 0);
    whole.next().unwrap_or((most, 1))
}

/// Returns the chunk size of a builder that uses up to 64 chunks of equally many primitives instead
/// of buckets. Such a builder is correct as well.
fn chunk_size(count: usize) -> usize {
    count.div_ceil(64)
}

/// Adds questions about strips in layers.
fn add_strips(all: &mut Questions) {
    for (index, (count, least)) in STACKS.into_iter().enumerate() {
        all.add(|rng| {
            let ratio = least * rng.log_uniform(1.1, 8.0);
            stack(rng, (count, index % 2 == 1), ratio, index % 3)
        });
    }
    all.add(layers);
    all.add(layers);
}

/// Returns a cluster of primitives and a single primitive far from it.
fn few(
    rng: &mut Rng,
    (count, alignment): (usize, Alignment),
    axis: usize,
    is_mirrored: bool,
) -> Vec<Shape> {
    let layout = Layout {
        clumps: &[(0.0, 0.0, 1), (0.85, 1.0, count - 1)],
        first_size: LARGE,
        size: LARGE,
        alignment,
    };
    row(rng, &layout, axis, is_mirrored)
}

/// Returns two clusters. The smaller one is denser. The first cluster along the axis consists
/// of whole chunks.
fn many(rng: &mut Rng, count: usize, axis: usize, is_mirrored: bool) -> Vec<Shape> {
    let chunk = chunk_size(count);
    let whole = |tenths: usize| tenths * count / 10 / chunk * chunk;
    let smaller = if is_mirrored {
        count - whole(6)
    } else {
        whole(4)
    };
    let clumps = [(0.0, 0.02, smaller), (0.6, 1.0, count - smaller)];
    row(rng, &Layout::small(&clumps), axis, is_mirrored)
}

/// The size of primitives that are far larger than some of the spaces between them.
const LARGE: f64 = 0.4;

/// Returns primitives in a row along an axis, evenly spaced in each clump, for which one partition
/// is clearly the best.
fn row(rng: &mut Rng, layout: &Layout, axis: usize, is_mirrored: bool) -> Vec<Shape> {
    rng.retry(|rng| {
        let shapes = any_row(rng, layout, axis, is_mirrored);
        is_unambiguous(&shapes, axis).then_some(shapes)
    })
}

fn any_row(rng: &mut Rng, layout: &Layout, axis: usize, is_mirrored: bool) -> Vec<Shape> {
    /// A row with this many primitives or more consists only of spheres, since these take up less
    /// space in an exam.
    const MANY: usize = 33;
    let start = rng.point(3.0);
    let length = rng.uniform(8.0, 12.0);
    let all: usize = layout.clumps.iter().map(|(_, _, count)| count).sum();
    let kind = match layout.alignment {
        Alignment::Flat => 4 + (axis + 1) % 3,
        Alignment::Row | Alignment::Plane => 2,
        Alignment::Loose if all >= MANY => 2,
        Alignment::Loose => rng.index(4),
    };
    // The maximum distance of the centres from the row.
    let away = match layout.alignment {
        Alignment::Loose => DVec3::ONE,
        Alignment::Row => DVec3::ZERO,
        Alignment::Plane | Alignment::Flat => DVec3::ONE - DVec3::AXES[(axis + 1) % 3],
    };
    let mut shapes = Vec::new();
    for (clump, &(from, to, count)) in layout.clumps.iter().enumerate() {
        let size = if clump == 0 {
            layout.first_size
        } else {
            layout.size
        };
        for i in 0..count {
            let at = from + (to - from) * i as f64 / (count.max(2) - 1) as f64;
            let at = if is_mirrored { 1.0 - at } else { at };
            let offset = away * rng.point(0.05);
            let center = start + offset + (length * at - offset[axis]) * DVec3::AXES[axis];
            shapes.push(with_box_around(rng, kind, center, size));
        }
    }
    meshes::number_shapes(rng.shuffled(shapes))
}

/// Returns a primitive of this kind. The centre of its box is `center`. Kinds 4 and above are
/// triangles in a plane perpendicular to an axis.
fn with_box_around(rng: &mut Rng, kind: usize, center: DVec3, size: f64) -> Shape {
    match kind {
        0 | 1 => meshes::random_triangle_with_box_around(rng, center, size),
        2 => meshes::sphere(center, 0.7 * size),
        4.. => {
            let [x, y] = [1, 2].map(|next| 0.7 * size * DVec3::AXES[(kind - 4 + next) % 3]);
            meshes::flat_triangle([center - x - y, center + x - y, center - x + y], 0)
        }
        3 => {
            let kind = 1 + rng.index(2);
            with_box_around(rng, kind, center, size)
        }
    }
}

/// Returns spheres roughly in a row. If a builder has at most as many buckets as there are spheres,
/// none of its planes falls in the best gap.
fn uneven(rng: &mut Rng, count: usize, axis: usize) -> Vec<Shape> {
    rng.retry(|rng| {
        let start = rng.point(3.0);
        let spheres = (0..count).map(|index| {
            let at = match index {
                0 => 0.0,
                1 => 10.0,
                _ => rng.uniform(0.0, 10.0),
            };
            let radius = rng.log_uniform(0.1, 2.5);
            // Centres that coincide along another axis may be sorted in any order.
            let mut center = start + rng.point(0.05);
            center[axis] = start[axis] + at;
            meshes::sphere(center, radius)
        });
        let spheres: Vec<Shape> = spheres.collect();
        let shapes = meshes::number_shapes(rng.shuffled(spheres));
        let is_hard = is_unambiguous(&shapes, axis) && is_missed(&shapes, count - 1, count);
        is_hard.then_some(shapes)
    })
}

/// Returns whether a builder with only `count` buckets builds a much more expensive tree.
fn is_missed(shapes: &[Shape], max_leaf_size: usize, count: usize) -> bool {
    /// The minimum cost, relative to the cost of the exact sweep's tree.
    const LEAST: f64 = 1.25;
    let few = BucketedBuilder {
        count,
        extent: BucketExtent::Centers,
        sides: SideRule::AllBuckets,
    };
    let question = cost_question(shapes.to_vec(), max_leaf_size as u32);
    relative_cost(&question, few) >= LEAST
}

/// The number of strips in two layers, and the minimum space between the layers, as a multiple of
/// the extent of the centres along the strips. The maximum space is eight times the minimum.
const STACKS: [(usize, f64); 12] = [
    (12, 0.0001),
    (12, 0.0001),
    (12, 0.001),
    (12, 0.001),
    (12, 0.01),
    (12, 0.01),
    (4, 0.1),
    (6, 0.1),
    (3, 0.01),
    (5, 0.01),
    (8, 0.001),
    (112, 0.01),
];

/// The extent of the strips' centres in the direction of the strips.
const SPREAD: f64 = 2.6;

/// Returns strips that run along one axis and whose centres have these heights along another axis.
/// Along the third axis, the centres extend this far, and each strip has this width.
fn strips(rng: &mut Rng, heights: &[f64], (extent, width): (f64, f64), axis: usize) -> Vec<Shape> {
    let [along, across] = [1, 2].map(|next| DVec3::AXES[(axis + next) % 3]);
    let start = rng.point(3.0);
    let strips = heights.iter().enumerate().map(|(index, height)| {
        let mut from_middle = || match index {
            0 => -0.5,
            _ if index + 1 == heights.len() => 0.5,
            _ => rng.uniform(-0.5, 0.5),
        };
        let (at, beside) = (SPREAD * from_middle(), extent * from_middle());
        let center = start + at * along + beside * across + *height * DVec3::AXES[axis];
        let (half, width) = (rng.uniform(4.5, 5.5) * along, width * across);
        // Some strips have no area.
        let width = if heights.len() == 12 && index % 4 == 2 {
            DVec3::ZERO
        } else {
            width
        };
        let start = center - rng.uniform(0.3, 0.7) * width - half;
        let end = start + 2.0 * half;
        meshes::flat_triangle([start, end, end + width], 0)
    });
    let strips: Vec<Shape> = strips.collect();
    meshes::number_shapes(rng.shuffled(strips))
}

/// Returns two layers of strips that are much longer than the space between the layers. `ratio` is
/// that space divided by the extent of the centres along the strips. If the layers are wide, the
/// centres extend farther along both other axes than along `axis`.
fn stack(
    rng: &mut Rng,
    (count, are_wide): (usize, bool),
    ratio: f64,
    axis: usize,
) -> UnplacedQuestion {
    let space = ratio * SPREAD;
    let shapes = rng.retry(|rng| {
        let heights = (0..count).map(|index| {
            // Neighbours along the strips are in different layers.
            let level = if index % 2 == 0 { 0.0 } else { 0.9 };
            space * (level + rng.uniform(0.0, 0.1))
        });
        let heights: Vec<f64> = heights.collect();
        let extent = if are_wide { 1.3 * space } else { 0.0 };
        let shapes = strips(rng, &heights, (extent, 0.1 * space.min(0.2)), axis);
        is_unambiguous(&shapes, axis).then_some(shapes)
    });
    UnplacedQuestion {
        shapes,
        max_leaf_size: count.div_ceil(2),
        axis,
        detail: space,
    }
}

/// Returns layers of strips with unequal spaces between the layers. The stack is so low that a
/// builder with buckets of the same size along all axes has few buckets along the stack's height
/// and no plane in the best gap.
fn layers(rng: &mut Rng) -> UnplacedQuestion {
    /// The number of strips in each layer.
    const IN_EACH: usize = 4;
    /// The number of buckets along the longest axis.
    const BUCKETS: f64 = 16.0;
    let axis = rng.index(3);
    let shapes = rng.retry(|rng| {
        let ratio = rng.uniform(0.12, 0.25);
        let [a, b, c] = [0, 1, 2].map(|_| rng.uniform(0.0, 1.0));
        let levels = [0.0, a, b, c, 1.0].into_iter();
        let heights = levels.flat_map(|level| vec![ratio * SPREAD * level; IN_EACH]);
        let heights: Vec<f64> = heights.collect();
        let shapes = strips(rng, &heights, (0.0, 0.02), axis);
        let count = (BUCKETS * ratio).ceil() as usize;
        let is_hard = is_unambiguous(&shapes, axis) && is_missed(&shapes, 4 * IN_EACH, count);
        is_hard.then_some(shapes)
    });
    UnplacedQuestion {
        shapes,
        max_leaf_size: 4 * IN_EACH,
        axis,
        detail: 0.1,
    }
}

/// Returns whether every builder with 8 to 64 buckets, or 64 chunks, finds the best partition. The
/// partition must be the best by a clear margin. It must also split the primitives at a gap along
/// this axis that contains a plane of every such builder.
fn is_unambiguous(shapes: &[Shape], axis: usize) -> bool {
    let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
    let Some(gap) = sweep::clear_gap(&boxes, axis) else {
        return false;
    };
    let before = boxes.iter().filter(|it| it.center()[axis] <= gap.0);
    if before.count() % chunk_size(boxes.len()) != 0 {
        return false;
    }
    let node_box = Bounds::enclosing(boxes.iter().copied());
    let center_box = Bounds::around(boxes.iter().map(Bounds::center));
    (8..=64).all(|count| {
        [node_box, center_box].iter().all(|over| {
            let size = (over.max - over.min)[axis];
            let part = |position: f64| (position - over.min[axis]) / size * count as f64;
            // A plane is between the two ends of the gap and not close to either end.
            (part(gap.1) - 0.05).floor() > (part(gap.0) + 0.05).floor()
        })
    })
}
