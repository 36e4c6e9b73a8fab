//! Starts the server, the threads and the browser.

use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Instant;
use std::{fs, io, thread};

use grader::files::{AtPath, PathError};
use grader::handed_out::HandedOut;
use grader::printing::print_line;
use grader::select_isolation::IsolationRequest;
use grader::submission::Submission;
use grader::system::available_memory;
use grader::workspace::Workspace;
use judging::sanitize::sanitize_line;
use tempfile::NamedTempFile;
use view_probe::scene_data::PathSettings;

use crate::access::Access;
use crate::browser;
use crate::cli::{Arguments, DEFAULT_PORT};
use crate::composer;
use crate::error::ViewError;
use crate::exam_question::subject_of_question;
use crate::http;
use crate::program::{LIGHT, Programs, REFERENCE_LIGHT};
use crate::routes::Routes;
use crate::session::{Resources, Session, Worker};
use crate::shared_session::SharedSession;
use crate::source_links::SourceLinks;
use crate::subject::{SceneList, Subject};
use crate::watcher;
use crate::workers;

const NO_REFERENCE: &str = "the reference is not available here: leave out --reference";

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
            Subject::of_scene(&name, &scenes.load(&name)?, settings)
        }
    };
    let listener = listen(arguments.port)?;
    let port = listener.local_addr().map_err(cannot_listen)?.port();
    let programs = programs(arguments, &workspace, handed_out)?;
    // Report a missing submission before starting the server.
    let submission = programs.collect().map_err(ViewError::usage)?;

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
    session.shown.sources = SourceLinks::find(programs.folder(), &workspace, handed_out);
    let session = Arc::new(SharedSession::new(session));

    let access = Access::new(port, &arguments.allow_host).map_err(|error| {
        ViewError::Machine(format!("the system provides no random numbers: {error}"))
    })?;
    let url = format!("http://127.0.0.1:{port}{}", access.first_path());
    let folder = sanitize_line(&programs.folder().display().to_string(), usize::MAX);
    start_threads(&session, programs, submission, cores).map_err(cannot_listen)?;
    print_line(format_args!("{folder}: open {url}"));
    if let Some(forwarded) = access.forwarded() {
        let path = access.first_path();
        print_line(format_args!(
            "From outside this codespace, open https://{forwarded}{path}"
        ));
    }
    print_line("The page redraws after every save. Press Ctrl-C to stop.");
    let redirection = (!arguments.no_open)
        .then(|| open_browser(&workspace, &url, port).map_err(ViewError::machine))
        .transpose()?;
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
    submission: Submission,
    cores: usize,
) -> io::Result<()> {
    let of_watcher = programs.clone();
    session.spawn("watcher", move |shared| {
        watcher::watch(shared, &of_watcher, submission)
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
    let (folder, is_package): (PathBuf, bool) = match &arguments.submission {
        Some(path) => (workspace.resolve(path), false),
        None if arguments.reference => match workspace.reference(handed_out) {
            Some(reference) => (reference, false),
            None => return Err(ViewError::usage(NO_REFERENCE)),
        },
        None => (workspace.root().join(handed_out.student), true),
    };
    let light = if arguments.reference || arguments.reference_light {
        REFERENCE_LIGHT
    } else {
        LIGHT
    };
    let (_, light_folder) = light;
    if !workspace.root().join(light_folder).is_dir() {
        return Err(ViewError::Usage(format!(
            "the folder {light_folder} is missing"
        )));
    }
    Programs::prepare(workspace, handed_out, folder, is_package, light, isolation)
}

fn available_cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}
