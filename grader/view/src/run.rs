//! Starts the server, the threads and the browser.

use std::net::{Ipv4Addr, TcpListener};
use std::sync::{Arc, Mutex};
use std::time::Instant;
use std::{fs, io, thread};

use framework::render::renderer::PathSettings;
use grader::files::{AtPath, PathError};
use grader::handed_out::{HandedOut, LIGHT, RAYS};
use grader::printing::print_line;
use grader::select_isolation::IsolationRequest;
use grader::system::available_memory;
use grader::workspace::Workspace;
use judging::sanitize::sanitize_line;
use tempfile::NamedTempFile;

use crate::access::Access;
use crate::browser;
use crate::cli::{Arguments, DEFAULT_PORT};
use crate::composer;
use crate::error::ViewError;
use crate::exam_question::subject_of_question;
use crate::http;
use crate::program::{Files, Programs, Source};
use crate::routes::Routes;
use crate::session::{Resources, Session, Worker};
use crate::shared_session::SharedSession;
use crate::source_links::SourceLinks;
use crate::subject::{SceneList, Subject};
use crate::watcher;
use crate::workers;

const NO_REFERENCE: &str =
    "the reference is not available here: leave out --reference and --reference-light";

/// Serves the page until the process ends.
pub fn run(arguments: &Arguments) -> Result<(), ViewError> {
    let workspace = Workspace::find().map_err(ViewError::machine)?;
    let settings = PathSettings {
        bounces: arguments.bounces,
        seed: arguments.seed,
    };
    let handed_out = arguments.assignment.unwrap_or_default();
    let mut scenes = SceneList::find(&workspace);
    let subject = match &arguments.item {
        Some(question) => subject_of_question(handed_out, question, settings)?,
        None => {
            let name = scenes.name_of(&arguments.scene)?;
            Subject::of_scene(&name, scenes.load(&name)?, settings)
        }
    };
    let listener = listen(arguments.port)?;
    let port = listener.local_addr().map_err(cannot_listen)?.port();
    let programs = programs(arguments, &workspace, handed_out)?;
    // Report missing files before starting the server.
    let files = programs.collect().map_err(ViewError::usage)?;

    let cores = arguments.threads.map_or_else(available_cores, usize::from);
    // Leave half of the memory for other programs, such as the browser.
    let memory = available_memory().map_or(u64::MAX, |bytes| bytes / 2);
    let mut session = Session::new(
        subject,
        scenes.names(),
        settings,
        arguments.size,
        arguments.samples,
        Resources { cores, memory },
        Instant::now(),
    );
    if let Some(view) = arguments.view {
        session.show_view(view, Instant::now());
    }
    let sources = programs.sources();
    let links = sources.map(|(of, path)| SourceLinks::find(path, &workspace, of));
    session.shown.sources = links.into_iter().flatten().collect();
    let shown = sources.into_iter().find(|(of, _)| *of == handed_out);
    let folder = shown.map_or_else(String::new, |(_, path)| path.display().to_string());
    let folder = sanitize_line(&folder, usize::MAX);
    let session = Arc::new(SharedSession::new(session));

    let access = Access::new(port, &arguments.allow_host).map_err(|error| {
        ViewError::Machine(format!("the system provides no random numbers: {error}"))
    })?;
    let url = format!("http://127.0.0.1:{port}{}", access.first_path());
    start_threads(&session, programs, files, cores).map_err(cannot_listen)?;
    print_line(format_args!("{folder}: open {url}"));
    if let Some(forwarded) = access.forwarded() {
        let path = access.first_path();
        print_line(format_args!(
            "From outside this codespace, open https://{forwarded}{path}"
        ));
    }
    print_line("The page redraws after every save. Press Ctrl-C to stop.");
    let redirection = if arguments.no_open {
        None
    } else {
        let opened = open_browser(&workspace, &url, port);
        Some(opened.map_err(ViewError::machine)?)
    };
    let routes = Routes {
        access,
        session,
        scenes,
        settings,
        redirection: Mutex::new(redirection),
    };
    http::serve(&listener, routes);
    Ok(())
}

fn open_browser(workspace: &Workspace, url: &str, port: u16) -> Result<NamedTempFile, PathError> {
    let folder = workspace.output_folder();
    fs::create_dir_all(&folder).at("create", &folder)?;
    browser::open(&folder, url, port).at("write to", &folder)
}

fn start_threads(
    session: &Arc<SharedSession>,
    programs: Programs,
    files: Files,
    cores: usize,
) -> io::Result<()> {
    let programs = Arc::new(programs);
    let of_watcher = Arc::clone(&programs);
    session.spawn("watcher", move |shared| {
        watcher::watch(shared, &of_watcher, files)
    })?;
    session.spawn("recordings", move |shared| {
        watcher::build_recordings(shared, &programs)
    })?;
    for worker in (0..cores).map(Worker::Drawing).chain([Worker::Recording]) {
        session.spawn(&format!("{worker:?}"), move |shared| {
            workers::run(shared, worker)
        })?;
    }
    session.spawn("composer", composer::run)
}

fn cannot_listen(error: io::Error) -> ViewError {
    ViewError::Machine(format!("cannot listen on 127.0.0.1: {error}"))
}

/// Listens on this port. If no port is given, listens on the default port or, if that is in use, on
/// any free port.
fn listen(port: Option<u16>) -> Result<TcpListener, ViewError> {
    let bind = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    match port {
        Some(port) => bind(port).map_err(|error| {
            if error.kind() == io::ErrorKind::AddrInUse {
                ViewError::Usage(format!(
                    "port {port} is in use: choose a different one with --port, or leave out --port"
                ))
            } else {
                cannot_listen(error)
            }
        }),
        None => bind(DEFAULT_PORT)
            .or_else(|_| bind(0))
            .map_err(cannot_listen),
    }
}

fn programs(
    arguments: &Arguments,
    workspace: &Workspace,
    handed_out: &'static HandedOut,
) -> Result<Programs, ViewError> {
    let isolation = if arguments.untrusted {
        IsolationRequest::Untrusted
    } else {
        IsolationRequest::OwnWork
    };
    let source = |part: &'static HandedOut, is_reference: bool| {
        let submission = arguments.submission.as_ref();
        let (path, is_package) = match submission.filter(|_| part == handed_out) {
            Some(path) => (workspace.resolve(path), false),
            None if is_reference => {
                let path = workspace.reference(part);
                (path.ok_or_else(|| ViewError::usage(NO_REFERENCE))?, false)
            }
            None => (workspace.root().join(part.student), true),
        };
        Ok(Source { path, is_package })
    };
    // A submission for part two needs a part one that works.
    let is_of_light = arguments.submission.is_some() && handed_out == &LIGHT;
    let has_reference = workspace.reference(&RAYS).is_some();
    let rays = source(&RAYS, arguments.reference || is_of_light && has_reference)?;
    let light = source(&LIGHT, arguments.reference || arguments.reference_light)?;
    Programs::prepare(workspace, rays, light, isolation)
}

fn available_cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}
