//! Reads requests.

use std::io::Read;

/// The maximum length of a request line and its headers, in bytes.
const MAX_HEAD_BYTES: usize = 16 << 10;
/// The maximum length of a request's body, in bytes. The longest command is about 100 bytes long.
const MAX_BODY_BYTES: usize = 16 << 10;
/// The maximum number of headers. Browsers send about 20.
const MAX_HEADERS: usize = 64;

/// The methods that the server knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Reads something.
    Get,
    /// Changes something.
    Post,
}

/// A request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Request {
    /// The method.
    pub method: Method,
    /// The path, such as `/state`, without the query.
    pub path: String,
    /// The query, without the question mark.
    pub query: String,
    /// The headers, with names in lower case.
    headers: Vec<(String, String)>,
    /// The body.
    pub body: Vec<u8>,
}

/// The reason a request could not be read.
#[derive(Debug, thiserror::Error)]
pub enum RequestError {
    /// The connection ended or failed before the request was complete.
    #[error("the connection was closed: {0}")]
    Io(#[from] std::io::Error),
    /// The request is not valid HTTP/1.1 or uses a part of it that the server doesn't support.
    #[error("the request is malformed: {0}")]
    Malformed(String),
    /// The request is too long.
    #[error("the request is too long")]
    TooLong,
    /// The method is not GET or POST.
    #[error("the method is not supported: use GET or POST")]
    Method,
}

impl Request {
    /// Reads one request.
    pub fn read(from: &mut impl Read) -> Result<Self, RequestError> {
        let mut bytes = Vec::new();
        let (mut request, head, length) = loop {
            read_more(from, &mut bytes)?;
            if let Some(parsed) = Request::parse_head(&bytes)? {
                break parsed;
            }
            if bytes.len() > MAX_HEAD_BYTES {
                return Err(RequestError::TooLong);
            }
        };
        if head > MAX_HEAD_BYTES || length > MAX_BODY_BYTES {
            return Err(RequestError::TooLong);
        }
        while bytes.len() < head + length {
            read_more(from, &mut bytes)?;
        }
        request.body = bytes[head..head + length].to_vec();
        Ok(request)
    }

    /// Parses the request line and the headers. Returns the request (without its body) and the
    /// lengths of the head and the body. Returns `None` if the head is incomplete.
    fn parse_head(bytes: &[u8]) -> Result<Option<(Self, usize, usize)>, RequestError> {
        let mut headers = [httparse::EMPTY_HEADER; MAX_HEADERS];
        let mut parsed = httparse::Request::new(&mut headers);
        let malformed = |error: httparse::Error| RequestError::Malformed(error.to_string());
        let httparse::Status::Complete(head) = parsed.parse(bytes).map_err(malformed)? else {
            return Ok(None);
        };
        let method = match parsed.method {
            Some("GET") => Method::Get,
            Some("POST") => Method::Post,
            Some(_) | None => return Err(RequestError::Method),
        };
        let target = parsed.path.unwrap_or("/");
        let (path, query) = target.split_once('?').unwrap_or((target, ""));
        let text = |value: &[u8]| String::from_utf8_lossy(value).into_owned();
        let headers = parsed.headers.iter();
        let headers = headers.map(|header| (header.name.to_lowercase(), text(header.value)));
        let request = Request {
            method,
            path: path.to_owned(),
            query: query.to_owned(),
            headers: headers.collect(),
            body: Vec::new(),
        };
        // A chunked body has no length. This server's page never sends such a body.
        if request.header("transfer-encoding").is_some() {
            return Err(RequestError::Malformed(
                "a body without a length".to_owned(),
            ));
        }
        let length = match request.header("content-length") {
            None => 0,
            Some(length) => length
                .parse()
                .map_err(|_| RequestError::Malformed("an invalid length".to_owned()))?,
        };
        Ok(Some((request, head, length)))
    }

    /// Returns the value of a header, given its name in lower case. Returns `None` if the header is
    /// missing or occurs twice, since two values of `Host` could deceive a check.
    pub fn header(&self, name: &str) -> Option<&str> {
        let mut values = self.headers.iter().filter(|(known, _)| known == name);
        match (values.next(), values.next()) {
            (Some((_, value)), None) => Some(value),
            _ => None,
        }
    }

    /// Returns the value of a parameter in the query. The value isn't decoded, because the
    /// parameters in the server's own links only contain letters and digits.
    pub fn parameter(&self, name: &str) -> Option<&str> {
        let parameters = self.query.split('&');
        parameters
            .filter_map(|parameter| parameter.split_once('='))
            .find(|(known, _)| *known == name)
            .map(|(_, value)| value)
    }
}

fn read_more(from: &mut impl Read, bytes: &mut Vec<u8>) -> Result<(), RequestError> {
    let mut buffer = [0; 4 << 10];
    match from.read(&mut buffer)? {
        0 => Err(RequestError::Io(std::io::ErrorKind::UnexpectedEof.into())),
        read => {
            bytes.extend_from_slice(&buffer[..read]);
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rejects_what_it_does_not_support() {
        let long = format!("GET /{} HTTP/1.1\r\n\r\n", "x".repeat(20_000));
        for (text, why) in [
            (long.as_str(), "too long"),
            (
                "POST / HTTP/1.1\r\nContent-Length: 99999999\r\n\r\n",
                "too long",
            ),
            (
                "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
                "malformed: a body without a length",
            ),
            ("PUT / HTTP/1.1\r\n\r\n", "not supported"),
            ("\u{1}\r\n\r\n", "malformed"),
            ("GET / HTTP/1.1\r\n", "the connection was closed"),
        ] {
            let error = Request::read(&mut text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(why), "{text:?}: {error}");
        }
    }
}
