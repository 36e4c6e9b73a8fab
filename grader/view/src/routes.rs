//! The addresses of the page, its files and its data.

use std::fmt::Display;
use std::io::{self, Write};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use framework::render::renderer::PathSettings;
use glam::UVec2;
use judging::sanitize::sanitize;
use serde::Serialize;
use serde_json::ser::{CharEscape, CompactFormatter, Formatter};
use tempfile::NamedTempFile;

use crate::access::Access;
use crate::http::{Method, Request, Response, Site, Status};
use crate::model::tree::{Bar, NodeInfo, TreeCheckup, TreeModel};
use crate::session::Command;
use crate::shared_session::SharedSession;
use crate::subject::{SceneList, Subject};

/// The time after which a request for updates is answered even if nothing has changed. Tunnels
/// close connections that are silent for more than a minute.
const POLL_TIMEOUT: Duration = Duration::from_secs(25);
/// The maximum number of boxes to draw over the picture. 400 boxes have 4,800 edges.
const MAX_BOXES: usize = 400;
/// The number of nodes in the list of worst nodes.
const WORST: usize = 12;
/// The width of the narrowest bar, as a fraction of the strip's width.
const NARROWEST: f32 = 1.0 / 600.0;

/// The page's files, each with its path, media type and text.
const FILES: [(&str, &str, &str); 15] = [
    ("/", HTML, include_str!("page/index.html")),
    ("/style.css", CSS, include_str!("page/style.css")),
    ("/icon.svg", "image/svg+xml", ICON),
    // Browsers request this if a page specifies no icon, which is the case for error pages.
    ("/favicon.ico", "image/svg+xml", ICON),
    ("/main.js", SCRIPT, include_str!("page/main.js")),
    ("/links.js", SCRIPT, include_str!("page/links.js")),
    ("/server.js", SCRIPT, include_str!("page/server.js")),
    ("/stage.js", SCRIPT, include_str!("page/stage.js")),
    ("/defects.js", SCRIPT, include_str!("page/defects.js")),
    ("/legend.js", SCRIPT, include_str!("page/legend.js")),
    ("/overlay.js", SCRIPT, include_str!("page/overlay.js")),
    ("/pixel.js", SCRIPT, include_str!("page/pixel.js")),
    ("/history.js", SCRIPT, include_str!("page/history.js")),
    ("/path.js", SCRIPT, include_str!("page/path.js")),
    ("/tree.js", SCRIPT, include_str!("page/tree.js")),
];
const ICON: &str = include_str!("page/icon.svg");
const HTML: &str = "text/html; charset=utf-8";
const CSS: &str = "text/css; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";
const JSON: &str = "application/json";

/// The data behind the page.
pub struct Routes {
    /// The access rules.
    pub access: Access,
    /// The session.
    pub session: Arc<SharedSession>,
    /// The scenes that can be chosen.
    pub scenes: SceneList,
    /// The settings for paths.
    pub settings: PathSettings,
    /// The file that redirects the browser to this server. It contains the secret, so it is deleted
    /// after use.
    pub redirection: Mutex<Option<NamedTempFile>>,
}

/// The tree as a strip, level by level.
#[derive(Serialize)]
struct TreeSummary<'a> {
    checkup: &'a TreeCheckup,
    nodes: usize,
    levels: u32,
    primitives: usize,
    /// The sum of all nodes' costs.
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

impl Site for Routes {
    fn trusts(&self, request: &Request) -> bool {
        self.access.refusal(request, false).is_none()
    }

    fn answer(&self, request: &Request) -> Response {
        let file = FILES.iter().find(|(path, _, _)| *path == request.path);
        if let Some(why) = self.access.refusal(request, file.is_some()) {
            return Response::text(Status::FORBIDDEN, why);
        }
        if file.is_none() {
            // The page now knows the token, so the file that contains it is no longer needed.
            let mut redirection = self.redirection.lock();
            drop(redirection.as_deref_mut().map(Option::take));
        }
        match (request.method, request.path.as_str(), file) {
            (Method::Get, _, Some((_, content_type, text))) => {
                Response::new(Status::OK, content_type, *text)
            }
            (Method::Get, "/state", _) => self.state(number(request, "after")),
            (Method::Get, "/picture", _) => self.session.picture().map_or_else(
                || not_found("there is no picture yet"),
                |png| Response::new(Status::OK, "image/png", png.to_vec()),
            ),
            (Method::Get, "/value", _) => self.value(request),
            (Method::Get, "/explanation", _) => {
                let explanation = self.session.read(|session, _| session.explanation.clone());
                explanation.map_or_else(|| not_found("no pixel is selected"), |found| json(&*found))
            }
            (Method::Get, "/tree" | "/boxes" | "/node", _) => {
                let tree = self.session.read(|session, _| session.tree.clone());
                tree.map_or_else(
                    || not_found("there is no tree yet"),
                    |tree| of_tree(&tree, request),
                )
            }
            (Method::Post, "/command", _) => self.command(&request.body),
            (Method::Get | Method::Post, _, _) => not_found("no such page"),
        }
    }
}

impl Routes {
    /// Returns the state as soon as its version differs from `known`.
    fn state(&self, known: u64) -> Response {
        if !self.session.wait_for_news(known, POLL_TIMEOUT) {
            return Response::nothing();
        }
        self.session
            .read(|session, now| json(&session.page_state(now)))
    }

    /// Returns the value of a pixel.
    fn value(&self, request: &Request) -> Response {
        let [x, y] = ["x", "y"].map(|name| number(request, name).try_into().unwrap_or(u32::MAX));
        let value = self
            .session
            .read(|session, _| session.value_at(UVec2::new(x, y)));
        value.map_or_else(|| not_found("not drawn yet"), |value| json(&value))
    }

    fn command(&self, body: &[u8]) -> Response {
        let bad = |why: &dyn Display| Response::text(Status::BAD_REQUEST, &why.to_string());
        let command: Command = match serde_json::from_slice(body) {
            Ok(command) => command,
            Err(error) => return bad(&error),
        };
        let applied = self
            .session
            .update(|session, now| session.apply(&command, now));
        match applied {
            Err(why) => return bad(&why),
            Ok(None) => {}
            // Large meshes take some time to load. The page stays usable in the meantime.
            Ok(Some(name)) => match self.scenes.load(&name) {
                Ok(scene) => {
                    let subject = Subject::of_scene(&name, scene, self.settings);
                    self.session
                        .update(|session, now| session.open(subject, now));
                }
                Err(error) => self.session.update(|session, _| {
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
        "/tree" => json(&TreeSummary {
            checkup: &tree.checkup,
            nodes: tree.index.tree.nodes.len(),
            levels: tree.index.levels(),
            primitives: tree.index.tree.order.len(),
            cost: tree.total_cost(),
            bars: tree.strip(NARROWEST),
            worst: tree.worst(WORST),
        }),
        "/boxes" => {
            let below = request.parameter("below") == Some("true");
            let (boxes, count) = tree.at_level(index("level"), below, MAX_BOXES);
            json(&TreeLevel { count, boxes })
        }
        _ => match tree.info(index("node")) {
            Some(node) => json(&node),
            None => not_found("the tree has no such node"),
        },
    }
}

fn not_found(why: &str) -> Response {
    Response::text(Status::NOT_FOUND, why)
}

fn number(request: &Request, name: &str) -> u64 {
    request
        .parameter(name)
        .and_then(|text| text.parse().ok())
        .unwrap_or(0)
}

/// Returns data for the page. All texts are sanitized, because they may come from a submission.
fn json(value: &impl Serialize) -> Response {
    let mut text = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut text, Sanitizing);
    match value.serialize(&mut serializer) {
        Ok(()) => Response::new(Status::OK, JSON, text),
        Err(error) => Response::text(Status::BAD_REQUEST, &error.to_string()),
    }
}

/// Writes JSON with sanitized strings.
struct Sanitizing;

impl Formatter for Sanitizing {
    fn write_string_fragment<W: ?Sized + Write>(
        &mut self,
        to: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        // A fragment contains no quotes or backslashes, because those are written as escapes. After
        // sanitizing, every backslash is part of the text, so it must be escaped.
        let text = sanitize(fragment, usize::MAX).replace('\\', "\\\\");
        to.write_all(text.as_bytes())
    }

    fn write_char_escape<W: ?Sized + Write>(
        &mut self,
        to: &mut W,
        escape: CharEscape,
    ) -> io::Result<()> {
        let control = match escape {
            CharEscape::Backspace => '\u{8}',
            CharEscape::FormFeed => '\u{c}',
            CharEscape::CarriageReturn => '\r',
            CharEscape::AsciiControl(byte) => char::from(byte),
            CharEscape::Quote
            | CharEscape::ReverseSolidus
            | CharEscape::Solidus
            | CharEscape::LineFeed
            | CharEscape::Tab => return CompactFormatter.write_char_escape(to, escape),
        };
        self.write_string_fragment(to, control.encode_utf8(&mut [0; 4]))
    }
}
