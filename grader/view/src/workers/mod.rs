//! The threads that run the submission's programs.

mod open_program;

use crate::session::{Job, Worker};
use crate::shared_session::SharedSession;

use open_program::OpenProgram;

/// Does the work of one thread until the process ends.
pub fn run(shared: &SharedSession, worker: Worker) {
    let mut program = OpenProgram::new(shared, worker == Worker::Recording);
    loop {
        let work = shared.wait_for(|session, now| session.next_work(worker, now));
        let key = work.key;
        let is_open = program.prepare(&work);
        match work.job {
            Job::Explain(pinned) => {
                let failed = || Some(Err("the scene could not be opened".to_owned()));
                let result = if is_open {
                    program.explain(&work, &pinned)
                } else {
                    failed()
                };
                if let Some(result) = result {
                    shared.update(|session, _| session.explained(key, &pinned, result));
                }
            }
            Job::Draw { tile, draw, limit } if is_open => program.draw(&work, tile, &draw, limit),
            Job::Tree if is_open => {
                if let Some(tree) = program.tree(&work) {
                    shared.update(|session, _| session.received_tree(key, tree));
                }
            }
            Job::Draw { .. } | Job::Tree => {}
        }
    }
}
