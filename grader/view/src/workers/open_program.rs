//! A program with the scene and the camera that it has.

use std::time::{Duration, Instant};

use grader::probe::Fault;
use protocol::ElementOutcome;
use view_probe::messages::{Aim, Request, Response, TreeData, TreeSize};
use view_probe::scene_data::SceneData;

use super::{LIMIT, not_started, unexpected};
use crate::model::tree::TreeModel;
use crate::probe::{NoResponse, Probe};
use crate::session::{Key, Work};
use crate::studio::Studio;

/// A program that is started when it is needed, with the scene and the camera that it has.
#[derive(Default)]
pub(super) struct OpenProgram {
    probe: Option<Probe>,
    key: Key,
    aim: Option<Aim>,
    /// The size of the tree.
    size: TreeSize,
}

impl OpenProgram {
    /// Makes sure that the program has the scene and the camera of the work. Returns whether it
    /// has; reasons why it has not are reported.
    pub(super) fn prepare<J>(
        &mut self,
        studio: &Studio,
        work: &Work<J>,
        is_recorded: bool,
    ) -> bool {
        let key = work.key;
        if self.key.program != key.program {
            self.probe = None;
        }
        let has_scene = self.probe.is_some() && self.key.scene == key.scene;
        if !has_scene && !self.open(studio, work, is_recorded) {
            self.probe = None;
            return false;
        }
        if self.aim != Some(work.aim) {
            match self.ask(studio, work, &Request::Aim(work.aim), LIMIT) {
                Some(Ok(Response::Aimed)) => self.aim = Some(work.aim),
                Some(Ok(other)) => {
                    // Building the tree failed, which has been reported.
                    if other != Response::NotOpen {
                        not_started(studio, key, &unexpected(&other));
                    }
                    return false;
                }
                Some(Err(fault)) => {
                    not_started(studio, key, &fault.to_string());
                    return false;
                }
                None => return false,
            }
        }
        true
    }

    fn open<J>(&mut self, studio: &Studio, work: &Work<J>, is_recorded: bool) -> bool {
        if self.probe.is_none() {
            match Probe::start(&work.program, work.memory) {
                Ok(probe) => self.probe = Some(probe),
                Err(error) => {
                    not_started(studio, work.key, &error.to_string());
                    return false;
                }
            }
        }
        let mut data = SceneData::clone(&work.subject.data);
        data.aim = work.aim;
        data.is_recorded = is_recorded;
        self.key = work.key;
        self.aim = None;
        let started_at = Instant::now();
        let request = Request::Open(Box::new(data));
        match self.ask(studio, work, &request, work.open_limit) {
            Some(Ok(Response::Opened(opened))) => {
                let is_open = matches!(opened.tree, ElementOutcome::Value(_));
                if let ElementOutcome::Value(size) = opened.tree {
                    self.size = size;
                }
                let took = started_at.elapsed();
                studio.update(|session, _| session.opened(work.key, opened, took));
                if is_open {
                    self.aim = Some(work.aim);
                }
                is_open
            }
            Some(Ok(other)) => {
                not_started(studio, work.key, &unexpected(&other));
                false
            }
            Some(Err(fault)) => {
                let why = fault.to_string();
                studio.update(|session, _| session.opening_ended(work.key, &why));
                false
            }
            None => false,
        }
    }

    /// Asks the program. Returns `None` if the response is no longer wanted. After a fault or an
    /// abandoned request, the program has ended, and is started again when it is needed.
    pub(super) fn ask<J>(
        &mut self,
        studio: &Studio,
        work: &Work<J>,
        request: &Request,
        limit: Duration,
    ) -> Option<Result<Response, Fault>> {
        let probe = self.probe.as_mut()?;
        let is_abandoned = || !studio.read(|session, _| session.is_wanted(work.key));
        let response = probe.ask(request, limit, is_abandoned);
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

    /// Returns the tree with facts about its nodes, or the reason why there is none.
    pub(super) fn tree<J>(
        &mut self,
        studio: &Studio,
        work: &Work<J>,
    ) -> Option<Result<TreeModel, String>> {
        if let Some(why) = work.subject.oversize(self.size) {
            return Some(Err(why));
        }
        let (request, limit) = (Request::Tree(self.size), work.open_limit.max(LIMIT));
        Some(match self.ask(studio, work, &request, limit)? {
            Ok(Response::Tree(ElementOutcome::Value(TreeData(tree)))) => Ok(TreeModel::new(tree)),
            Ok(Response::Tree(ElementOutcome::Panicked(panic))) => {
                Err(format!("panicked: {} ({})", panic.message, panic.location))
            }
            Ok(other) => Err(unexpected(&other)),
            Err(fault) => Err(fault.to_string()),
        })
    }
}
