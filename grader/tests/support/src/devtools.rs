//! The part of the DevTools protocol needed by these tests: <https://chromedevtools.github.io>.
//!
//! It is written by hand on top of a WebSocket, because crates for the complete protocol have a
//! hundred dependencies. Accessibility is checked with axe-core: the rules of WCAG 2.2 AA that a
//! program can check, and best practices.

use std::net::TcpStream;
use std::path::Path;
use std::time::{Duration, Instant};

use base64::Engine;
use serde_json::{Value, json};
use tungstenite::{Message, WebSocket};

/// The timeout for reading a message.
const READ_TIMEOUT: Duration = Duration::from_secs(60);

/// The timeout for an expression to become true.
const WAIT_TIMEOUT: Duration = Duration::from_secs(300);

/// The display settings of the page's reader.
#[derive(Clone, Copy)]
pub struct Viewer {
    /// The width of the window in pixels.
    pub width: u32,
    /// Whether the system is in dark mode.
    pub dark: bool,
    /// Whether motion should be reduced.
    pub reduced_motion: bool,
}

/// A desktop in light mode.
pub const DESKTOP: Viewer = Viewer {
    width: 1200,
    dark: false,
    reduced_motion: false,
};

/// A browser tab and the events it has reported.
pub struct Tab {
    socket: WebSocket<TcpStream>,
    session: Option<String>,
    sent: u64,
    events: Vec<Value>,
}

impl Tab {
    /// Opens a tab in the browser at `address`.
    pub fn open(address: &str) -> Self {
        let host = address.strip_prefix("ws://").unwrap();
        let host = host.split('/').next().unwrap();
        let stream = TcpStream::connect(host).unwrap();
        stream.set_read_timeout(Some(READ_TIMEOUT)).unwrap();
        let (socket, _) = tungstenite::client(address, stream).unwrap();
        let mut tab = Tab {
            socket,
            session: None,
            sent: 0,
            events: Vec::new(),
        };
        let target = tab.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attached = tab.call(
            "Target.attachToTarget",
            json!({ "targetId": target["targetId"], "flatten": true }),
        );
        tab.session = Some(attached["sessionId"].as_str().unwrap().to_owned());
        for domain in ["Page", "Runtime", "Log", "Network"] {
            tab.call(&format!("{domain}.enable"), json!({}));
        }
        tab
    }

    /// Opens a file and waits until the page has loaded.
    pub fn load(&mut self, file: &Path, reader: Viewer) {
        self.open_url(&format!("file://{}", file.display()), reader);
    }

    /// Opens an address and waits until the page has loaded.
    pub fn open_url(&mut self, url: &str, reader: Viewer) {
        self.resize(reader.width, 900);
        let scheme = if reader.dark { "dark" } else { "light" };
        let motion = if reader.reduced_motion {
            "reduce"
        } else {
            "no-preference"
        };
        let features = json!({ "features": [
            { "name": "prefers-color-scheme", "value": scheme },
            { "name": "prefers-reduced-motion", "value": motion },
        ]});
        self.call("Emulation.setEmulatedMedia", features);
        self.events.clear();
        self.call("Page.navigate", json!({ "url": url }));
        self.wait_until_loaded();
    }

    /// Resizes the window.
    pub fn resize(&mut self, width: u32, height: u32) {
        let metrics = json!({
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600,
        });
        self.call("Emulation.setDeviceMetricsOverride", metrics);
    }

    /// Waits until the page has loaded.
    pub fn wait_until_loaded(&mut self) {
        let is_load = |event: &Value| event["method"] == "Page.loadEventFired";
        while !self.events.iter().any(is_load) {
            self.read_message();
        }
        self.events.retain(|event| !is_load(event));
    }

    /// Evaluates an expression. If the result is a promise, waits for its value.
    pub fn eval(&mut self, expression: &str) -> Value {
        let arguments = json!({
            "expression": expression, "awaitPromise": true, "returnByValue": true, "userGesture": true,
        });
        let answer = self.call("Runtime.evaluate", arguments);
        assert!(
            answer.get("exceptionDetails").is_none(),
            "{expression}: {:#}",
            answer["exceptionDetails"]
        );
        answer["result"]["value"].clone()
    }

    /// Shows this tab and hides the others.
    pub fn bring_to_front(&mut self) {
        self.call("Page.bringToFront", json!({}));
    }

    /// Switches the page to print layout.
    pub fn emulate_print(&mut self) {
        self.call("Emulation.setEmulatedMedia", json!({ "media": "print" }));
    }

    /// Presses and releases a key. `code` is its Windows virtual key code.
    pub fn press(&mut self, key: &str, code: u32) {
        self.press_with_modifiers(key, code, 0);
    }

    /// Presses and releases a key while Shift is held down.
    pub fn press_with_shift(&mut self, key: &str, code: u32) {
        const SHIFT: u32 = 8;
        self.press_with_modifiers(key, code, SHIFT);
    }

    fn press_with_modifiers(&mut self, key: &str, code: u32, modifiers: u32) {
        // Without a character, Enter wouldn't open anything.
        let text = if key == "Enter" { "\r" } else { "" };
        for kind in ["keyDown", "keyUp"] {
            let arguments = json!({
                "type": kind, "key": key, "code": key, "text": text, "windowsVirtualKeyCode": code,
                "modifiers": modifiers,
            });
            self.call("Input.dispatchKeyEvent", arguments);
        }
    }

    /// Evaluates an expression repeatedly until it is true. Panics with the value of `state` if it
    /// stays false.
    pub fn wait_until(&mut self, expression: &str, state: &str) {
        let deadline = Instant::now() + WAIT_TIMEOUT;
        while self.eval(expression) != json!(true) {
            let is_late = Instant::now() >= deadline;
            assert!(!is_late, "not {expression}: {:#}", self.eval(state));
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Presses the left mouse button at a position, moves the mouse and releases the button.
    pub fn drag(&mut self, from: (f64, f64), to: (f64, f64)) {
        let events = [
            ("mousePressed", from, 1),
            ("mouseMoved", to, 1),
            ("mouseReleased", to, 0),
        ];
        for (kind, (x, y), buttons) in events {
            let arguments = json!({
                "type": kind, "x": x, "y": y, "button": "left", "buttons": buttons, "clickCount": 1,
            });
            self.call("Input.dispatchMouseEvent", arguments);
        }
    }

    /// Returns a picture of the window, as PNG.
    pub fn screenshot(&mut self) -> Vec<u8> {
        let answer = self.call("Page.captureScreenshot", json!({ "format": "png" }));
        let data = answer["data"].as_str().unwrap();
        base64::engine::general_purpose::STANDARD
            .decode(data)
            .unwrap()
    }

    /// Returns the errors logged to the console since the page was loaded, such as exceptions and
    /// violations of the content security policy.
    pub fn errors(&mut self) -> Vec<String> {
        // Wait for an answer, so that all events sent before it are received.
        self.eval("0");
        let is_error = |event: &&Value| match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => true,
            Some("Runtime.consoleAPICalled") => event["params"]["type"] == "error",
            Some("Log.entryAdded") => event["params"]["entry"]["level"] == "error",
            _ => false,
        };
        let errors = self.events.iter().filter(is_error);
        errors.map(|event| event["params"].to_string()).collect()
    }

    /// Returns the URLs that were requested since the page was loaded, except the page itself and
    /// embedded data.
    pub fn requests(&mut self) -> Vec<String> {
        self.eval("0");
        let events = self.events.iter();
        let urls = events
            .filter(|event| event["method"] == "Network.requestWillBeSent")
            .filter(|event| event["params"]["type"] != "Document")
            .filter_map(|event| event["params"]["request"]["url"].as_str());
        urls.filter(|url| !url.starts_with("data:"))
            .map(str::to_owned)
            .collect()
    }

    fn call(&mut self, method: &str, params: Value) -> Value {
        self.sent += 1;
        let mut message = json!({ "id": self.sent, "method": method, "params": params });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        self.socket
            .send(Message::text(message.to_string()))
            .unwrap();
        loop {
            if let Some(answer) = self.read_message() {
                assert!(answer.get("error").is_none(), "{method}: {answer}");
                return answer["result"].clone();
            }
        }
    }

    /// Reads one message. Returns the answer to the last call, or `None` for an event, which is
    /// stored.
    fn read_message(&mut self) -> Option<Value> {
        let message = self.socket.read().unwrap();
        let message: Value = serde_json::from_str(message.to_text().unwrap()).ok()?;
        if message["id"] == json!(self.sent) {
            return Some(message);
        }
        self.events.push(message);
        None
    }
}

/// axe-core 4.14.1 by Deque Systems (MPL-2.0), unchanged from its npm package.
const AXE: &str = include_str!("../../browser/axe/axe.min.js");

/// Opens all collapsed sections of the loaded page. Returns the violations found by axe-core.
pub fn violations(tab: &mut Tab) -> Vec<String> {
    tab.eval("for (const details of document.querySelectorAll('details')) details.open = true; 0");
    tab.eval(&format!("{AXE}; 0"));
    let violations = tab.eval(
        "axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] })
            .then((found) => found.violations.map((rule) =>
                `${rule.id}: ${rule.help}: ${rule.nodes.slice(0, 3).map((node) => node.html).join(' ')}`))",
    );
    serde_json::from_value(violations).unwrap()
}
