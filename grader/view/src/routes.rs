//! The addresses of the page, its files and its data.

use std::fmt::Display;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use serde::Serialize;
use tempfile::NamedTempFile;

use crate::access::{Access, Decision};
use crate::http::{Method, Request, Response, Status};
use crate::model::tree::{Bar, NodeInfo, TreeModel};
use crate::session::Command;
use crate::studio::Studio;
use crate::subject::{PathSettings, SceneList, Subject};

/// The time for which a request for news waits. Tunnels end connections that are silent for longer
/// than a minute.
const POLL_TIMEOUT: Duration = Duration::from_secs(25);
/// The maximum number of boxes that are drawn over the picture: 400 boxes have 4,800 edges.
const MAX_BOXES: usize = 400;
/// The number of nodes in the list of the worst.
const WORST: usize = 12;
/// The narrowest bar of the strip, as a share of its width.
const NARROWEST: f32 = 1.0 / 600.0;

/// The files of the page: path, type and text.
const FILES: [(&str, &str, &str); 10] = [
    (
        "/",
        "text/html; charset=utf-8",
        include_str!("page/index.html"),
    ),
    (
        "/style.css",
        "text/css; charset=utf-8",
        include_str!("page/style.css"),
    ),
    ("/icon.svg", "image/svg+xml", ICON),
    // Browsers ask for this one if a page names no icon, like the entrance and the errors.
    ("/favicon.ico", "image/svg+xml", ICON),
    ("/main.js", SCRIPT, include_str!("page/main.js")),
    ("/server.js", SCRIPT, include_str!("page/server.js")),
    ("/stage.js", SCRIPT, include_str!("page/stage.js")),
    ("/overlay.js", SCRIPT, include_str!("page/overlay.js")),
    ("/pixel.js", SCRIPT, include_str!("page/pixel.js")),
    ("/tree.js", SCRIPT, include_str!("page/tree.js")),
];
const ICON: &str = include_str!("page/icon.svg");
const SCRIPT: &str = "text/javascript; charset=utf-8";
const JSON: &str = "application/json";

/// The page that sets the cookie. It leads on to the address without the token by itself: a browser
/// does not send a strict cookie after a redirection that began in another program.
const ENTRANCE: &str = "<!doctype html><html lang=\"en\"><title>cargo view</title>\
    <meta http-equiv=\"refresh\" content=\"0;url=/\"><a href=\"/\">Open the viewer</a></html>";

/// The data behind the page.
pub struct Routes {
    /// The rules of access.
    pub access: Access,
    /// The session.
    pub studio: Arc<Studio>,
    /// The scenes that can be chosen.
    pub scenes: SceneList,
    /// The settings of paths.
    pub settings: PathSettings,
    /// The file that leads the browser here. It contains the secret, so it is deleted when it has
    /// been used.
    pub redirection: Mutex<Option<NamedTempFile>>,
}

/// The tree, as a strip by level.
#[derive(Serialize)]
struct TreeSummary {
    nodes: usize,
    levels: u32,
    primitives: usize,
    cost: f32,
    bars: Vec<Bar>,
    worst: Vec<NodeInfo>,
}

/// The boxes of a level.
#[derive(Serialize)]
struct TreeLevel {
    count: usize,
    boxes: Vec<NodeInfo>,
}

impl Routes {
    /// Answers a request.
    pub fn answer(&self, request: &Request) -> Response {
        match self.access.check(request) {
            Decision::Forbidden(why) => return Response::text(Status::Forbidden, why),
            Decision::SetCookie(cookie) => {
                let mut redirection = self.redirection.lock();
                drop(redirection.as_deref_mut().map(Option::take));
                let page = Response::new(Status::Ok, "text/html; charset=utf-8", ENTRANCE);
                return page.with_header("Set-Cookie", cookie);
            }
            Decision::Allowed => {}
        }
        let file = FILES.iter().find(|(path, _, _)| *path == request.path);
        match (request.method, request.path.as_str(), file) {
            (Method::Get, _, Some((_, content_type, text))) => {
                Response::new(Status::Ok, content_type, *text)
            }
            (Method::Get, "/state", _) => self.state(number(request, "after")),
            (Method::Get, "/picture", _) => match self.studio.picture() {
                Some(picture) => Response::new(Status::Ok, "image/png", picture.png.clone()),
                None => Response::text(Status::NotFound, "there is no picture yet"),
            },
            (Method::Get, "/explanation", _) => {
                match self.studio.read(|session, _| session.explanation.clone()) {
                    Some(explanation) => json(&*explanation),
                    None => Response::text(Status::NotFound, "no pixel is explained"),
                }
            }
            (Method::Get, "/tree" | "/boxes" | "/node", _) => {
                match self.studio.read(|session, _| session.tree.clone()) {
                    Some(tree) => of_tree(&tree, request),
                    None => Response::text(Status::NotFound, "there is no tree yet"),
                }
            }
            (Method::Post, "/command", _) => self.command(&request.body),
            (Method::Get | Method::Post, _, _) => Response::text(Status::NotFound, "no such page"),
        }
    }

    /// Returns the state as soon as its version differs from `known`.
    fn state(&self, known: u64) -> Response {
        if !self.studio.wait_for_news(known, POLL_TIMEOUT) {
            return Response::nothing();
        }
        json(&self.studio.read(|session, now| session.view_state(now)))
    }

    fn command(&self, body: &[u8]) -> Response {
        let bad = |why: &dyn Display| Response::text(Status::BadRequest, &why.to_string());
        let command: Command = match serde_json::from_slice(body) {
            Ok(command) => command,
            Err(error) => return bad(&error),
        };
        match self
            .studio
            .update(|session, now| session.apply(&command, now))
        {
            Err(why) => return bad(&why),
            Ok(None) => {}
            // Large meshes take some time to load, during which the page stays usable.
            Ok(Some(name)) => match self.scenes.load(&name) {
                Ok(scene) => {
                    let subject = Subject::of_scene(&name, &scene, self.settings);
                    self.studio
                        .update(|session, now| session.open(subject, now));
                }
                Err(error) => self.studio.update(|session, _| {
                    session.opening_failed(error.to_string());
                }),
            },
        }
        Response::nothing()
    }
}

/// Answers a request about the tree.
fn of_tree(tree: &TreeModel, request: &Request) -> Response {
    let index = |name| u32::try_from(number(request, name)).unwrap_or(u32::MAX);
    match request.path.as_str() {
        "/tree" => json(&summary(tree)),
        "/boxes" => {
            let below = request.parameter("below") == Some("true");
            let (boxes, count) = tree.at_level(index("level"), below, MAX_BOXES);
            json(&TreeLevel { count, boxes })
        }
        _ => match tree.info(index("node")) {
            Some(node) => json(&node),
            None => Response::text(Status::NotFound, "there is no such node"),
        },
    }
}

fn summary(tree: &TreeModel) -> TreeSummary {
    TreeSummary {
        nodes: tree.tree.nodes.len(),
        levels: tree.levels(),
        primitives: tree.tree.order.len(),
        cost: tree.cost(),
        bars: tree.strip(NARROWEST),
        worst: tree.worst(WORST),
    }
}

fn number(request: &Request, name: &str) -> u64 {
    request
        .parameter(name)
        .and_then(|text| text.parse().ok())
        .unwrap_or(0)
}

fn json(value: &impl Serialize) -> Response {
    match serde_json::to_vec(value) {
        Ok(text) => Response::new(Status::Ok, JSON, text),
        Err(error) => Response::text(Status::BadRequest, &error.to_string()),
    }
}
