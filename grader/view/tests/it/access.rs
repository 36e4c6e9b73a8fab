//! Tests the access rules over real connections.

use std::io::Write;
use std::net::{TcpListener, TcpStream};
use std::time::{Duration, Instant};
#[cfg(target_os = "linux")]
use std::{fs, os::unix::fs::PermissionsExt, path::Path};

use grader::printing::without_commands;
use serde_json::json;
#[cfg(target_os = "linux")]
use tempfile::TempDir;
#[cfg(target_os = "linux")]
use test_support::programs::{path_with, write_program};

use crate::harness::{Submission, Viewer, view, view_and_open, view_of};

#[test]
fn only_the_users_browser_is_answered() {
    let viewer = Viewer::start(&Submission::starter(), "--allow-host tunnel.example");
    let get = |path: &str, headers: &str| viewer.request("GET", path, headers, "").status;
    for public in ["/", "/main.js", "/favicon.ico"] {
        for (headers, status) in [
            ("Host: localhost", 200),
            ("Host: [::1]:80", 200),
            ("Host: evil.example", 403),
            ("X: 1", 403),
            ("Host: localhost\r\nHost: evil.example", 403),
        ] {
            assert_eq!(get(public, &format!("{headers}\r\n")), status, "{headers}");
        }
    }
    let token = viewer.first.split_once('=').unwrap().1;
    for (headers, status) in [
        ("Host: localhost:9000\r\nView-Token: TOKEN", 200),
        ("Host: TUNNEL.example\r\nView-Token: TOKEN", 200),
        ("Host: evil.example\r\nView-Token: TOKEN", 403),
        ("Host: localhost.evil.example\r\nView-Token: TOKEN", 403),
        ("View-Token: TOKEN", 403),
        (
            "Host: localhost\r\nHost: evil.example\r\nView-Token: TOKEN",
            403,
        ),
        ("Host: localhost\r\nView-Token: t1", 403),
        ("Host: localhost\r\nView-Token:", 403),
        (
            "Host: localhost\r\nView-Token: TOKEN\r\nView-Token: TOKEN",
            403,
        ),
        ("Host: localhost\r\nCookie: token=TOKEN", 403),
    ] {
        let headers = format!("{}\r\n", headers.replace("TOKEN", token));
        assert_eq!(get("/state?after=0", &headers), status, "{headers}");
    }
    for path in ["/state", "/picture", "/tree", "/boxes", "/node", "/nothing"] {
        assert_eq!(get(path, "Host: localhost\r\n"), 403, "{path}");
        let with_token = viewer.first.replace('/', path);
        assert_eq!(get(&with_token, "Host: localhost\r\n"), 403, "{path}");
    }
}

/// A browser sends cookies to every port on a host and lets a page from any port send commands.
/// However, such a page cannot add custom headers or read the answer.
#[test]
fn a_page_of_another_port_can_send_no_command() {
    let viewer = Viewer::start(&Submission::starter(), "");
    let command = json!({ "view": "depth" }).to_string();
    let post = |headers: &str| viewer.request("POST", "/command", headers, &command);
    assert_eq!(post(&viewer.headers()).status, 204);
    let token = viewer.first.split_once('=').unwrap().1;
    let other = "Host: localhost\r\nOrigin: http://localhost:9999\r\n";
    for cookie in [
        "",
        "Cookie: view-token=x\r\n",
        &format!("Cookie: view-token={token}\r\n"),
    ] {
        assert_eq!(post(&format!("{other}{cookie}")).status, 403, "{cookie}");
    }
    // The browser's preflight request for permission to send the header.
    let asked = format!("{other}Access-Control-Request-Headers: view-token\r\n");
    let answer = viewer.request("OPTIONS", "/command", &asked, "");
    assert_eq!(answer.status, 400);
    let head = answer.head.to_lowercase();
    assert!(!head.contains("access-control-"), "{head}");
    assert!(!head.contains("set-cookie"), "{head}");
}

/// Opens so many connections that the viewer closes the oldest. Each connection sends this text and
/// reads nothing.
fn open_silent_connections(viewer: &Viewer, sent: &str) -> Vec<TcpStream> {
    let open = |_| {
        let mut stream = TcpStream::connect(("127.0.0.1", viewer.port)).unwrap();
        stream.write_all(sent.as_bytes()).unwrap();
        stream
    };
    (0..250).map(open).collect()
}

#[test]
fn connections_that_send_or_read_nothing_do_not_keep_the_page_waiting() {
    let viewer = Viewer::start(&Submission::starter(), "");
    let mut open = Vec::new();
    for sent in [
        "",
        "GET /state HTT",
        "GET /main.js HTTP/1.1\r\nHost: localhost\r\n\r\n",
        "POST /command HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9000\r\n\r\n{",
    ] {
        open.push(open_silent_connections(&viewer, sent));
        let started_at = Instant::now();
        assert_eq!(viewer.get("/state?after=0").status, 200, "{sent}");
        assert!(started_at.elapsed() < Duration::from_secs(2), "{sent}");
    }
    let long = format!("{}X: {}\r\n", viewer.headers(), "x".repeat(20_000));
    assert_eq!(viewer.request("GET", "/", &long, "").status, 400);
}

#[test]
fn every_response_forbids_what_the_page_does_not_need() {
    let viewer = Viewer::start(&Submission::starter(), "");
    for path in ["/", "/main.js", "/nothing", "/state?after=0"] {
        let head = viewer.get(path).head;
        for header in [
            "default-src 'none'",
            "Referrer-Policy: no-referrer",
            "nosniff",
        ] {
            assert!(head.contains(header), "{path}: {head}");
        }
        assert!(!head.contains("unsafe-inline"), "{head}");
    }
}

#[test]
fn a_scene_is_named_and_never_a_path() {
    let viewer = Viewer::start(&Submission::starter(), "");
    for name in [
        "../Cargo.toml",
        "/etc/passwd",
        "scenes/flat.json",
        "none",
        "",
    ] {
        assert_eq!(viewer.send(&json!({ "scene": name })), 400, "{name}");
    }
    viewer.command(&json!({ "scene": "flat" }));
    viewer.wait_for(|state| state["subject"] == "flat");
    for bad in [
        json!({ "film": [0, 1] }),
        json!({ "film": [5000, 5000] }),
        json!({ "samples": 0 }),
        json!({ "pick": { "pixel": [9999, 0], "sample": null } }),
        json!({ "move": { "teleport": 1 } }),
        json!({ "exposure": 1e30 }),
    ] {
        assert_eq!(viewer.send(&bad), 400, "{bad}");
    }
}

#[test]
fn an_error_of_the_user_says_what_to_do() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    for (arguments, text) in [
        (format!("--port {port}"), format!("port {port} is in use")),
        ("gyroidd".into(), "`gyroidd` (did you mean gyroid?)".into()),
        ("none".into(), "cornell-box, flat".into()),
        (
            "--item camera.corners#1".into(),
            "cargo grade --replay camera.corners#1".into(),
        ),
        (
            "--item sphere.none#1".into(),
            "has no item `sphere.none`".into(),
        ),
        (
            "--item sphere.from_inside#99999".into(),
            "sphere.from_inside has no question 99999".into(),
        ),
    ] {
        let output = view().args(arguments.split(' ')).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains::<&str>(&text), "{error}");
    }
}

/// CI systems execute commands that appear in their logs.
#[test]
fn no_name_in_an_error_is_a_command_in_a_log() {
    let name = "::error::a ##[set-env name=a]b";
    for option in [None, Some("--submission"), Some("--item"), Some("--size")] {
        let output = view().args(option).arg(name).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(without_commands(&error), error, "{option:?}");
        assert!(error.contains("set-env"), "{option:?}: {error}");
    }
}

/// The browser is given the path of a file that contains the address, since any user of a machine
/// can read the arguments of running programs. The file is deleted as soon as the browser has
/// opened the address.
#[cfg(target_os = "linux")]
#[test]
fn the_browser_is_opened_by_a_file_that_only_the_user_can_read() {
    let desktop = TempDir::new().unwrap();
    let opened = desktop.path().join("opened");
    let script = format!(
        "printf %s \"$*\" > {0}.new; mv {0}.new {0}\n",
        opened.display()
    );
    write_program(&desktop.path().join("xdg-open"), &script);
    let submission = Submission::starter();
    let mut command = view_and_open();
    command
        .env("PATH", path_with(desktop.path()))
        .env("DISPLAY", ":99")
        .arg("--submission")
        .arg(submission.path());
    let viewer = Viewer::run(&mut command).unwrap();
    let deadline = Instant::now() + Duration::from_secs(60);
    while !opened.exists() {
        assert!(Instant::now() < deadline, "no browser was opened");
        std::thread::sleep(Duration::from_millis(10));
    }
    let file = fs::read_to_string(&opened).unwrap();
    let secret = viewer.first.split_once('=').unwrap().1;
    assert!(!file.contains(secret), "{file}");
    let page = fs::read_to_string(&file).unwrap();
    let address = format!("http://127.0.0.1:{}{}", viewer.port, viewer.first);
    assert!(page.contains(&format!("url={address}\"")), "{page}");
    let mode = fs::metadata(&file).unwrap().permissions().mode();
    assert_eq!(mode & 0o077, 0, "others can read the file: {mode:o}");
    assert_eq!(viewer.get("/state?after=0").status, 200);
    assert!(!Path::new(&file).exists(), "{file} is still there");
}

#[test]
fn without_a_desktop_the_viewer_says_what_to_do() {
    let submission = Submission::starter();
    let mut command = view_and_open();
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "WSL_DISTRO_NAME"] {
        command.env_remove(name);
    }
    command.arg("--submission").arg(submission.path());
    let viewer = Viewer::run(&mut command).unwrap();
    assert_eq!(viewer.get("/state?after=0").status, 200);
    let port = viewer.port;
    let advice = viewer.kill();
    let forward = format!("ssh -L {port}:localhost:{port}");
    if cfg!(target_os = "linux") {
        assert!(advice.contains(&forward), "{advice}");
    }
}

#[test]
fn a_codespace_reaches_the_page_by_the_name_of_its_port() {
    let submission = Submission::starter();
    let mut command = view_of(&submission);
    command
        .env("CODESPACE_NAME", "ada-42")
        .env("GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN", "app.github.dev");
    let viewer = Viewer::run(&mut command).unwrap();
    let name = format!("ada-42-{}.app.github.dev", viewer.port);
    let page = viewer.headers();
    let status = |headers: &str| {
        viewer
            .request("POST", "/command", headers, "\"own_camera\"")
            .status
    };
    // The tunnel either passes on the port's public name or replaces it.
    let host = format!("Host: {name}");
    assert_eq!(status(&page), 204);
    assert_eq!(status(&page.replace("Host: localhost", &host)), 204);
    let other = host.replace("ada-42", "eve-13");
    assert_eq!(status(&page.replace("Host: localhost", &other)), 403);
}

#[test]
fn a_second_viewer_takes_another_port() {
    let submission = Submission::starter();
    let mut command = view_of(&submission);
    let first = Viewer::spawn(&mut command).unwrap();
    let second = Viewer::spawn(&mut command).unwrap();
    assert_ne!(first.port, second.port);
    let state = "/state?after=0";
    let with_first = second.request("GET", state, &first.headers(), "");
    assert_eq!(with_first.status, 403, "the secret of one opens the other");
    assert_eq!(
        (first.get(state).status, second.get(state).status),
        (200, 200)
    );
}
