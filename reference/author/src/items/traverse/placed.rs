//! Questions about trees are generated with sizes of about one, near the origin. This module gives
//! them sizes and positions from the domain.

use glam::{DVec3, Vec3};
use judging::exam::{ExamQuestion, Key};
use protocol::{Geometry, Question, Ray, Rows, Shape};

use crate::domains::Call;
use crate::domains::fields::{self, FURTHEST, is_same_line};
use crate::domains::shape::ShapeCall;
use crate::domains::sphere::Line;
use crate::items::hits_key;
use crate::items::transform::{Transform, moved};
use crate::oracle::bbox::Bounds;
use crate::oracle::{Intersection, Ray64, scan};
use crate::seed::{Rng, Seed};
use crate::tree::{Tree, construction, decoy};

/// Moves the questions, item by item, so that all sizes and octants occur equally often.
pub(super) struct Mover {
    rng: Rng,
    /// The number of transforms generated so far.
    count: usize,
}

impl Mover {
    pub(super) fn new(seed: Seed) -> Self {
        let mut rng = seed.rng("traverse.places");
        let count = rng.index(fields::SIZES.len());
        Mover { rng, count }
    }

    /// Moves all of an item's questions about lists of rays. A question that begins with the last
    /// ray of the previous question stays together with that question.
    pub(super) fn move_all(&mut self, questions: &mut [ExamQuestion]) {
        let together = |a: &ExamQuestion, b: &ExamQuestion| {
            let (a, b) = (rays(a), rays(b));
            let ends = a
                .as_ref()
                .and_then(|a| a.last())
                .zip(b.as_ref().and_then(|b| b.first()));
            ends.is_some_and(|(a, b)| is_same_line(a, b))
        };
        for group in questions.chunk_by_mut(together) {
            let rays = rays(&group[0]);
            if rays.is_none_or(|rays| rays.iter().any(is_far_away)) || is_dust(&group[0]) {
                continue;
            }
            /// The number of transforms to try at each size.
            const ATTEMPTS: usize = 1000;
            let sizes = fields::SIZES.len();
            let size = self.count % sizes;
            let octant = (self.count / sizes + self.count) % fields::OCTANTS.len();
            self.count += 1;
            // If a ray starts so far away that the question doesn't fit anywhere at this size, a
            // smaller size is used. A question that wouldn't be fair anywhere else isn't moved.
            let placed = (0..=size).rev().find_map(|size| {
                self.rng.attempt(ATTEMPTS, |rng| {
                    let transform = transform(rng, group, size, octant)?;
                    let moved = group.iter().map(|asked| transformed(transform, asked));
                    moved.collect::<Option<Vec<ExamQuestion>>>()
                })
            });
            if let Some(placed) = placed {
                group.clone_from_slice(&placed);
            }
        }
    }
}

/// Returns the question with its scene shrunk to the size of a speck of dust. The new question is
/// just as fair, since correct code computes the same digits when all lengths are scaled by a power
/// of two.
pub(super) fn as_dust(asked: &ExamQuestion) -> ExamQuestion {
    let dust = Transform::new(1.0 / f64::from(1 << 22), DVec3::ZERO);
    moved(dust, asked).expect("the question has a list of rows")
}

/// Returns whether a question is about shapes as small as dust.
fn is_dust(asked: &ExamQuestion) -> bool {
    let bounds = Bounds::enclosing(shapes(asked).iter().map(scan::bounds));
    bounds.diagonal() < 1e-4
}

/// Returns the rays of a question about a list of rays.
fn rays(asked: &ExamQuestion) -> Option<Vec<Ray>> {
    let Question::Hit(table) = &asked.question else {
        return None;
    };
    match &table.rows {
        Rows::List(rays) => Some(rays.clone()),
        Rows::Picture(_) => None,
    }
}

/// Returns whether a ray starts at the edge of the scene, so that it cannot be moved.
fn is_far_away(ray: &Ray) -> bool {
    f64::from(ray.origin.abs().max_element()) > 0.5 * FURTHEST
}

/// Returns a question scaled to the largest size that keeps all rays and shapes in the scene, or
/// `None` if it isn't fair at that size.
pub(super) fn across_the_scene(asked: &ExamQuestion) -> Option<ExamQuestion> {
    let starts = rays(asked)?;
    let starts = starts.iter().map(|ray| {
        let start = ray.origin.as_dvec3();
        Bounds::around([start])
    });
    let all = Bounds::enclosing(starts.chain(shapes(asked).iter().map(scan::bounds)));
    let scale = 1.98 * FURTHEST / (all.max - all.min).max_element();
    transformed(Transform::new(scale, -scale * all.center()), asked)
}

/// Picks a random transform that moves a question to an octant without making any coordinate too
/// large.
fn transform(
    rng: &mut Rng,
    group: &[ExamQuestion],
    size: usize,
    octant: usize,
) -> Option<Transform> {
    let shapes: Vec<Shape> = group.iter().flat_map(shapes).copied().collect();
    let size = fields::size(rng, size);
    let signs = [0, 1, 2].map(|axis| if octant >> axis & 1 == 0 { 1.0 } else { -1.0 });
    let center = fields::place(rng, size).abs() * DVec3::from_array(signs);
    let transform = Transform::around(&shapes, size, center);
    let starts = group
        .iter()
        .flat_map(|asked| rays(asked).unwrap_or_default());
    let points = starts.map(|ray| ray.origin);
    let corners = shapes.iter().flat_map(|shape| {
        let Bounds { min, max } = scan::bounds(shape);
        [min.as_vec3(), max.as_vec3()]
    });
    let is_near = |point: Vec3| f64::from(transform.point(point).abs().max_element()) <= FURTHEST;
    (transform.keeps_digits(&shapes) && points.chain(corners).all(is_near)).then_some(transform)
}

fn shapes(asked: &ExamQuestion) -> &[Shape] {
    if let Question::Hit(table) = &asked.question {
        table.subject.shapes()
    } else {
        &[]
    }
}

/// Returns a transformed question with a key for its new numbers, or `None` if the transformed
/// question isn't fair.
pub(super) fn transformed(transform: Transform, asked: &ExamQuestion) -> Option<ExamQuestion> {
    let asked = moved(transform, asked)?;
    let (Question::Hit(table), Key::Table { judged, .. }) = (&asked.question, &asked.key) else {
        return None;
    };
    let judged: Vec<&str> = judged.iter().map(String::as_str).collect();
    let rays = table.rows.to_vec();
    let (tree, is_built) = match &table.subject {
        Geometry::List { .. } => return None,
        Geometry::Tree { .. } => (Tree::in_question(&asked.question)?.0, false),
        Geometry::BuiltTree { shapes, .. } if shapes.is_empty() => (Tree::default(), true),
        Geometry::BuiltTree { shapes, .. } => (construction::median_split(shapes.clone(), 8), true),
    };
    let answer = |ray64: &Ray64| {
        if is_built {
            scan::closest_hit(ray64, &tree.shapes)
        } else {
            tree.expected_hit(ray64)
        }
    };
    let is_exact = |ray: &Ray| {
        let hit = answer(&Ray64::from(ray));
        judged == ["distance"] || hit.is_none_or(|hit| is_exact(&tree.shapes, ray, &hit))
    };
    let is_fair = decoy::is_fair(&tree, &rays)
        && are_clear_of_faces(&tree, &rays, FACE_MARGIN)
        && rays.iter().all(is_exact);
    is_fair.then(|| {
        let key = hits_key(&judged, &rays, answer);
        ExamQuestion::new(asked.question.clone(), key)
    })
}

/// Returns whether all rays along an axis or parallel to a coordinate plane avoid the planes of all
/// box faces. No question tests whether a ray in the plane of a face hits the box. The boxes of
/// decoys are ignored.
pub(super) fn are_clear_of_faces(tree: &Tree, rays: &[Ray], margin: f64) -> bool {
    let ordinary = tree.ordinary_primitives();
    let shapes = tree.shapes.iter().zip(&ordinary);
    let shapes = shapes.filter(|(_, ordinary)| **ordinary || tree.nodes.is_empty());
    let of_nodes = (0..tree.nodes.len()).map(|index| tree.bounds(index));
    let boxes: Vec<Bounds> = of_nodes
        .chain(shapes.map(|(shape, _)| scan::bounds(shape)))
        .collect();
    let whole = Bounds::enclosing(boxes.iter().copied());
    let margin = margin * (whole.max - whole.min).max_element();
    rays.iter().all(|ray| {
        let (start, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
        let mut parallel = (0..3).filter(|&axis| dir[axis] == 0.0);
        parallel.all(|axis| {
            let mut faces = boxes.iter().flat_map(|it| [it.min[axis], it.max[axis]]);
            faces.all(|face| (start[axis] - face).abs() > margin)
        })
    })
}

/// Returns whether a ray is far enough from all faces to stay clear of them when the tree is moved.
pub(super) fn is_clear_of_faces(tree: &Tree, ray: &Ray) -> bool {
    are_clear_of_faces(tree, &[*ray], 3.0 * FACE_MARGIN)
}

/// The minimum distance between the plane of a face and a ray parallel to it, as a fraction of the
/// tree's longest side.
const FACE_MARGIN: f64 = 1e-4;

/// Returns whether all correct formulas compute every quantity of a hit well within its tolerance,
/// both here and as far from the origin as most trees are after they have been moved.
pub(super) fn is_exact_elsewhere(shapes: &[Shape], ray: &Ray, hit: &Intersection) -> bool {
    let transform = Transform::around(&[], 1.0, DVec3::splat(50.0));
    let (shapes, ray) = (transform.shapes(shapes), transform.ray(ray));
    is_exact(&shapes, &ray, hit)
}

/// Returns whether all correct formulas compute every quantity of a hit well within its tolerance.
fn is_exact(shapes: &[Shape], ray: &Ray, hit: &Intersection) -> bool {
    /// The largest coordinate, as a multiple of a triangle's size.
    const MOST: f64 = 1000.0;
    let mut shapes = shapes.iter();
    let shape = *shapes
        .find(|shape| shape.number() == hit.shape)
        .expect("the shape that is hit belongs to the tree");
    if let Some(line) = Line::of(&ShapeCall::new(shape, *ray)) {
        let judged = ["distance", "position", "normal", "uv"];
        return judged.iter().all(|quantity| line.is_exact(quantity));
    }
    let Bounds { min, max } = scan::bounds(&shape);
    let largest: DVec3 = min.abs().max(max.abs()).max(ray.origin.as_dvec3().abs());
    largest.max_element() <= MOST * 0.5 * (max - min).max_element()
}
