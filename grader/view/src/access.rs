//! Decides which requests are answered. The page shows and controls a program of the user, so only
//! the user's browser may talk to it, although every user and every web page of this machine can
//! open connections to it.

use std::env;

use crate::http::{Method, Request};

/// Names that always mean this machine.
const LOOPBACK: [&str; 3] = ["127.0.0.1", "localhost", "[::1]"];

/// The secrets and names that a request must know.
#[derive(Clone, Debug)]
pub struct Access {
    /// The secret in the address that is printed.
    token: String,
    /// The secret in the cookie, for which the token is exchanged.
    session: String,
    /// The name of the cookie. It contains the port, because a browser sends the cookies of one port
    /// to all others.
    cookie: String,
    /// The names of hosts that lead here.
    hosts: Vec<String>,
    /// The name that a codespace gives to the port.
    forwarded: Option<String>,
}

/// The decision about a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Decision {
    /// The request comes from the page.
    Allowed,
    /// The request has the token. The response sets this cookie.
    SetCookie(String),
    /// The request is not answered, for this reason.
    Forbidden(&'static str),
}

impl Access {
    /// Draws new secrets, for a server at this port that is also reached by these names.
    pub fn new(port: u16, allowed_hosts: &[String]) -> Result<Self, getrandom::Error> {
        let hosts = LOOPBACK.map(str::to_owned).into_iter();
        let forwarded = forwarded_host(port, |name| env::var(name).ok());
        let hosts = hosts
            .chain(allowed_hosts.iter().cloned())
            .chain(forwarded.clone());
        Ok(Access {
            token: secret()?,
            session: secret()?,
            cookie: format!("view-{port}"),
            hosts: hosts.map(|host| host.to_lowercase()).collect(),
            forwarded,
        })
    }

    /// Returns the public name of the port, if this machine is a GitHub codespace.
    pub fn forwarded(&self) -> Option<&str> {
        self.forwarded.as_deref()
    }

    /// Returns the path with the token.
    pub fn first_path(&self) -> String {
        format!("/?token={}", self.token)
    }

    /// Decides about a request.
    pub fn check(&self, request: &Request) -> Decision {
        // A page of another site can send requests here by giving its own name this address. It
        // cannot change the name in `Host`.
        let host = request.header("host").map(without_port);
        if !host.is_some_and(|host| self.is_known(host)) {
            return Decision::Forbidden(
                "this name of the host is not known; to allow it, start `cargo view` with --allow-host NAME",
            );
        }
        if !self.has_allowed_origin(request) {
            return Decision::Forbidden("the request comes from another page");
        }
        let is = |given: Option<&str>, secret| given.is_some_and(|given| same(given, secret));
        if request.method == Method::Get
            && request.path == "/"
            && is(request.parameter("token"), &self.token)
        {
            let Access {
                cookie, session, ..
            } = self;
            return Decision::SetCookie(format!(
                "{cookie}={session}; Path=/; HttpOnly; SameSite=Strict"
            ));
        }
        if is(request.cookie(&self.cookie), &self.session) {
            Decision::Allowed
        } else {
            Decision::Forbidden("open the address that `cargo view` has printed in the terminal")
        }
    }

    /// Returns whether the request comes from a page of this server. A browser sends `Origin` with
    /// each POST.
    fn has_allowed_origin(&self, request: &Request) -> bool {
        match (request.header("origin"), request.method) {
            (None, Method::Get) => true,
            (None, Method::Post) => false,
            (Some(origin), _) => {
                let scheme_and_host = origin.split_once("://");
                scheme_and_host.is_some_and(|(scheme, host)| {
                    ["http", "https"].contains(&scheme) && self.is_known(without_port(host))
                })
            }
        }
    }

    fn is_known(&self, host: &str) -> bool {
        self.hosts.contains(&host.to_lowercase())
    }
}

/// Returns the public name of this port in a GitHub codespace, if the environment is that of one.
fn forwarded_host(port: u16, variable: impl Fn(&str) -> Option<String>) -> Option<String> {
    let name = variable("CODESPACE_NAME")?;
    let domain = variable("GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN")?;
    Some(format!("{name}-{port}.{domain}"))
}

/// Returns a host without its port. The port is not compared, because a tunnel can have another one.
fn without_port(host: &str) -> &str {
    match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        Some(_) | None => host,
    }
}

/// Compares two secrets. The time does not depend on the number of equal characters.
fn same(given: &str, secret: &str) -> bool {
    let pairs = given.bytes().zip(secret.bytes());
    given.len() == secret.len() && pairs.fold(0, |different, (a, b)| different | (a ^ b)) == 0
}

/// Returns 128 random bits in hexadecimal digits.
fn secret() -> Result<String, getrandom::Error> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn access() -> Access {
        Access {
            token: "t0".to_owned(),
            session: "s1".to_owned(),
            cookie: "view-80".to_owned(),
            hosts: ["localhost", "[::1]", "my-80.example"]
                .map(str::to_owned)
                .to_vec(),
            forwarded: None,
        }
    }

    fn check(text: &str) -> Decision {
        let text = format!("{}\r\n\r\n", text.replace('\n', "\r\n"));
        access().check(&Request::read(&mut text.as_bytes()).unwrap())
    }

    #[test]
    fn the_token_is_exchanged_for_a_strict_cookie() {
        let first = check("GET /?token=t0 HTTP/1.1\nHost: localhost:9000");
        let cookie = "view-80=s1; Path=/; HttpOnly; SameSite=Strict".to_owned();
        assert_eq!(first, Decision::SetCookie(cookie));
        let next = check("GET /state HTTP/1.1\nHost: [::1]:80\nCookie: view-80=s1");
        assert_eq!(next, Decision::Allowed);
    }

    #[test]
    fn without_the_secrets_nothing_is_answered() {
        for text in [
            "GET / HTTP/1.1\nHost: localhost",
            "GET /?token=t1 HTTP/1.1\nHost: localhost",
            "GET /?token= HTTP/1.1\nHost: localhost",
            "GET /state?token=t0 HTTP/1.1\nHost: localhost",
            "GET / HTTP/1.1\nHost: localhost\nCookie: view-80=t0",
            "GET / HTTP/1.1\nHost: localhost\nCookie: view-81=s1",
        ] {
            assert!(
                matches!(check(text), Decision::Forbidden(why) if why.contains("printed")),
                "{text}"
            );
        }
    }

    #[test]
    fn other_hosts_and_origins_are_refused_even_with_the_cookie() {
        let with = |method: &str, headers: &str| {
            check(&format!(
                "{method} /state HTTP/1.1\nCookie: view-80=s1\n{headers}"
            ))
        };
        assert_eq!(with("GET", "Host: MY-80.example"), Decision::Allowed);
        assert_eq!(
            with("POST", "Host: localhost\nOrigin: http://localhost:8080"),
            Decision::Allowed
        );
        assert_eq!(
            with("POST", "Host: localhost\nOrigin: https://my-80.example"),
            Decision::Allowed
        );
        for (method, headers) in [
            ("GET", "Host: evil.example"),
            ("GET", "Host: localhost.evil.example"),
            ("GET", "X: 1"),
            ("GET", "Host: localhost\nHost: evil.example"),
            ("GET", "Host: localhost\nOrigin: http://evil.example"),
            ("POST", "Host: localhost"),
            ("POST", "Host: localhost\nOrigin: null"),
            ("POST", "Host: localhost\nOrigin: file://localhost"),
        ] {
            let decision = with(method, headers);
            assert!(
                matches!(decision, Decision::Forbidden(_)),
                "{method} {headers}"
            );
        }
    }

    #[test]
    fn a_codespace_has_a_forwarded_name() {
        let variable = |name: &str| match name {
            "CODESPACE_NAME" => Some("ada".to_owned()),
            "GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN" => Some("app.github.dev".to_owned()),
            _ => None,
        };
        assert_eq!(
            forwarded_host(8420, variable).as_deref(),
            Some("ada-8420.app.github.dev")
        );
        assert_eq!(forwarded_host(8420, |_| None), None);
    }
}
