//! The tests for a ray, or for all rays in a path, as shown on the page.

mod remarks;
mod types;

use std::collections::{BTreeMap, BTreeSet};

use glam::UVec2;
use protocol::Shape;
use view_probe::indexed_tree::IndexedTree;
use view_probe::messages::{RecordedRay, RecordedRays, Test};
use view_probe::rules::{self, NodeAddresses, NodeSpan, Row};

use types::BounceRow;
pub use types::{ExplainedHit, ExplainedRay, ExplainedTest, Explanation, TestOutcome};

/// The scene that the rays are traced in.
pub struct Context<'a> {
    /// The tree, with numbered primitives.
    pub tree: &'a IndexedTree,
    /// All shapes.
    pub shapes: &'a [Shape],
    /// Whether the shapes are tested as a list, because the question isn't about a tree.
    pub is_list: bool,
    /// The addresses of the nodes in memory, if known.
    pub addresses: Option<NodeAddresses>,
}

/// Explains the rays in a recording. For each ray, `spans` contains the spans of the judged nodes.
pub fn explain(
    pixel: Option<UVec2>,
    sample: Option<u32>,
    followed: &RecordedRays,
    spans: &[BTreeMap<u32, NodeSpan>],
    context: &Context,
) -> Explanation {
    let rays = followed.rays.iter().zip(spans).enumerate();
    let mut bounce = 0;
    let explained = rays.map(|(index, (ray, spans))| {
        // A shadow ray to the sky doesn't end, but the path tracer then logs the light it found.
        let next_step = followed.steps.get(ray.steps_before);
        let is_to_sky = next_step.is_some_and(|step| step.starts_with("light: "));
        let (kind, is_shadow_ray) = match pixel {
            None => ("ray from the exam".to_owned(), false),
            Some(_) if index == 0 => ("camera ray".to_owned(), false),
            Some(_) if ray.ray.range.max.is_finite() => ("shadow ray to a light".to_owned(), true),
            Some(_) if is_to_sky => ("shadow ray to the sky".to_owned(), true),
            Some(_) => {
                bounce += 1;
                (format!("ray after bounce {bounce}"), false)
            }
        };
        ExplainedRay {
            is_shadow_ray,
            ..explain_ray(kind, ray, spans, context)
        }
    });
    Explanation {
        pixel,
        sample,
        rays: explained.collect(),
        radiance: followed.radiance,
        steps: followed.steps.clone(),
        bounces: followed.bounces.iter().map(BounceRow::from).collect(),
        history: Vec::new(),
        history_problem: None,
        panic: followed
            .panic
            .clone()
            .map(|panic| [panic.message, panic.location]),
    }
}

fn explain_ray(
    kind: String,
    ray: &RecordedRay,
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
        is_shadow_ray: false,
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

/// The state of a traversal while its tests are explained one by one.
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
        ray: &RecordedRay,
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
            outcome: TestOutcome::Missed,
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
                        TestOutcome::Entered
                    }
                    Some(inside) if beyond(inside.min) => TestOutcome::SkippedBeyond,
                    Some(_) => TestOutcome::NotEntered,
                    None if whole.is_some() => TestOutcome::OutsideTimes,
                    None => TestOutcome::Missed,
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
                    None => TestOutcome::NoHit,
                    Some(t) if ray.ray.range.contains(t) && self.closest.is_none_or(|c| t < c) => {
                        self.closest = Some(t);
                        TestOutcome::Closest
                    }
                    Some(_) => TestOutcome::Farther,
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
fn closest_hit(ray: &RecordedRay) -> Option<f32> {
    let distances = ray.tests.iter().filter_map(|test| match test {
        Test::Primitive { distance, .. } => *distance,
        Test::Box { .. } => None,
    });
    let in_range = distances.filter(|distance| ray.ray.range.contains(*distance));
    in_range.reduce(f32::min)
}
