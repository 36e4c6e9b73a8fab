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

/// Three clumps, two of which are close together. A builder that forgets the outermost bucket
/// ignores the clump at that end, so it may prefer to split between the two close clumps.
const CLUMPS: Layout<'static> = Layout {
    clumps: &[(0.0, 0.02, 4), (0.74, 0.8, 4), (0.98, 1.0, 4)],
    first_size: SMALL,
    size: SMALL,
    alignment: Alignment::Loose,
};
/// Clumps with a gap from just above one quarter to just below one half. A builder with four
/// buckets doesn't have a plane in this gap.
const GAP: Layout<'static> = Layout {
    clumps: &[
        (0.0, 0.2, 4),
        (0.262, 0.27, 2),
        (0.485, 0.493, 2),
        (0.51, 1.0, 4),
    ],
    first_size: SMALL,
    size: SMALL,
    alignment: Alignment::Loose,
};

/// Three clumps. The first is the largest, but a builder that takes counts and boxes from different
/// buckets overlooks this clump and splits at the other gap.
const HEAVY_END: Layout<'static> = Layout {
    clumps: &[(0.0, 0.02, 6), (0.6, 0.62, 2), (0.98, 1.0, 4)],
    first_size: SMALL,
    size: SMALL,
    alignment: Alignment::Loose,
};

/// Three clumps. The first consists of large primitives, so it is best to split off this clump. The
/// other gap is wider, and a builder that treats primitives as points splits there.
const LARGE_END: Layout<'static> = Layout {
    clumps: &[(0.0, 0.02, 4), (0.42, 0.44, 4), (0.98, 1.0, 4)],
    first_size: 1.2,
    size: 0.01,
    alignment: Alignment::Loose,
};

/// A large primitive beside the best gap. With sixteen buckets, only one plane is in this gap. A
/// builder that stores the cost of one plane with the next one splits on the wrong side of the
/// large primitive.
const NARROW: Layout<'static> = Layout {
    clumps: &[
        (0.4385, 0.4385, 1),
        (0.0, 0.1, 3),
        (0.5615, 0.6, 7),
        (1.0, 1.0, 1),
    ],
    first_size: 1.2,
    size: 0.02,
    alignment: Alignment::Loose,
};

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

/// Generates random primitives for which one split is by far the best.
type Draw = Box<dyn Fn(&mut Rng) -> UnplacedQuestion>;

fn one_split(rng: &mut Rng) -> Vec<ExamQuestion> {
    let sizes = fields::SIZES.len();
    let first = rng.index(sizes);
    let kinds = [
        in_clumps(),
        of_a_few(),
        of_many(),
        of_outliers(),
        of_dense_ends(),
        of_strips(),
    ];
    let kinds = kinds.into_iter().flatten().enumerate();
    let mut questions: Vec<ExamQuestion> = kinds
        .map(|(index, draw)| {
            let size = (first + index) % sizes;
            rng.retry(|rng| draw(rng).question(rng, size))
        })
        .collect();
    questions.extend((0..3).map(|axis| tiny_stack(rng, axis)));
    questions
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

/// Returns functions that generate each layout of clumps along each axis.
fn in_clumps() -> Vec<Draw> {
    /// The factors by which the layouts' primitive counts are multiplied. One layout with a gap
    /// then has over 1,024 primitives.
    const TIMES: [usize; 12] = [1, 5, 2, 20, 1, 96, 1, 5, 2, 20, 1, 50];
    /// The layouts and their leaf sizes. All primitives together never fit in a leaf.
    const LAYOUTS: [(Layout<'static>, usize); 5] = [
        (CLUMPS, 8),
        (GAP, 8),
        (HEAVY_END, 8),
        (LARGE_END, 8),
        (NARROW, 10),
    ];
    let along_axes = (0..LAYOUTS.len()).flat_map(|number| (0..3).map(move |axis| (number, axis)));
    let draw = |(index, (number, axis)): (usize, (usize, usize))| -> Draw {
        let (layout, leaf_size) = LAYOUTS[number];
        let times = TIMES[index % TIMES.len()];
        let clumps = layout.clumps.iter();
        let clumps: Vec<_> = clumps.map(|&(from, to, n)| (from, to, times * n)).collect();
        let alignment = if number >= 3 {
            Alignment::Loose
        } else {
            ALIGNMENTS[(number + axis) % ALIGNMENTS.len()]
        };
        Box::new(move |rng| {
            let layout = Layout {
                clumps: &clumps,
                alignment,
                ..layout
            };
            let is_mirrored = (number + axis).is_multiple_of(2);
            UnplacedQuestion::new(
                row(rng, &layout, axis, is_mirrored),
                times * leaf_size,
                axis,
            )
        })
    };
    along_axes.enumerate().map(draw).collect()
}

/// Returns functions that generate a few primitives: one more than fits in a leaf.
fn of_a_few() -> Vec<Draw> {
    let clusters = [3, 4, 5, 6, 8].into_iter().enumerate();
    let clusters = clusters.map(|(index, count)| -> Draw {
        let alignment = match index % 2 {
            0 => Alignment::Loose,
            _ => ALIGNMENTS[index / 2 % ALIGNMENTS.len()],
        };
        Box::new(move |rng| {
            let axis = rng.index(3);
            let shapes = few(rng, (count, alignment), axis, index % 2 == 0);
            UnplacedQuestion::new(shapes, count - 1, axis)
        })
    });
    let spheres = (3..=6).map(|count| -> Draw {
        Box::new(move |rng| {
            let axis = rng.index(3);
            UnplacedQuestion::new(uneven(rng, count, axis), count - 1, axis)
        })
    });
    clusters.chain(spheres).collect()
}

/// Returns functions that generate two clusters of many primitives.
fn of_many() -> Vec<Draw> {
    let counts = [16_usize, 64, 129, 256, 513, 1100].into_iter();
    let draw = |count: usize| -> Draw {
        Box::new(move |rng| {
            let (axis, is_mirrored) = (rng.index(3), rng.coin());
            let largest = 6 * count / 10 + chunk_size(count);
            let leaf_size = (largest + rng.index(count - largest)).min(1000);
            UnplacedQuestion::new(many(rng, count, axis, is_mirrored), leaf_size, axis)
        })
    };
    counts.map(draw).collect()
}

/// Returns functions that generate a cluster and, far from it, a few outliers. The cluster has more
/// than sixteen times as many primitives as there are outliers.
fn of_outliers() -> Vec<Draw> {
    let counts = [(18, 60), (100, 180), (250, 400)].into_iter();
    let draw = |(least, most): (u32, u32)| -> Draw {
        Box::new(move |rng| {
            let (count, chunk) = in_whole_chunks(rng.integer(least, most) as usize);
            // If there are very many primitives, the outliers are a single chunk.
            let far = chunk * (1 + rng.index((count.min(200) / (20 * chunk)).max(1)));
            let (axis, is_mirrored) = (rng.index(3), rng.coin());
            let layout = Layout {
                clumps: &[(0.0, 0.01, far), (0.9, 1.0, count - far)],
                first_size: SMALL,
                size: SMALL,
                alignment: Alignment::Loose,
            };
            let leaf_size = count - 1 - rng.index(far);
            UnplacedQuestion::new(row(rng, &layout, axis, is_mirrored), leaf_size, axis)
        })
    };
    counts.map(draw).collect()
}

/// Returns functions that generate a dense cluster at one end. The gap beside the cluster ends just
/// short of one seventh of the way along the row, so that no builder with fewer than 8 buckets has
/// a plane there.
fn of_dense_ends() -> Vec<Draw> {
    let counts = [(12, 40), (41, 110), (111, 250), (251, 600)].into_iter();
    let draw = |(least, most): (u32, u32)| -> Draw {
        Box::new(move |rng| {
            let (count, chunk) = in_whole_chunks(rng.integer(least, most) as usize);
            let dense = 6 * count / 10 / chunk * chunk;
            let (axis, is_mirrored) = (rng.index(3), rng.coin());
            let layout = Layout {
                clumps: &[(0.0, 5e-4, dense), (0.141, 1.0, count - dense)],
                first_size: SMALL,
                size: SMALL,
                alignment: Alignment::Loose,
            };
            UnplacedQuestion::new(row(rng, &layout, axis, is_mirrored), dense, axis)
        })
    };
    counts.map(draw).collect()
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

/// Returns functions that generate strips in layers.
fn of_strips() -> Vec<Draw> {
    let stacks = STACKS.iter().enumerate();
    let stacks = stacks.map(|(index, &(count, least))| -> Draw {
        Box::new(move |rng| {
            let ratio = least * rng.log_uniform(1.1, 8.0);
            stack(rng, (count, index % 2 == 1), ratio, index % 3)
        })
    });
    let layers = [(); 2].map(|()| -> Draw { Box::new(layers) });
    stacks.chain(layers).collect()
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
    let layout = Layout {
        clumps: &[(0.0, 0.02, smaller), (0.6, 1.0, count - smaller)],
        first_size: SMALL,
        size: SMALL,
        alignment: Alignment::Loose,
    };
    row(rng, &layout, axis, is_mirrored)
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
