//! The threads that run the submission's programs.

mod scene_probe;

use crate::probe::Stop;
use crate::session::{Job, Worker};
use crate::shared_session::SharedSession;

use scene_probe::SceneProbe;

/// Does the work of one thread until the process ends.
pub fn run(shared: &SharedSession, worker: Worker) {
    let mut program = SceneProbe::new(shared, worker == Worker::Recording);
    loop {
        let work = shared.wait_for(|session, now| session.next_job(worker, now));
        let key = work.key;
        if let Err(stop) = program.prepare(&work) {
            if !matches!(stop, Stop::Unwanted) {
                shared.update(|session, _| session.not_started(key, &stop.to_string()));
            }
            if let Job::Explain(pinned) = work.job {
                let why = Stop::Invalid("the scene could not be opened".to_owned());
                shared.update(|session, _| session.explained(key, &pinned, Err(why)));
            }
            continue;
        }
        match work.job {
            Job::Explain(pinned) => {
                let result = program.explain(&work, &pinned);
                if !matches!(result, Err(Stop::Unwanted)) {
                    shared.update(|session, _| session.explained(key, &pinned, result));
                }
            }
            Job::Draw { tile, draw, limit } => match program.draw(&work, &draw, limit) {
                Ok(drawn) => shared.update(|session, now| {
                    session.drawn(key, tile, &draw, &drawn, now);
                }),
                Err(Stop::Fault(part, fault)) => shared.update(|session, _| {
                    session.drawing_ended(key, tile, &draw, part, &fault);
                }),
                Err(Stop::Invalid(why)) => {
                    shared.update(|session, _| session.not_started(key, &why));
                }
                Err(Stop::Unwanted) => {}
            },
            Job::Tree => {
                let tree = program.checked_tree(&work);
                if !matches!(tree, Err(Stop::Unwanted)) {
                    let tree = tree.map_err(|stop| stop.to_string());
                    shared.update(|session, _| session.received_tree(key, tree));
                }
            }
        }
    }
}
