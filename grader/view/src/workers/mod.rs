//! The threads that run the submission's programs.

mod open_program;

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use std::time::Duration;

use protocol::Interval;
use view_probe::messages::{BoxQueries, Follow, Followed, Request, Response, Target};
use view_probe::scene_data::TreeSource;

use crate::model::explanation::{Context, Explanation, corners_with_margin, explain, needed_nodes};
use crate::model::rules::{NodeAddresses, NodeSpan};
use crate::model::tree::TreeModel;
use crate::session::{DrawJob, Key, Pinned, RecordingJob, Work};
use crate::studio::Studio;

use open_program::OpenProgram;

/// The maximum number of tests that are listed for a pixel.
const MAX_TESTS: u32 = 4_000;
/// The limit of CPU time for reading a tree, explaining a pixel, or moving the camera.
const LIMIT: Duration = Duration::from_secs(10);

/// Draws until the process ends.
pub fn draw(studio: &Studio, worker: usize) {
    let mut open = OpenProgram::default();
    loop {
        let work = studio.wait_for_drawing(worker);
        if !open.prepare(studio, &work, false) {
            continue;
        }
        match work.job {
            DrawJob::Draw { tile, draw, limit } => {
                let request = Request::Draw(draw);
                match open.ask(studio, &work, &request, limit) {
                    Some(Ok(Response::Drawn(drawn))) => studio.update(|session, now| {
                        session.drawn(work.key, tile, &draw, &drawn, now);
                    }),
                    Some(Ok(other)) => not_started(studio, work.key, &unexpected(&other)),
                    Some(Err(fault)) => studio.update(|session, _| {
                        session.drawing_ended(work.key, tile, &draw, &fault);
                    }),
                    None => {}
                }
            }
            DrawJob::Tree => match open.tree(studio, &work) {
                Some(Ok(tree)) => {
                    let tree = Arc::new(tree);
                    studio.update(|session, _| session.received_tree(work.key, tree));
                }
                Some(Err(why)) => studio.update(|session, _| session.tree_ended(work.key, why)),
                None => {}
            },
        }
    }
}

/// Records until the process ends.
pub fn record(studio: &Studio) {
    let mut open = OpenProgram::default();
    let mut tree: Option<(Key, NumberedTree)> = None;
    loop {
        let work = studio.wait_for_recording();
        if !open.prepare(studio, &work, true) {
            if let RecordingJob::Explain(pinned) = work.job {
                let why = "the scene could not be opened".to_owned();
                studio.update(|session, _| session.explained(work.key, &pinned, Err(why)));
            }
            continue;
        }
        match work.job {
            RecordingJob::Draw { tile, draw, limit } => {
                match open.ask(studio, &work, &Request::Draw(draw), limit) {
                    Some(Ok(Response::Drawn(drawn))) => studio.update(|session, now| {
                        session.drawn(work.key, tile, &draw, &drawn, now);
                    }),
                    Some(Ok(other)) => not_started(studio, work.key, &unexpected(&other)),
                    Some(Err(fault)) => studio.update(|session, _| {
                        session.drawing_ended(work.key, tile, &draw, &fault);
                    }),
                    None => {}
                }
            }
            RecordingJob::Explain(pinned) => {
                let same = |known: &&(Key, NumberedTree)| {
                    (known.0.program, known.0.scene) == (work.key.program, work.key.scene)
                };
                if tree.as_ref().filter(same).is_none() {
                    tree = None;
                    match open.tree(studio, &work) {
                        Some(Ok(new)) => tree = Some((work.key, NumberedTree::new(new))),
                        Some(Err(why)) => studio.update(|session, _| {
                            let why = format!("The tree cannot be read: {why}");
                            session.explained(work.key, &pinned, Err(why));
                        }),
                        None => {}
                    }
                }
                let Some((_, tree)) = &tree else { continue };
                if let Some(result) = explain_pinned(&mut open, studio, &work, &pinned, tree) {
                    studio.update(|session, _| session.explained(work.key, &pinned, result));
                }
            }
        }
    }
}

fn not_started(studio: &Studio, key: Key, why: &str) {
    studio.update(|session, _| session.not_started(key, why));
}

fn unexpected(response: &Response) -> String {
    match response {
        Response::NotOpen => "it has no scene".to_owned(),
        Response::Opened(_)
        | Response::Aimed
        | Response::Drawn(_)
        | Response::Tree(_)
        | Response::Followed(_)
        | Response::Spans(_) => "it sent an invalid answer".to_owned(),
    }
}

/// A tree whose primitives are numbered, with the leaf of each shape.
struct NumberedTree {
    model: TreeModel,
    leaves: HashMap<u32, u32>,
}

impl NumberedTree {
    fn new(model: TreeModel) -> Self {
        NumberedTree {
            leaves: model.leaves_by_number(),
            model,
        }
    }
}

/// Explains a pixel. Returns `None` if the explanation is no longer wanted.
fn explain_pinned(
    open: &mut OpenProgram,
    studio: &Studio,
    work: &Work<RecordingJob>,
    pinned: &Pinned,
    tree: &NumberedTree,
) -> Option<Result<Explanation, String>> {
    let question = work.subject.question.as_ref();
    let target = match (pinned.pixel, pinned.sample) {
        (Some(pixel), None) => Target::Centre(pixel),
        (Some(pixel), Some(sample)) => Target::Path { pixel, sample },
        (None, _) => Target::Ray(question?.ray?),
    };
    let request = Request::Follow(Follow {
        target,
        max_tests: MAX_TESTS,
    });
    let followed: Followed = match open.ask(studio, work, &request, LIMIT)? {
        Ok(Response::Followed(followed)) => followed,
        Ok(other) => return Some(Err(unexpected(&other))),
        Err(fault) => return Some(Err(fault.to_string())),
    };
    let context = Context {
        tree: &tree.model,
        leaves: &tree.leaves,
        shapes: &work.subject.data.shapes,
        is_list: matches!(work.subject.data.tree, TreeSource::List),
        addresses: NodeAddresses::find(
            followed.rays.iter().flat_map(|ray| &ray.tests),
            &tree.model,
        ),
    };
    let mut spans = Vec::new();
    for ray in &followed.rays {
        let nodes = needed_nodes(ray, &context);
        let boxes = nodes
            .iter()
            .filter_map(|node| corners_with_margin(*node, &tree.model));
        let request = Request::Boxes(BoxQueries {
            ray: ray.ray,
            boxes: boxes.flatten().collect(),
        });
        let inside: Vec<Option<Interval>> = match open.ask(studio, work, &request, LIMIT)? {
            Ok(Response::Spans(inside)) => inside,
            Ok(other) => return Some(Err(unexpected(&other))),
            Err(fault) => return Some(Err(fault.to_string())),
        };
        let (pairs, _) = inside.as_chunks();
        let of_nodes: BTreeMap<u32, NodeSpan> = nodes
            .into_iter()
            .zip(pairs)
            .map(|(node, &[inside, inside_larger])| {
                (
                    node,
                    NodeSpan {
                        inside,
                        inside_larger,
                    },
                )
            })
            .collect();
        spans.push(of_nodes);
    }
    Some(Ok(explain(
        pinned.pixel,
        pinned.sample,
        &followed,
        &spans,
        &context,
    )))
}

/// Starts the threads that draw and record.
pub fn start(studio: &Arc<Studio>, count: usize) -> std::io::Result<()> {
    for worker in 0..count {
        let studio = Arc::clone(studio);
        let thread = std::thread::Builder::new().name(format!("drawing {worker}"));
        thread.spawn(move || draw(&studio, worker))?;
    }
    let studio = Arc::clone(studio);
    let thread = std::thread::Builder::new().name("recording".to_owned());
    thread.spawn(move || record(&studio))?;
    Ok(())
}
