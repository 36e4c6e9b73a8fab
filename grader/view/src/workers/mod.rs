//! The threads that run the submission's programs.

mod open_program;

use crate::probe::Stop;
use crate::session::{Job, Worker};
use crate::shared_session::SharedSession;

use open_program::OpenProgram;

/// Does the work of one thread until the process ends.
pub fn run(shared: &SharedSession, worker: Worker) {
    let mut program = OpenProgram::new(shared, worker == Worker::Recording);
    loop {
        let work = shared.wait_for(|session, now| session.next_work(worker, now));
        let key = work.key;
        if let Err(stop) = program.prepare(&work) {
            if !matches!(stop, Stop::Unwanted) {
                shared.update(|session, _| session.not_started(key, &stop.to_string()));
            }
            if let Job::Explain(pinned) = work.job {
                let why = Err("the scene could not be opened".to_owned());
                shared.update(|session, _| session.explained(key, &pinned, why));
            }
            continue;
        }
        match work.job {
            Job::Explain(pinned) => {
                if let Some(result) = reported(program.explain(&work, &pinned)) {
                    shared.update(|session, _| session.explained(key, &pinned, result));
                }
            }
            Job::Draw { tile, draw, limit } => match program.draw(&work, &draw, limit) {
                Ok(drawn) => shared.update(|session, now| {
                    session.drawn(key, tile, &draw, &drawn, now);
                }),
                Err(Stop::Fault(fault)) => shared.update(|session, _| {
                    session.drawing_ended(key, tile, &draw, &fault);
                }),
                Err(Stop::Invalid(why)) => {
                    shared.update(|session, _| session.not_started(key, &why));
                }
                Err(Stop::Unwanted) => {}
            },
            Job::Tree => {
                if let Some(tree) = reported(program.tree(&work)) {
                    shared.update(|session, _| session.received_tree(key, tree));
                }
            }
        }
    }
}

/// Converts a result for reporting. Returns `None` if it is no longer wanted.
fn reported<T>(result: Result<T, Stop>) -> Option<Result<T, String>> {
    match result {
        Err(Stop::Unwanted) => None,
        other => Some(other.map_err(|stop| stop.to_string())),
    }
}
