//! The rules of access, over real connections.

use std::net::TcpListener;

use serde_json::json;

use crate::harness::{Submission, Viewer, view};

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
