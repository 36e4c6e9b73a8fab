//! A program with its current scene and camera.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use protocol::{ElementOutcome, Panic};
use view_probe::messages::{
    BoxQueries, Draw, Drawn, Follow, FollowedRay, Request, Response, Target, TreeData, TreeSize,
};
use view_probe::scene_data::{Aim, SceneData, TreeSource};

use crate::model::explanation::{Context, Explanation, explain};
use crate::model::rules::{NodeAddresses, NodeSpan, corners_with_margin, judged_nodes, rows};
use crate::model::tree::TreeModel;
use crate::probe::{Probe, Stop};
use crate::session::{Key, Pinned, Work};
use crate::shared_session::SharedSession;

/// The maximum number of tests to list for a pixel.
const MAX_TESTS: u32 = 4_000;
/// The CPU time limit for reading a tree, explaining a pixel or moving the camera.
const LIMIT: Duration = Duration::from_secs(10);

/// A program that is started when needed, with its current scene and camera.
pub(super) struct OpenProgram<'a> {
    session: &'a SharedSession,
    is_recorded: bool,
    probe: Option<Probe>,
    key: Key,
    aim: Option<Aim>,
    /// The size of the tree.
    size: TreeSize,
    /// The tree, if a pixel has been explained.
    tree: Option<TreeModel>,
}

fn unexpected(response: &Response) -> Stop {
    let why = if *response == Response::NotOpen {
        "it has no scene"
    } else {
        "it sent an invalid answer"
    };
    Stop::Invalid(why.to_owned())
}

impl<'a> OpenProgram<'a> {
    pub(super) fn new(session: &'a SharedSession, is_recorded: bool) -> Self {
        OpenProgram {
            session,
            is_recorded,
            probe: None,
            key: Key::default(),
            aim: None,
            size: TreeSize::default(),
            tree: None,
        }
    }

    /// Ensures that the program has opened the work's scene and camera.
    pub(super) fn prepare(&mut self, work: &Work) -> Result<(), Stop> {
        if self.key.program != work.key.program {
            self.probe = None;
        }
        if self.probe.is_none() || self.key.scene != work.key.scene {
            let opened = self.open(work);
            if opened.is_err() {
                self.probe = None;
            }
            opened?;
        }
        if self.aim != Some(work.aim) {
            let response = self.ask(work, &Request::Aim(work.aim), LIMIT)?;
            if response == Response::NotOpen {
                // Building the tree failed, which has been reported.
                return Err(Stop::Unwanted);
            }
            if response != Response::Aimed {
                return Err(unexpected(&response));
            }
            self.aim = Some(work.aim);
        }
        Ok(())
    }

    fn open(&mut self, work: &Work) -> Result<(), Stop> {
        if self.probe.is_none() {
            let probe = Probe::start(&work.program, work.memory);
            self.probe = Some(probe.map_err(|error| Stop::Invalid(error.to_string()))?);
        }
        let mut data = SceneData::clone(&work.subject.data);
        data.aim = work.aim;
        data.is_recorded = self.is_recorded;
        self.key = work.key;
        self.aim = None;
        self.tree = None;
        let started_at = Instant::now();
        let opened = match self.ask(work, &Request::Open(Box::new(data)), work.open_limit) {
            Ok(Response::Opened(opened)) => opened,
            Ok(other) => return Err(unexpected(&other)),
            Err(Stop::Fault(fault)) => {
                let why = fault.to_string();
                self.session
                    .update(|session, _| session.opening_ended(work.key, &why));
                return Err(Stop::Unwanted);
            }
            Err(stop) => return Err(stop),
        };
        let size = match opened.tree {
            ElementOutcome::Value(size) => Some(size),
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => None,
        };
        let took = started_at.elapsed();
        self.session
            .update(|session, _| session.opened(work.key, opened, took));
        self.size = size.ok_or(Stop::Unwanted)?;
        self.aim = Some(work.aim);
        Ok(())
    }

    /// Sends a request to the program. After a fault or an abandoned request, the program is ended
    /// and restarted when needed.
    fn ask(&mut self, work: &Work, request: &Request, limit: Duration) -> Result<Response, Stop> {
        let session = self.session;
        let is_abandoned = || !session.read(|session, _| session.is_wanted(work.key));
        let probe = self.probe.as_mut().ok_or(Stop::Unwanted)?;
        let response = probe.ask(request, limit, is_abandoned);
        if response.is_err() {
            self.probe = None;
            self.aim = None;
        }
        response
    }

    /// Draws some pixels of a tile.
    pub(super) fn draw(
        &mut self,
        work: &Work,
        draw: &Draw,
        limit: Duration,
    ) -> Result<Drawn, Stop> {
        let response = self.ask(work, &Request::Draw(*draw), limit)?;
        let Response::Drawn(drawn) = response else {
            return Err(unexpected(&response));
        };
        Ok(drawn)
    }

    /// Returns the tree with facts about its nodes.
    pub(super) fn tree(&mut self, work: &Work) -> Result<TreeModel, Stop> {
        if let Some(why) = work.subject.oversize(self.size) {
            return Err(Stop::Invalid(why));
        }
        let limit = work.open_limit.max(LIMIT);
        let response = self.ask(work, &Request::Tree(self.size), limit)?;
        if let Response::Tree(ElementOutcome::Panicked(Panic { message, location })) = &response {
            return Err(Stop::Invalid(format!("panicked: {message} ({location})")));
        }
        let Response::Tree(ElementOutcome::Value(TreeData(tree))) = response else {
            return Err(unexpected(&response));
        };
        Ok(TreeModel::new(tree))
    }

    /// Explains a pixel.
    pub(super) fn explain(&mut self, work: &Work, pinned: &Pinned) -> Result<Explanation, Stop> {
        let tree = match self.tree.take() {
            Some(tree) => tree,
            None => self.tree(work).map_err(|stop| match stop {
                Stop::Unwanted => stop,
                Stop::Fault(_) | Stop::Invalid(_) => {
                    Stop::Invalid(format!("The tree cannot be read: {stop}"))
                }
            })?,
        };
        let explanation = self.explain_in(&tree, work, pinned);
        self.tree = Some(tree);
        explanation
    }

    fn explain_in(
        &mut self,
        tree: &TreeModel,
        work: &Work,
        pinned: &Pinned,
    ) -> Result<Explanation, Stop> {
        let target = match (pinned.pixel, pinned.sample) {
            (Some(pixel), None) => Target::Centre(pixel),
            (Some(pixel), Some(sample)) => Target::Path { pixel, sample },
            (None, _) => {
                let question = work.subject.question.as_ref();
                let ray = question.and_then(|question| question.ray);
                Target::Ray(ray.ok_or(Stop::Unwanted)?)
            }
        };
        let max_tests = MAX_TESTS;
        let request = Request::Follow(Follow { target, max_tests });
        let response = self.ask(work, &request, LIMIT)?;
        let Response::Followed(followed) = response else {
            return Err(unexpected(&response));
        };
        let tests = followed.rays.iter().flat_map(|ray| &ray.tests);
        let context = Context {
            tree,
            shapes: &work.subject.data.shapes,
            is_list: matches!(work.subject.data.tree, TreeSource::List),
            addresses: NodeAddresses::find(tests, tree),
        };
        let rays = followed.rays.iter();
        let spans = rays.map(|ray| self.spans(work, ray, &context));
        let spans: Vec<BTreeMap<u32, NodeSpan>> = spans.collect::<Result<_, _>>()?;
        let (pixel, sample) = (pinned.pixel, pinned.sample);
        Ok(explain(pixel, sample, &followed, &spans, &context))
    }

    /// Returns the parts of a ray inside the boxes of the nodes needed for its explanation.
    fn spans(
        &mut self,
        work: &Work,
        ray: &FollowedRay,
        context: &Context,
    ) -> Result<BTreeMap<u32, NodeSpan>, Stop> {
        let rows = rows(ray, context.tree, context.addresses);
        let nodes = judged_nodes(&rows, context.tree);
        let corners = nodes
            .iter()
            .filter_map(|node| corners_with_margin(*node, context.tree));
        let request = Request::Boxes(BoxQueries {
            ray: ray.ray,
            boxes: corners.flatten().collect(),
        });
        let response = self.ask(work, &request, LIMIT)?;
        let Response::Spans(inside) = response else {
            return Err(unexpected(&response));
        };
        let (pairs, _) = inside.as_chunks();
        let span = |&[inside, inside_larger]: &[_; 2]| NodeSpan {
            inside,
            inside_larger,
        };
        Ok(nodes.into_iter().zip(pairs.iter().map(span)).collect())
    }
}
