//! A whole question again at another size and place: as dust, and in a room. Code that depends on
//! absolute sizes, or on being near the origin, is right in one place and wrong in another.

use glam::Vec3;
use judging::exam::{ExamQuestion, ExpectedHit, Key};
use protocol::{Interval, Question, Ray, Rays, Shape, TreeNode};

use super::place::moved_shape;
use crate::oracle::bbox::Bounds;
use crate::oracle::scan;
use crate::seed::Rng;
use crate::tree::{Tree, decoy};

/// A change of size and place of a whole question.
#[derive(Clone, Copy, Debug)]
struct Similarity {
    /// A power of two.
    scale: f32,
    offset: Vec3,
}

/// Returns the same question about things that are a quarter of a millionth as large. The factor is
/// a power of two, so code without an absolute number computes the same digits, and is as far from
/// any decision as before.
///
/// # Panics
///
/// If the question is not about shapes, boxes or trees with a list of rays.
pub(super) fn dust(asked: ExamQuestion) -> ExamQuestion {
    let similarity = Similarity {
        scale: 1.0 / (1 << 22) as f32,
        offset: Vec3::ZERO,
    };
    similarity
        .question(asked)
        .expect("the question has a list of rays")
}

/// Returns the same question about things that are as large and as far from the origin as those of
/// the Cornell box, whatever their size was. Returns `None` if it is not about a list of rays, or
/// about nothing.
///
/// Small integers stay exact: the factor is a power of two, and the offset consists of integers.
pub(super) fn in_a_room(rng: &mut Rng, asked: &ExamQuestion) -> Option<ExamQuestion> {
    const SIZE: f64 = 64.0;
    let bounds = match &asked.question {
        Question::Shapes { shapes, .. } | Question::Traverse { shapes, .. } => shapes
            .iter()
            .map(scan::bounds)
            .reduce(|all, next| all.union(&next))?,
        Question::BBox { min, max, .. } => Bounds {
            min: min.as_dvec3(),
            max: max.as_dvec3(),
        },
        Question::Camera { .. }
        | Question::Build { .. }
        | Question::BuildAndTraverse { .. }
        | Question::Radiance { .. }
        | Question::Done => return None,
    };
    if bounds.diagonal() <= 0.0 {
        return None;
    }
    // Far from the origin, rounding moves everything a little, and what was only just fair need not be.
    rng.retry(|rng| {
        let mut far = || (rng.sign() * rng.uniform(150.0, 400.0).round()) as f32;
        let similarity = Similarity {
            scale: (SIZE / bounds.diagonal()).log2().floor().exp2() as f32,
            offset: Vec3::new(far(), far(), far()),
        };
        let moved = similarity.question(asked.clone());
        moved.as_ref().is_none_or(is_fair).then_some(moved)
    })
}

/// Returns whether a question about a tree is fair.
fn is_fair(asked: &ExamQuestion) -> bool {
    match &asked.question {
        Question::Traverse {
            shapes,
            nodes,
            root,
            rays,
        } => {
            let tree = Tree {
                shapes: shapes.clone(),
                nodes: nodes.clone(),
                root: *root as usize,
            };
            decoy::is_fair(&tree, &rays.to_vec())
        }
        Question::Camera { .. }
        | Question::Shapes { .. }
        | Question::BBox { .. }
        | Question::Build { .. }
        | Question::BuildAndTraverse { .. }
        | Question::Radiance { .. }
        | Question::Done => true,
    }
}

impl Similarity {
    fn question(self, asked: ExamQuestion) -> Option<ExamQuestion> {
        let shapes = |shapes: Vec<Shape>| shapes.iter().map(|shape| self.shape(shape)).collect();
        let question = match asked.question {
            Question::Shapes { shapes: all, rays } => Question::Shapes {
                shapes: shapes(all),
                rays: self.rays(rays)?,
            },
            Question::BBox { min, max, queries } => {
                let queries = queries.iter();
                let queries = queries.map(|(ray, times)| (self.ray(ray), self.interval(*times)));
                Question::BBox {
                    min: self.point(min),
                    max: self.point(max),
                    queries: queries.collect(),
                }
            }
            Question::Build {
                shapes: all,
                max_leaf_size,
            } => Question::Build {
                shapes: shapes(all),
                max_leaf_size,
            },
            Question::Traverse {
                shapes: all,
                nodes,
                root,
                rays,
            } => Question::Traverse {
                shapes: shapes(all),
                nodes: nodes.iter().map(|node| self.node(node)).collect(),
                root,
                rays: self.rays(rays)?,
            },
            Question::Camera { .. }
            | Question::BuildAndTraverse { .. }
            | Question::Radiance { .. }
            | Question::Done => return None,
        };
        let key = match asked.key {
            Key::Hits { checks, hits } => Key::Hits {
                checks,
                hits: hits
                    .into_iter()
                    .map(|hit| hit.map(|hit| self.hit(hit)))
                    .collect(),
            },
            Key::Spans { spans } => Key::Spans {
                spans: spans
                    .into_iter()
                    .map(|span| span.map(|span| self.interval(span)))
                    .collect(),
            },
            // A tree's cost is a ratio of areas.
            key @ Key::Tree { .. } => key,
            Key::Rays { .. } | Key::FirstHits { .. } | Key::Radiance { .. } => return None,
        };
        Some(ExamQuestion::new(question, key))
    }

    fn point(self, point: Vec3) -> Vec3 {
        point * self.scale + self.offset
    }

    fn shape(self, shape: &Shape) -> Shape {
        moved_shape(
            shape,
            |point| self.point(point),
            |length| length * self.scale,
        )
    }

    /// Returns `None` for the rays of a picture.
    fn rays(self, rays: Rays) -> Option<Rays> {
        match rays {
            Rays::List(list) => Some(Rays::List(list.iter().map(|ray| self.ray(ray)).collect())),
            Rays::View(_) => None,
        }
    }

    fn ray(self, ray: &Ray) -> Ray {
        Ray {
            origin: self.point(ray.origin),
            range: self.interval(ray.range),
            ..*ray
        }
    }

    fn interval(self, times: Interval) -> Interval {
        Interval::new(times.min * self.scale, times.max * self.scale)
    }

    /// Moves a node. A sphere's centre and its box are rounded separately, so the box gets larger by
    /// two units in the last place, to contain the sphere. A flat box stays flat.
    fn node(self, node: &TreeNode) -> TreeNode {
        let (mut min, mut max) = (self.point(node.min), self.point(node.max));
        for axis in 0..3 {
            if self.offset != Vec3::ZERO && min[axis] < max[axis] {
                min[axis] = min[axis].next_down().next_down();
                max[axis] = max[axis].next_up().next_up();
            }
        }
        TreeNode { min, max, ..*node }
    }

    fn hit(self, hit: ExpectedHit) -> ExpectedHit {
        ExpectedHit {
            distance: hit.distance * self.scale,
            position: self.point(hit.position),
            ..hit
        }
    }
}
