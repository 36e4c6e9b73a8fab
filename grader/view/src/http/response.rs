//! Writes responses.

use std::io::{self, Write};

/// The status of a response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The request succeeded.
    Ok,
    /// There is nothing new.
    NoContent,
    /// The request is malformed.
    BadRequest,
    /// The request is not allowed.
    Forbidden,
    /// There is no such page.
    NotFound,
    /// The server is busy.
    Unavailable,
}

/// A response.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Response {
    status: Status,
    content_type: Option<String>,
    body: Vec<u8>,
}

/// Headers of every response. Nothing is loaded from elsewhere, no other page may embed this one,
/// and no link tells another site the address.
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

impl Status {
    fn line(self) -> &'static str {
        match self {
            Status::Ok => "200 OK",
            Status::NoContent => "204 No Content",
            Status::BadRequest => "400 Bad Request",
            Status::Forbidden => "403 Forbidden",
            Status::NotFound => "404 Not Found",
            Status::Unavailable => "503 Service Unavailable",
        }
    }
}

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

    /// Creates a response that says that there is nothing new.
    pub fn nothing() -> Self {
        Response {
            status: Status::NoContent,
            content_type: None,
            body: Vec::new(),
        }
    }

    /// Returns the body.
    #[cfg(test)]
    pub fn body(&self) -> &[u8] {
        &self.body
    }

    /// Writes the response.
    pub fn write(&self, to: &mut impl Write) -> io::Result<()> {
        let mut head = format!("HTTP/1.1 {}\r\n", self.status.line());
        let own = self
            .content_type
            .iter()
            .map(|value| ("Content-Type", &**value));
        for (name, value) in HEADERS.into_iter().chain(own) {
            head += &format!("{name}: {value}\r\n");
        }
        head += &format!("Content-Length: {}\r\n\r\n", self.body.len());
        let mut bytes = head.into_bytes();
        bytes.extend_from_slice(&self.body);
        to.write_all(&bytes)?;
        to.flush()
    }
}
