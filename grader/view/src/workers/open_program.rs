//! A program with the scene and the camera that it has.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use grader::probe::Fault;
use protocol::ElementOutcome;
use view_probe::messages::{
    BoxQueries, Draw, Follow, FollowedRay, Request, Response, Target, TreeData, TreeSize,
};
use view_probe::scene_data::{Aim, SceneData, TreeSource};

use crate::model::explanation::{Context, Explanation, explain};
use crate::model::rules::{NodeAddresses, NodeSpan, corners_with_margin, judged_nodes, rows};
use crate::model::tree::TreeModel;
use crate::probe::{NoResponse, Probe};
use crate::session::{Key, Pinned, Work};
use crate::shared_session::SharedSession;

/// The maximum number of tests that are listed for a pixel.
const MAX_TESTS: u32 = 4_000;
/// The limit of CPU time for reading a tree, explaining a pixel, or moving the camera.
const LIMIT: Duration = Duration::from_secs(10);

/// A program that is started when it is needed, with the scene and the camera that it has.
///
/// Its methods return `None` if their result is no longer wanted.
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

    /// Makes sure that the program has the scene and the camera of the work. Returns whether it
    /// has; reasons why it has not are reported.
    pub(super) fn prepare(&mut self, work: &Work) -> bool {
        if self.key.program != work.key.program {
            self.probe = None;
        }
        let has_scene = self.probe.is_some() && self.key.scene == work.key.scene;
        if !has_scene && !self.open(work) {
            self.probe = None;
            return false;
        }
        if self.aim == Some(work.aim) {
            return true;
        }
        match self.ask(work, &Request::Aim(work.aim), LIMIT) {
            Some(Ok(Response::Aimed)) => {
                self.aim = Some(work.aim);
                return true;
            }
            // Building the tree failed, which has been reported.
            Some(Ok(Response::NotOpen)) | None => {}
            Some(Ok(other)) => self.not_started(work, &unexpected(&other)),
            Some(Err(fault)) => self.not_started(work, &fault.to_string()),
        }
        false
    }

    fn open(&mut self, work: &Work) -> bool {
        if self.probe.is_none() {
            match Probe::start(&work.program, work.memory) {
                Ok(probe) => self.probe = Some(probe),
                Err(error) => {
                    self.not_started(work, &error.to_string());
                    return false;
                }
            }
        }
        let mut data = SceneData::clone(&work.subject.data);
        data.aim = work.aim;
        data.is_recorded = self.is_recorded;
        self.key = work.key;
        self.aim = None;
        self.tree = None;
        let started_at = Instant::now();
        match self.ask(work, &Request::Open(Box::new(data)), work.open_limit) {
            Some(Ok(Response::Opened(opened))) => {
                let size = match opened.tree {
                    ElementOutcome::Value(size) => Some(size),
                    ElementOutcome::Panicked(_) | ElementOutcome::Skipped => None,
                };
                let took = started_at.elapsed();
                self.session
                    .update(|session, _| session.opened(work.key, opened, took));
                self.size = size.unwrap_or_default();
                self.aim = size.map(|_| work.aim);
                return size.is_some();
            }
            Some(Ok(other)) => self.not_started(work, &unexpected(&other)),
            Some(Err(fault)) => {
                let why = fault.to_string();
                self.session
                    .update(|session, _| session.opening_ended(work.key, &why));
            }
            None => {}
        }
        false
    }

    fn not_started(&self, work: &Work, why: &str) {
        self.session
            .update(|session, _| session.not_started(work.key, why));
    }

    /// Asks the program. After a fault or an abandoned request, the program has ended, and is
    /// started again when it is needed.
    fn ask(
        &mut self,
        work: &Work,
        request: &Request,
        limit: Duration,
    ) -> Option<Result<Response, Fault>> {
        let session = self.session;
        let is_abandoned = || !session.read(|session, _| session.is_wanted(work.key));
        let response = self.probe.as_mut()?.ask(request, limit, is_abandoned);
        if response.is_err() {
            self.probe = None;
            self.aim = None;
        }
        match response {
            Ok(response) => Some(Ok(response)),
            Err(NoResponse::Fault(fault)) => Some(Err(fault)),
            Err(NoResponse::Abandoned) => None,
        }
    }

    /// Draws some pixels of a tile, and reports them.
    pub(super) fn draw(&mut self, work: &Work, tile: usize, draw: &Draw, limit: Duration) {
        match self.ask(work, &Request::Draw(*draw), limit) {
            Some(Ok(Response::Drawn(drawn))) => self.session.update(|session, now| {
                session.drawn(work.key, tile, draw, &drawn, now);
            }),
            Some(Ok(other)) => self.not_started(work, &unexpected(&other)),
            Some(Err(fault)) => self.session.update(|session, _| {
                session.drawing_ended(work.key, tile, draw, &fault);
            }),
            None => {}
        }
    }

    /// Returns the tree with facts about its nodes, or the reason why there is none.
    pub(super) fn tree(&mut self, work: &Work) -> Option<Result<TreeModel, String>> {
        if let Some(why) = work.subject.oversize(self.size) {
            return Some(Err(why));
        }
        let (request, limit) = (Request::Tree(self.size), work.open_limit.max(LIMIT));
        Some(match self.ask(work, &request, limit)? {
            Ok(Response::Tree(ElementOutcome::Value(TreeData(tree)))) => Ok(TreeModel::new(tree)),
            Ok(Response::Tree(ElementOutcome::Panicked(panic))) => {
                Err(format!("panicked: {} ({})", panic.message, panic.location))
            }
            Ok(other) => Err(unexpected(&other)),
            Err(fault) => Err(fault.to_string()),
        })
    }

    /// Explains a pixel, or returns the reason why it is not explained.
    pub(super) fn explain(
        &mut self,
        work: &Work,
        pinned: &Pinned,
    ) -> Option<Result<Explanation, String>> {
        let tree = match self.tree.take() {
            Some(tree) => tree,
            None => match self.tree(work)? {
                Ok(tree) => tree,
                Err(why) => return Some(Err(format!("The tree cannot be read: {why}"))),
            },
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
    ) -> Option<Result<Explanation, String>> {
        let question = work.subject.question.as_ref();
        let target = match (pinned.pixel, pinned.sample) {
            (Some(pixel), None) => Target::Centre(pixel),
            (Some(pixel), Some(sample)) => Target::Path { pixel, sample },
            (None, _) => Target::Ray(question?.ray?),
        };
        let max_tests = MAX_TESTS;
        let request = Request::Follow(Follow { target, max_tests });
        let followed = match self.ask(work, &request, LIMIT)? {
            Ok(Response::Followed(followed)) => followed,
            other => return Some(Err(reason(other))),
        };
        let tests = followed.rays.iter().flat_map(|ray| &ray.tests);
        let context = Context {
            tree,
            shapes: &work.subject.data.shapes,
            is_list: matches!(work.subject.data.tree, TreeSource::List),
            addresses: NodeAddresses::find(tests, tree),
        };
        let mut spans = Vec::new();
        for ray in &followed.rays {
            match self.spans(work, ray, &context)? {
                Ok(of_ray) => spans.push(of_ray),
                Err(why) => return Some(Err(why)),
            }
        }
        let (pixel, sample) = (pinned.pixel, pinned.sample);
        Some(Ok(explain(pixel, sample, &followed, &spans, &context)))
    }

    /// Returns the parts of a ray in the boxes of the nodes that its explanation needs.
    fn spans(
        &mut self,
        work: &Work,
        ray: &FollowedRay,
        context: &Context,
    ) -> Option<Result<BTreeMap<u32, NodeSpan>, String>> {
        let rows = rows(ray, context.tree, context.addresses);
        let nodes = judged_nodes(&rows, context.tree);
        let corners = nodes
            .iter()
            .filter_map(|node| corners_with_margin(*node, context.tree));
        let request = Request::Boxes(BoxQueries {
            ray: ray.ray,
            boxes: corners.flatten().collect(),
        });
        let inside = match self.ask(work, &request, LIMIT)? {
            Ok(Response::Spans(inside)) => inside,
            other => return Some(Err(reason(other))),
        };
        let (pairs, _) = inside.as_chunks();
        let span = |&[inside, inside_larger]: &[_; 2]| NodeSpan {
            inside,
            inside_larger,
        };
        Some(Ok(nodes.into_iter().zip(pairs.iter().map(span)).collect()))
    }
}

/// Returns why a response is not the one that was asked for.
fn reason(response: Result<Response, Fault>) -> String {
    match response {
        Ok(response) => unexpected(&response),
        Err(fault) => fault.to_string(),
    }
}

fn unexpected(response: &Response) -> String {
    let is_open = *response != Response::NotOpen;
    let why = if is_open {
        "it sent an invalid answer"
    } else {
        "it has no scene"
    };
    why.to_owned()
}
