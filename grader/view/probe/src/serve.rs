//! The process: reads requests and writes responses.

use std::fs::File;
use std::io::{BufReader, BufWriter, Write};
use std::process::ExitCode;

use framework::harness::attempt::attempt;
use framework::render::clay::Clay;
use framework::render::renderer::Lighting;
use framework::submission::Submission;
use protocol::wire::{self, WireError};

use crate::draw::{Renderers, draw, follow, samples};
use crate::messages::{Request, Response, TreeData};
use crate::open_scene::{OpenScene, Opening};

/// The maximum size of a request, enough for a scene with several million triangles. The viewer is
/// trusted, so this only guards against bugs.
const MAX_REQUEST_BYTES: usize = 2 << 30;

/// Responds to requests from standard input until the input ends. `light` is part two's code, which
/// draws the shaded view.
pub fn main(submission: &dyn Submission, light: &dyn Lighting) -> ExitCode {
    framework::harness::probe::run(|requests, responses| {
        let mut pipe = Pipe {
            requests: BufReader::with_capacity(1 << 16, requests),
            responses: BufWriter::with_capacity(1 << 16, responses),
            nonce: 0,
        };
        match serve(submission, light, &mut pipe) {
            Err(WireError::EndOfStream) => Ok(()),
            other => other,
        }
    })
}

/// Responds to requests. Returns only on an error, including the end of the stream.
fn serve(
    submission: &dyn Submission,
    light: &dyn Lighting,
    pipe: &mut Pipe,
) -> Result<(), WireError> {
    let mut opening: Option<Opening> = None;
    let mut stage: Option<OpenScene> = None;
    let mut request = pipe.receive()?;
    loop {
        let response = match (request, &mut stage) {
            (Request::Scene(data), stage) => {
                // Free the old tree first, so that there are never two trees in memory.
                *stage = None;
                opening = Some(Opening::new(*data));
                Response::Received
            }
            (Request::Build, stage) => match opening.take() {
                Some(opening) => {
                    let (opened, new) = opening.build(submission);
                    *stage = new;
                    Response::Opened(opened)
                }
                None => Response::NotOpen,
            },
            (Request::Try { part, ray }, None) => match &mut opening {
                Some(opening) => {
                    opening.try_part(submission, part, &ray);
                    Response::Tried
                }
                None => Response::NotOpen,
            },
            (Request::Aim(aim), Some(stage)) => {
                stage.aim(aim);
                Response::Aimed
            }
            (other, Some(stage)) => {
                request = serve_aimed(stage, light, other, pipe)?;
                continue;
            }
            (_, None) => Response::NotOpen,
        };
        pipe.send(&response)?;
        request = pipe.receive()?;
    }
}

/// Responds to requests until one would change the scene or the camera, and returns that request.
/// This way, the path tracer, which lists the scene's lights, is only created once per camera.
fn serve_aimed(
    stage: &OpenScene,
    light: &dyn Lighting,
    first: Request,
    pipe: &mut Pipe,
) -> Result<Request, WireError> {
    let clay = Clay::new(&stage.scene, &stage.world, stage.aim.settings.seed);
    let renderers = Renderers::new(stage, light, clay);
    let mut request = first;
    loop {
        let response = match &request {
            Request::Scene(_) | Request::Build | Request::Aim(_) => return Ok(request),
            Request::Try { part, ray } => {
                stage.try_part(*part, ray);
                Response::Tried
            }
            Request::Draw(request) => Response::Drawn(draw(stage, &renderers, request)),
            Request::Tree(_) => Response::Tree(attempt(|| TreeData(stage.world.bvh.tree())).into()),
            Request::Follow(request) => Response::Followed(follow(stage, &renderers, request)),
            Request::Samples { pixel, count } => {
                Response::Samples(samples(&renderers, *pixel, *count))
            }
            Request::Boxes { ray, boxes } => {
                let spans = boxes
                    .iter()
                    .map(|corners| stage.intersect_box(*corners, ray));
                Response::Spans(spans.collect())
            }
        };
        pipe.send(&response)?;
        request = pipe.receive()?;
    }
}

/// The pipes for requests and responses.
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
