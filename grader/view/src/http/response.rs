//! Writes responses.

use std::io::{self, Write};

/// The status of a response, as in its first line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Status(&'static str);

impl Status {
    /// The request succeeded.
    pub const OK: Status = Status("200 OK");
    /// Nothing has changed.
    pub const NO_CONTENT: Status = Status("204 No Content");
    /// The request is malformed.
    pub const BAD_REQUEST: Status = Status("400 Bad Request");
    /// The request isn't allowed.
    pub const FORBIDDEN: Status = Status("403 Forbidden");
    /// The page doesn't exist.
    pub const NOT_FOUND: Status = Status("404 Not Found");
    /// The server is busy.
    pub const UNAVAILABLE: Status = Status("503 Service Unavailable");
}

/// A response.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Response {
    status: Status,
    content_type: Option<String>,
    body: Vec<u8>,
}

/// Headers of every response. With these headers, nothing is loaded from elsewhere, no other page
/// may embed this one, and no link reveals this page's address to another site.
const HEADERS: [(&str, &str); 7] = [
    (
        "Content-Security-Policy",
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; \
         connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    ("Referrer-Policy", "no-referrer"),
    ("X-Content-Type-Options", "nosniff"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cache-Control", "no-store"),
    ("Connection", "close"),
];

impl Response {
    /// Creates a response with a body of this type.
    pub fn new(status: Status, content_type: &str, body: impl Into<Vec<u8>>) -> Self {
        Response {
            status,
            content_type: Some(content_type.to_owned()),
            body: body.into(),
        }
    }

    /// Creates a response with a line of text.
    pub fn text(status: Status, text: &str) -> Self {
        Response::new(status, "text/plain; charset=utf-8", format!("{text}\n"))
    }

    /// Creates a response that says that nothing has changed.
    pub fn nothing() -> Self {
        Response {
            status: Status::NO_CONTENT,
            content_type: None,
            body: Vec::new(),
        }
    }

    /// Writes the response.
    pub fn write(&self, to: &mut impl Write) -> io::Result<()> {
        let mut head = format!("HTTP/1.1 {}\r\n", self.status.0);
        let own = self
            .content_type
            .iter()
            .map(|value| ("Content-Type", &**value));
        for (name, value) in HEADERS.into_iter().chain(own) {
            head += &format!("{name}: {value}\r\n");
        }
        head += &format!("Content-Length: {}\r\n\r\n", self.body.len());
        to.write_all(&[head.as_bytes(), &self.body].concat())?;
        to.flush()
    }
}
