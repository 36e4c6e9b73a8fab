//! Starts everything.

use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Instant;
use std::{fs, io};

use grader::files::AtPath;
use grader::handed_out::RAYS;
use grader::printing::print_line;
use grader::select_isolation::IsolationRequest;
use grader::system::available_memory;
use grader::workspace::Workspace;
use judging::sanitize::sanitize_line;

use crate::access::Access;
use crate::cli::{Arguments, DEFAULT_PORT};
use crate::error::ViewError;
use crate::exam_question::subject_of_question;
use crate::program::Programs;
use crate::routes::Routes;
use crate::session::{Resources, Session};
use crate::studio::Studio;
use crate::subject::{PathSettings, SceneList, Subject};
use crate::{browser, composer, http, watcher, workers};

/// Serves the page until the process ends.
pub fn run(arguments: &Arguments) -> Result<(), ViewError> {
    let workspace = Workspace::find()?;
    let settings = PathSettings {
        bounces: arguments.bounces,
        seed: arguments.seed,
    };
    let mut scenes = SceneList::find(&workspace);
    let subject = match &arguments.item {
        Some(question) => subject_of_question(question, settings)?,
        None => {
            let name = scenes.name_of(&arguments.scene)?;
            Subject::of_scene(&name, &scenes.load(&name)?, settings)
        }
    };
    let listener = listen(arguments.port)?;
    let port = listener.local_addr().map_err(ViewError::Listen)?.port();
    let programs = programs(arguments, &workspace)?;
    let submission = programs.collect()?;

    let cores = arguments.threads.map_or_else(available_cores, usize::from);
    // Half of it is left for other programs, such as the browser.
    let memory = available_memory().map_or(u64::MAX, |bytes| bytes / 2);
    let session = Session::new(
        subject,
        scenes.names(),
        settings,
        arguments.size,
        arguments.samples,
        Resources { cores, memory },
        Instant::now(),
    );
    let studio = Arc::new(Studio::new(session));
    start_threads(&studio, &programs, submission, cores).map_err(ViewError::Listen)?;

    let access = Access::new(port, &arguments.allow_host)?;
    let url = format!("http://127.0.0.1:{port}{}", access.first_path());
    let folder = sanitize_line(&programs.folder().display().to_string(), usize::MAX);
    print_line(format_args!("{folder}: open {url}"));
    if let Some(forwarded) = access.forwarded() {
        let path = access.first_path();
        print_line(format_args!(
            "From outside of this codespace: open https://{forwarded}{path}"
        ));
    }
    print_line("The page redraws after every save. Press Ctrl-C to stop.");
    let redirection = if arguments.no_open {
        None
    } else {
        let folder = workspace.output_folder();
        fs::create_dir_all(&folder).at("create", &folder)?;
        Some(browser::open(&folder, &url, port).at("write to", &folder)?)
    };
    let routes = Routes {
        access,
        studio,
        scenes,
        settings,
        redirection: Mutex::new(redirection),
    };
    http::serve(&listener, routes);
    Ok(())
}

fn start_threads(
    studio: &Arc<Studio>,
    programs: &Programs,
    submission: grader::submission::Submission,
    cores: usize,
) -> io::Result<()> {
    watcher::start(studio, programs, submission)?;
    workers::start(studio, cores)?;
    let studio = Arc::clone(studio);
    let thread = thread::Builder::new().name("composer".to_owned());
    thread.spawn(move || composer::run(&studio))?;
    Ok(())
}

/// Listens on this port, or on the usual one or any other if none is given.
fn listen(port: Option<u16>) -> Result<TcpListener, ViewError> {
    let bind = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    match port {
        Some(port) => bind(port).map_err(|error| {
            if error.kind() == io::ErrorKind::AddrInUse {
                ViewError::PortInUse { port }
            } else {
                ViewError::Listen(error)
            }
        }),
        None => bind(DEFAULT_PORT)
            .or_else(|_| bind(0))
            .map_err(ViewError::Listen),
    }
}

fn programs(arguments: &Arguments, workspace: &Workspace) -> Result<Programs, ViewError> {
    let isolation = if arguments.untrusted {
        IsolationRequest::Untrusted
    } else {
        IsolationRequest::OwnWork
    };
    let (folder, is_package): (PathBuf, bool) = match &arguments.submission {
        Some(path) => (workspace.resolve(path), false),
        None if arguments.reference => {
            let reference = workspace.reference(&RAYS);
            (reference.ok_or(ViewError::NoReference)?, false)
        }
        None => (workspace.root().join(RAYS.student), true),
    };
    Programs::prepare(workspace, folder, is_package, isolation)
}

fn available_cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}
