//! The rules of access, over real connections.

use std::net::TcpListener;
#[cfg(target_os = "linux")]
use std::{
    fs,
    os::unix::fs::PermissionsExt,
    path::Path,
    time::{Duration, Instant},
};

use serde_json::json;
#[cfg(target_os = "linux")]
use tempfile::TempDir;

use crate::harness::{Submission, Viewer, view, view_and_open};

#[test]
fn only_the_users_browser_is_answered() {
    let viewer = Viewer::start(&Submission::starter(), &["--allow-host", "tunnel.example"]);
    let with = |headers: &str| viewer.request("GET", "/", headers, "").status;
    assert_eq!(viewer.get("/").status, 200);
    let icon = viewer.get("/favicon.ico");
    assert_eq!(icon.status, 200, "browsers ask for it by themselves");
    let page = viewer.headers();
    assert_eq!(with("Host: localhost\r\n"), 403, "no cookie");
    assert_eq!(with(&page.replace("localhost", "tunnel.example")), 200);
    assert_eq!(
        with(&page.replace("Host: localhost", "Host: evil.example")),
        403
    );
    assert_eq!(
        with(&page.replace("http://localhost", "http://evil.example")),
        403
    );
    let other = page.replace("view-", "view-1");
    assert_eq!(with(&other), 403, "the cookie of another viewer");

    let post = |headers: &str, body: &str| viewer.request("POST", "/command", headers, body).status;
    let command = json!({ "view": "depth" }).to_string();
    assert_eq!(post(&page, &command), 204);
    assert_eq!(
        post(&page.replace("Origin: http://localhost\r\n", ""), &command),
        403
    );
    assert_eq!(
        post("Host: localhost\r\nOrigin: http://localhost\r\n", &command),
        403
    );
}

#[test]
fn every_response_forbids_what_the_page_does_not_need() {
    let viewer = Viewer::start(&Submission::starter(), &[]);
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
    let entrance = viewer.request("GET", &viewer.first, "Host: 127.0.0.1:1\r\n", "");
    assert!(
        entrance.head.contains("HttpOnly; SameSite=Strict"),
        "{}",
        entrance.head
    );
}

#[test]
fn a_scene_is_named_and_never_a_path() {
    let viewer = Viewer::start(&Submission::starter(), &[]);
    for name in [
        "../Cargo.toml",
        "/etc/passwd",
        "scenes/flat.json",
        "none",
        "",
    ] {
        assert_eq!(viewer.send(&json!({ "scene": name })), 400, "{name}");
    }
    assert_eq!(viewer.send(&json!({ "scene": "flat" })), 204);
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
fn a_port_in_use_is_named() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let output = view().args(["--port", &port]).output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains(&format!("port {port} is in use")), "{error}");
}

#[test]
fn an_unknown_scene_is_an_error_that_lists_the_known_ones() {
    let output = view().arg("gyroidd").output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(
        error.contains("`gyroidd` (did you mean gyroid?)") && error.contains("cornell-box, flat"),
        "{error}"
    );
}

/// The browser gets the path of a file, since every user of a machine can read the arguments of
/// programs. The file is deleted as soon as the browser has opened the address in it.
#[cfg(target_os = "linux")]
#[test]
fn the_browser_is_opened_by_a_file_that_only_the_user_can_read() {
    let desktop = TempDir::new().unwrap();
    let opened = desktop.path().join("opened");
    let program = desktop.path().join("xdg-open");
    let text = format!(
        "#!/bin/sh\nprintf %s \"$*\" > {0}.new; mv {0}.new {0}\n",
        opened.display()
    );
    fs::write(&program, text).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    let path = std::env::var("PATH").unwrap();
    let submission = Submission::starter();
    let mut command = view_and_open();
    command
        .env("PATH", format!("{}:{path}", desktop.path().display()))
        .env("DISPLAY", ":99")
        .arg("--submission")
        .arg(submission.path());
    let mut viewer = Viewer::run(&mut command).unwrap();
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
    viewer.visit();
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
    let mut viewer = Viewer::run(&mut command).unwrap();
    viewer.visit();
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
    let mut command = view();
    command
        .env("CODESPACE_NAME", "ada-42")
        .env("GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN", "app.github.dev")
        .arg("--submission")
        .arg(submission.path());
    let mut viewer = Viewer::run(&mut command).unwrap();
    viewer.visit();
    let name = format!("ada-42-{}.app.github.dev", viewer.port);
    let outside = viewer
        .headers()
        .replace("http://localhost", &format!("https://{name}"));
    let status = |headers: &str, method: &str| {
        let (path, body) = match method {
            "GET" => ("/", ""),
            _ => ("/command", "\"own_camera\""),
        };
        viewer.request(method, path, headers, body).status
    };
    // The tunnel passes on the name of the port, or replaces it.
    assert_eq!(status(&outside, "POST"), 204);
    assert_eq!(status(&outside.replace("localhost", &name), "POST"), 204);
    let other = outside.replace("ada-42", "eve-13");
    assert_eq!((status(&other, "GET"), status(&other, "POST")), (403, 403));
}

#[test]
fn a_second_viewer_takes_another_port() {
    let submission = Submission::starter();
    let mut command = view();
    command.arg("--submission").arg(submission.path());
    let first = Viewer::run_at_the_usual_port(&mut command);
    let second = Viewer::run_at_the_usual_port(&mut command);
    assert_ne!(first.port, second.port);
    // The cookie of one viewer does not open the other, although browsers send it to both.
    assert_eq!(second.request("GET", "/", &first.headers(), "").status, 403);
    assert_eq!((first.get("/").status, second.get("/").status), (200, 200));
}
