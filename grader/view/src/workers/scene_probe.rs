//! A program with its current scene and camera.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use glam::{UVec2, Vec3};
use grader::probe::Fault;
use protocol::{ElementOutcome, Panic, Ray};
use view_probe::indexed_tree::IndexedTree;
use view_probe::messages::{
    Draw, DrawnPixels, Follow, Quantity, RecordedRay, RecordedRays, Request, Response,
    SubmissionPart, Target, TreeData, TreeSize,
};
use view_probe::rules::{NodeAddresses, NodeSpan, corners_with_margin, judged_nodes, rows};
use view_probe::scene_data::{Aim, SceneData, TreeSource, written_shapes};

use crate::model::explanation::{Context, Explanation, explain};
use crate::model::history::{SampleRow, history};
use crate::model::tree::TreeModel;
use crate::probe::{Probe, Stop};
use crate::session::{Key, PinnedTarget, ScheduledJob};
use crate::shared_session::SharedSession;

/// The maximum number of tests to list for a pixel.
const MAX_TESTS: u32 = 4_000;
/// The CPU time limit for requests that call none of the submission's methods except constructors.
const LIMIT: Duration = Duration::from_secs(10);
/// The time after which the page says that `Bvh::build` is still running. The time limit for this
/// method is much longer, because building the tree of a large scene takes several seconds.
const SLOW_BUILD: Duration = Duration::from_millis(1500);
/// The maximum number of rays to try in a path when searching for the ray that ends the program.
const MAX_SEARCHED_RAYS: u32 = 64;

/// A program that is started when needed, with its current scene and camera.
pub(super) struct SceneProbe<'a> {
    session: &'a SharedSession,
    is_recorded: bool,
    probe: Option<Probe>,
    key: Key,
    aim: Option<Aim>,
    /// The size of the tree.
    size: TreeSize,
    /// The parts of the submission that haven't been written yet.
    missing: Vec<(SubmissionPart, Panic)>,
    /// The tree, if it has already been read to explain a pixel.
    tree: Option<IndexedTree>,
}

/// The error for the response [`Response::NotOpen`]. Any other response that doesn't match its
/// request has already been refused by [`Probe::ask`].
fn no_scene() -> Stop {
    Stop::Invalid("it has no scene".to_owned())
}

/// Returns the ray or path that a drawing request traces, or `None` if it traces more than one.
fn single_target(draw: &Draw) -> Option<Target> {
    let (pass, pixel) = draw.pixels().next().filter(|_| draw.milliseconds == 0)?;
    Some(Target::Pixel {
        quantity: draw.quantity,
        pixel,
        sample: draw.sample + pass,
    })
}

impl<'a> SceneProbe<'a> {
    pub(super) fn new(session: &'a SharedSession, is_recorded: bool) -> Self {
        SceneProbe {
            session,
            is_recorded,
            probe: None,
            key: Key::default(),
            aim: None,
            size: TreeSize::default(),
            missing: Vec::new(),
            tree: None,
        }
    }

    /// Ensures that the program has opened the scene and set the camera that `work` needs.
    pub(super) fn prepare(&mut self, work: &ScheduledJob) -> Result<(), Stop> {
        if self.key.program != work.key.program {
            self.probe = None;
        }
        if self.probe.is_none() || self.key.scene != work.key.scene {
            let opened = self.open(work, self.is_recorded);
            if opened.is_err() {
                self.probe = None;
            }
            opened?;
        }
        if self.aim != Some(work.aim) {
            self.ask(work, &Request::Aim(work.aim), LIMIT)?;
            self.aim = Some(work.aim);
        }
        Ok(())
    }

    /// Opens the scene that `work` needs. Reports a method that fails or doesn't return.
    fn open(&mut self, work: &ScheduledJob, lists_rays: bool) -> Result<(), Stop> {
        let opened = self.open_by_parts(work, lists_rays);
        if let Err(Stop::Fault(Some(part), fault)) = &opened {
            self.session
                .update(|session, _| session.opening_ended(work.key, *part, fault));
            return Err(Stop::Unwanted);
        }
        opened
    }

    /// Opens the scene that `work` needs. Each method of the submission is called in a separate
    /// request, so that the viewer knows which method fails.
    fn open_by_parts(&mut self, work: &ScheduledJob, lists_rays: bool) -> Result<(), Stop> {
        if self.probe.is_none() {
            let probe = Probe::start(&work.program, work.memory);
            self.probe = Some(probe.map_err(|error| Stop::Invalid(error.to_string()))?);
        }
        let mut data = SceneData::clone(&work.subject.data);
        data.aim = work.aim;
        data.is_recorded = lists_rays;
        self.key = work.key;
        self.aim = None;
        self.tree = None;
        self.ask(work, &Request::Scene(Box::new(data)), LIMIT)?;
        let any_ray = Ray::new(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0));
        for part in SubmissionPart::BEFORE_BUILD {
            self.try_part(work, part, any_ray, work.call_limit)?;
        }
        let started_at = Instant::now();
        let built = self.ask(work, &Request::Build, work.open_limit);
        let built = built.map_err(|stop| stop.in_part(SubmissionPart::Build))?;
        let Response::Opened(opened) = built else {
            return Err(no_scene());
        };
        let took = started_at.elapsed();
        let size = opened.tree.value().copied();
        self.missing.clone_from(&opened.missing);
        if size.is_some() {
            let placement = work.aim.camera.placement;
            let central_ray = Ray::new(placement.position, -placement.axes.z_axis);
            self.try_ray(work, central_ray, work.call_limit)?;
        }
        self.session
            .update(|session, _| session.opened(work.key, opened, took));
        self.size = size.ok_or(Stop::Unwanted)?;
        self.aim = Some(work.aim);
        Ok(())
    }

    /// Calls each method that takes a ray. If one fails, the error names it.
    fn try_ray(&mut self, work: &ScheduledJob, ray: Ray, limit: Duration) -> Result<(), Stop> {
        for part in SubmissionPart::WITH_RAY {
            self.try_part(work, part, ray, limit)?;
        }
        Ok(())
    }

    fn try_part(
        &mut self,
        work: &ScheduledJob,
        part: SubmissionPart,
        ray: Ray,
        limit: Duration,
    ) -> Result<(), Stop> {
        let tried = self.ask(work, &Request::Try { part, ray }, limit);
        tried.map(drop).map_err(|stop| stop.in_part(part))
    }

    /// Sends a request to the program. After a fault or an abandoned request, the program is killed
    /// and restarted when it is needed again.
    fn ask(
        &mut self,
        work: &ScheduledJob,
        request: &Request,
        limit: Duration,
    ) -> Result<Response, Stop> {
        let session = self.session;
        let asked_at = Instant::now();
        let mut is_reported = !matches!(request, Request::Build);
        let is_abandoned = || {
            if !is_reported && asked_at.elapsed() >= SLOW_BUILD {
                is_reported = true;
                session.update(|session, _| session.build_is_slow(work.key));
            }
            !session.read(|session, _| session.is_wanted(work.key))
        };
        let probe = self.probe.as_mut().ok_or(Stop::Unwanted)?;
        let response = probe.ask(request, limit, is_abandoned);
        if response.is_err() {
            self.probe = None;
            self.aim = None;
        }
        response
    }

    /// Finds the method that ended the program while the target was being drawn or followed. The
    /// target's rays are traced one by one in a new program. Before each ray is traced, every
    /// method is called with that ray, starting with the methods that other methods call.
    fn find_culprit(&mut self, work: &ScheduledJob, target: Target, fault: Fault) -> Stop {
        self.probe = None;
        let found = self.open(work, true);
        let found = found.and_then(|()| self.search_rays(work, target));
        // Don't keep using this program: it lists its rays, which takes time.
        self.probe = None;
        match found {
            Err(Stop::Fault(part, _)) => Stop::Fault(part, fault),
            Err(Stop::Unwanted) => Stop::Unwanted,
            Err(Stop::Invalid(_)) | Ok(()) => Stop::Fault(None, fault),
        }
    }

    fn search_rays(&mut self, work: &ScheduledJob, target: Target) -> Result<(), Stop> {
        let limit = work.call_limit / 4;
        let follow = |target, max_rays| Follow {
            target,
            max_tests: 0,
            max_rays,
        };
        let mut before_hits = target;
        let mut is_path = false;
        if let Target::Pixel { quantity, .. } = &mut before_hits
            && *quantity == Quantity::Light
        {
            // Without any hits, a path also calls part two.
            *quantity = Quantity::Hit;
            is_path = true;
        }
        // Only the camera is called.
        self.follow(work, follow(before_hits, 0), limit)
            .map_err(|stop| stop.in_part(SubmissionPart::Camera))?;
        for max_rays in 0..MAX_SEARCHED_RAYS {
            let mut followed = self.follow(work, follow(target, max_rays), limit);
            if is_path {
                // All methods of part one return for the rays so far.
                followed = followed.map_err(|stop| stop.in_part(SubmissionPart::Light));
            }
            let followed = followed?;
            let Some(next) = followed.rays.get(max_rays as usize) else {
                return Ok(());
            };
            self.try_ray(work, next.ray, limit)?;
        }
        Ok(())
    }

    fn follow(
        &mut self,
        work: &ScheduledJob,
        follow: Follow,
        limit: Duration,
    ) -> Result<RecordedRays, Stop> {
        let response = self.ask(work, &Request::Follow(follow), limit)?;
        let Response::Followed(followed) = response else {
            return Err(no_scene());
        };
        Ok(followed)
    }

    /// Draws some pixels of a tile.
    pub(super) fn draw(
        &mut self,
        work: &ScheduledJob,
        draw: &Draw,
        limit: Duration,
    ) -> Result<DrawnPixels, Stop> {
        let response = self.ask(work, &Request::Draw(*draw), limit);
        match (response, single_target(draw)) {
            (Ok(Response::Drawn(drawn)), _) => Ok(drawn),
            (Ok(_), _) => Err(no_scene()),
            (Err(Stop::Fault(_, fault)), Some(target)) => {
                Err(self.find_culprit(work, target, fault))
            }
            (Err(stop), _) => Err(stop),
        }
    }

    /// Returns the checked tree with facts about its nodes.
    pub(super) fn checked_tree(&mut self, work: &ScheduledJob) -> Result<TreeModel, Stop> {
        let tree = self.tree(work)?;
        let shapes = written_shapes(&work.subject.data.scene.shapes, &self.missing);
        Ok(TreeModel::new(tree, &work.subject.tree_criteria(&shapes)))
    }

    fn tree(&mut self, work: &ScheduledJob) -> Result<IndexedTree, Stop> {
        if let Some(why) = work.subject.oversize(self.size) {
            return Err(Stop::Invalid(why));
        }
        let limit = work.open_limit.max(LIMIT);
        let response = self.ask(work, &Request::Tree(self.size), limit)?;
        if let Response::Tree(ElementOutcome::Panicked(Panic { message, location })) = &response {
            return Err(Stop::Invalid(format!("panicked: {message} ({location})")));
        }
        let Response::Tree(ElementOutcome::Value(TreeData(tree))) = response else {
            return Err(no_scene());
        };
        Ok(IndexedTree::new(tree))
    }

    /// Explains a pixel.
    pub(super) fn explain(
        &mut self,
        work: &ScheduledJob,
        pinned: &PinnedTarget,
    ) -> Result<Explanation, Stop> {
        let tree = match self.tree.take() {
            Some(tree) => tree,
            None => self.tree(work).map_err(|stop| match stop {
                Stop::Unwanted => stop,
                Stop::Fault(..) | Stop::Invalid(_) => {
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
        tree: &IndexedTree,
        work: &ScheduledJob,
        pinned: &PinnedTarget,
    ) -> Result<Explanation, Stop> {
        let question = work.subject.question.as_ref();
        let target = match pinned.pixel {
            Some(pixel) => Target::Pixel {
                quantity: pinned.sample.map_or(Quantity::Hit, |_| Quantity::Light),
                pixel,
                sample: pinned.sample.unwrap_or(0),
            },
            None => {
                let ray = question.and_then(|question| question.ray);
                Target::Ray(ray.ok_or(Stop::Unwanted)?)
            }
        };
        let follow = Follow {
            target,
            max_tests: MAX_TESTS,
            max_rays: u32::MAX,
        };
        let followed = match self.follow(work, follow, work.call_limit) {
            Err(Stop::Fault(_, fault)) => return Err(self.find_culprit(work, target, fault)),
            followed => followed?,
        };
        let tests = followed.rays.iter().flat_map(|ray| &ray.tests);
        let context = Context {
            tree,
            shapes: &work.subject.data.scene.shapes,
            is_list: matches!(work.subject.data.tree, TreeSource::List),
            addresses: NodeAddresses::find(tests, tree),
        };
        let rays = followed.rays.iter();
        let spans = rays.map(|ray| self.spans(work, ray, &context));
        let spans: Vec<BTreeMap<u32, NodeSpan>> = spans.collect::<Result<_, _>>()?;
        let (pixel, sample) = (pinned.pixel, pinned.sample);
        let explanation = explain(pixel, sample, &followed, &spans, &context);
        let Some(pixel) = pixel else {
            return Ok(explanation);
        };
        match self.history(work, pixel) {
            Ok(history) => Ok(Explanation {
                history,
                ..explanation
            }),
            Err(Stop::Unwanted) => Err(Stop::Unwanted),
            // The rays of the explained path are worth showing even if another path fails.
            Err(stop) => Ok(Explanation {
                history_problem: Some(stop.to_string()),
                ..explanation
            }),
        }
    }

    /// Returns the first samples of a pixel.
    fn history(&mut self, work: &ScheduledJob, pixel: UVec2) -> Result<Vec<SampleRow>, Stop> {
        let count = work.listed_samples;
        let request = Request::Samples { pixel, count };
        let Response::Samples(samples) = self.ask(work, &request, work.call_limit)? else {
            return Err(no_scene());
        };
        Ok(history(&samples))
    }

    /// Returns, for each node needed to explain a ray, the part of the ray inside the node's box.
    fn spans(
        &mut self,
        work: &ScheduledJob,
        ray: &RecordedRay,
        context: &Context,
    ) -> Result<BTreeMap<u32, NodeSpan>, Stop> {
        let rows = rows(ray, context.tree, context.addresses);
        let nodes = judged_nodes(&rows, context.tree);
        let corners = nodes
            .iter()
            .filter_map(|node| corners_with_margin(*node, context.tree));
        let request = Request::Boxes {
            ray: ray.ray,
            boxes: corners.flatten().collect(),
        };
        let Response::Spans(inside) = self.ask(work, &request, LIMIT)? else {
            return Err(no_scene());
        };
        let (pairs, _) = inside.as_chunks();
        let span = |&[inside, inside_larger]: &[_; 2]| NodeSpan {
            inside,
            inside_larger,
        };
        Ok(nodes.into_iter().zip(pairs.iter().map(span)).collect())
    }
}
