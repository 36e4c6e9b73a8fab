//! The tests of a ray, or of all rays of a path, as shown on the page.

mod remarks;
mod types;

use std::collections::{BTreeMap, BTreeSet};

use glam::UVec2;
use protocol::Shape;
use view_probe::messages::{Followed, FollowedRay, Test};

use crate::model::rules::{self, NodeAddresses, NodeSpan, Row};
use crate::model::tree::TreeModel;

pub use types::{ExplainedHit, ExplainedRay, ExplainedTest, Explanation, Outcome};

/// The scene that the rays are traced in.
pub struct Context<'a> {
    /// The tree, with numbered primitives.
    pub tree: &'a TreeModel,
    /// All shapes.
    pub shapes: &'a [Shape],
    /// Whether the shapes are tested as a list, because the question isn't about a tree.
    pub is_list: bool,
    /// The addresses of the nodes in memory, if known.
    pub addresses: Option<NodeAddresses>,
}

/// Explains the rays of a recording. `spans` contains the spans of the judged nodes for each ray.
pub fn explain(
    pixel: Option<UVec2>,
    sample: Option<u32>,
    followed: &Followed,
    spans: &[BTreeMap<u32, NodeSpan>],
    context: &Context,
) -> Explanation {
    let rays = followed.rays.iter().zip(spans).enumerate();
    let mut bounce = 0;
    let explained = rays.map(|(index, (ray, spans))| {
        let kind = match (pixel, ray.ray.range.max.is_finite()) {
            (None, _) => "ray of the exam".to_owned(),
            (Some(_), _) if index == 0 => "camera ray".to_owned(),
            (Some(_), true) => "shadow ray, to a light".to_owned(),
            (Some(_), false) => {
                bounce += 1;
                format!("ray after bounce {bounce}")
            }
        };
        explain_ray(kind, ray, spans, context)
    });
    Explanation {
        pixel,
        sample,
        rays: explained.collect(),
        radiance: followed.radiance,
        panic: followed
            .panic
            .clone()
            .map(|panic| [panic.message, panic.location]),
    }
}

fn explain_ray(
    kind: String,
    ray: &FollowedRay,
    spans: &BTreeMap<u32, NodeSpan>,
    context: &Context,
) -> ExplainedRay {
    let rows = rules::rows(ray, context.tree, context.addresses);
    let broken = rules::broken_rules(ray, &rows, context.tree, spans);
    let entered: BTreeSet<u32> = rows
        .iter()
        .flat_map(|row| row.enters.iter().chain(&row.may_enter))
        .copied()
        .collect();
    let mut state = State {
        closest: None,
        at_the_end: closest_hit(ray),
        tested: BTreeSet::new(),
    };
    let all = rows.iter().zip(&ray.tests).zip(broken);
    let tests: Vec<ExplainedTest> = all
        .map(|((row, test), broken)| ExplainedTest {
            marks: broken.into_iter().collect(),
            ..state.explain(row, test, ray, &entered, spans, context)
        })
        .collect();
    let closest = state.closest;
    let ray_end = |t: f32| t.is_finite().then_some(t);
    ExplainedRay {
        kind,
        origin: ray.ray.origin,
        dir: ray.ray.dir,
        range: [ray_end(ray.ray.range.min), ray_end(ray.ray.range.max)],
        hit: ray.hit.map(|trace| ExplainedHit {
            distance: trace.distance,
            position: trace.position,
            shape: trace.shape,
        }),
        notes: remarks::remarks(ray, &tests, closest, context),
        rows: tests,
        boxes: ray.counts.boxes,
        primitives: ray.counts.primitives,
    }
}

/// The state of a traversal while explaining its tests one after the other.
struct State {
    closest: Option<f32>,
    /// The closest hit after all tests. A node is often skipped long after its box was tested.
    at_the_end: Option<f32>,
    tested: BTreeSet<u32>,
}

impl State {
    fn explain(
        &mut self,
        row: &Row,
        test: &Test,
        ray: &FollowedRay,
        entered: &BTreeSet<u32>,
        spans: &BTreeMap<u32, NodeSpan>,
        context: &Context,
    ) -> ExplainedTest {
        let level = row.nodes.first().and_then(|node| context.tree.level(*node));
        let base = ExplainedTest {
            is_box: true,
            nodes: row.nodes.clone(),
            level,
            shape: None,
            corners: None,
            triangle: None,
            outcome: Outcome::Missed,
            at: Vec::new(),
            closest: self.closest,
            marks: Vec::new(),
            again: false,
        };
        match *test {
            Test::Box {
                min, max, inside, ..
            } => {
                let whole = row.nodes.first().and_then(|node| spans.get(node)?.inside);
                let beyond = |from: f32| self.at_the_end.is_some_and(|closest| from > closest);
                let outcome = match inside {
                    Some(_) if row.nodes.iter().any(|node| entered.contains(node)) => {
                        Outcome::Entered
                    }
                    Some(inside) if beyond(inside.min) => Outcome::SkippedBeyond,
                    Some(_) => Outcome::NotEntered,
                    None if whole.is_some() => Outcome::OutsideTimes,
                    None => Outcome::Missed,
                };
                let span = inside.or(whole);
                ExplainedTest {
                    corners: Some([min, max]),
                    outcome,
                    at: span.map_or(Vec::new(), |span| vec![span.min, span.max]),
                    ..base
                }
            }
            Test::Primitive {
                shape, distance, ..
            } => {
                let outcome = match distance {
                    None => Outcome::NoHit,
                    Some(t) if ray.ray.range.contains(t) && self.closest.is_none_or(|c| t < c) => {
                        self.closest = Some(t);
                        Outcome::Closest
                    }
                    Some(_) => Outcome::Farther,
                };
                let (corners, triangle) = match context.shapes.get(shape as usize) {
                    None => (None, None),
                    Some(Shape::Sphere { center, radius, .. }) => {
                        (Some([center - radius, center + radius]), None)
                    }
                    Some(Shape::Triangle { vertices, .. }) => {
                        (None, Some(vertices.map(|vertex| vertex.position)))
                    }
                    Some(Shape::FlatTriangle { corners, .. }) => (None, Some(*corners)),
                };
                ExplainedTest {
                    is_box: false,
                    shape: Some(shape),
                    corners,
                    triangle,
                    outcome,
                    at: distance.into_iter().collect(),
                    closest: self.closest,
                    again: !self.tested.insert(shape),
                    ..base
                }
            }
        }
    }
}

/// Returns the distance of the closest hit found by the listed tests.
fn closest_hit(ray: &FollowedRay) -> Option<f32> {
    let distances = ray.tests.iter().filter_map(|test| match test {
        Test::Primitive { distance, .. } => *distance,
        Test::Box { .. } => None,
    });
    let in_range = distances.filter(|distance| ray.ray.range.contains(*distance));
    in_range.reduce(f32::min)
}
