//! The process: reads requests and writes responses.

use std::fs::File;
use std::io::{BufReader, BufWriter, Write};
use std::process::ExitCode;

use framework::harness::attempt::attempt;
use framework::render::integrator::{Integrator, RenderSettings};
use framework::submission::Submission;
use protocol::wire::{self, WireError};

use crate::draw::{draw, follow};
use crate::messages::{Request, Response, TreeData};
use crate::scene_data::PathSettings;
use crate::stage::Stage;

/// The maximum size of a request: a scene with some millions of triangles. The viewer is trusted,
/// so this only guards against bugs.
const MAX_REQUEST_BYTES: usize = 2 << 30;

/// Responds to requests from standard input until the input ends.
pub fn main(submission: &dyn Submission) -> ExitCode {
    framework::harness::probe::run(|requests, responses| {
        let mut pipe = Pipe {
            requests: BufReader::with_capacity(1 << 16, requests),
            responses: BufWriter::with_capacity(1 << 16, responses),
            nonce: 0,
        };
        match serve(submission, &mut pipe) {
            Err(WireError::EndOfStream) => Ok(()),
            other => other,
        }
    })
}

/// Responds to requests. Returns only with an error, such as the end of the stream.
fn serve(submission: &dyn Submission, pipe: &mut Pipe) -> Result<(), WireError> {
    let mut stage: Option<Stage> = None;
    let mut request = pipe.receive()?;
    loop {
        let response = match (request, &mut stage) {
            (Request::Open(data), stage) => {
                // Free the old tree first, so that there are never two.
                *stage = None;
                let (opened, new) = Stage::open(submission, *data);
                *stage = new;
                Response::Opened(opened)
            }
            (Request::Aim(aim), Some(stage)) => {
                stage.aim(aim);
                Response::Aimed
            }
            (other, Some(stage)) => {
                request = serve_aimed(stage, other, pipe)?;
                continue;
            }
            (_, None) => Response::NotOpen,
        };
        pipe.send(&response)?;
        request = pipe.receive()?;
    }
}

/// Responds to requests that don't change the scene or the camera. Returns the first other request.
/// This way, the integrator, which lists the scene's lights, is only created once per camera.
fn serve_aimed(stage: &Stage, first: Request, pipe: &mut Pipe) -> Result<Request, WireError> {
    let PathSettings { bounces, seed } = stage.aim.settings;
    let settings = RenderSettings {
        film: stage.aim.camera.pinhole.film,
        samples: 1,
        bounces,
        seed,
    };
    let integrator = Integrator::new(&stage.scene, &stage.world, settings);
    let mut request = first;
    loop {
        let response = match &request {
            Request::Open(_) | Request::Aim(_) => return Ok(request),
            Request::Draw(request) => Response::Drawn(draw(stage, &integrator, request)),
            Request::Tree(_) => Response::Tree(attempt(|| TreeData(stage.world.bvh.tree())).into()),
            Request::Follow(request) => Response::Followed(follow(stage, &integrator, request)),
            Request::Boxes(queries) => {
                let boxes = queries.boxes.iter();
                let spans = boxes.map(|corners| stage.intersect_box(*corners, &queries.ray));
                Response::Spans(spans.collect())
            }
        };
        pipe.send(&response)?;
        request = pipe.receive()?;
    }
}

/// The pipes of requests and responses.
struct Pipe {
    requests: BufReader<File>,
    responses: BufWriter<File>,
    /// The nonce of the last request.
    nonce: u64,
}

impl Pipe {
    fn receive(&mut self) -> Result<Request, WireError> {
        let frame = wire::read(&mut self.requests, MAX_REQUEST_BYTES)?;
        self.nonce = frame.nonce;
        frame.decode()
    }

    fn send(&mut self, response: &Response) -> Result<(), WireError> {
        wire::write(&mut self.responses, self.nonce, response)?;
        Ok(self.responses.flush()?)
    }
}
