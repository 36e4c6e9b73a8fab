//! Decides which requests to answer. The page shows and controls the user's program, so only the
//! user's browser may talk to this server, even though any user of this machine and any web page
//! opened on this machine can connect.

use std::env;

use crate::http::Request;

/// Host names that always refer to this machine.
const LOOPBACK: [&str; 3] = ["127.0.0.1", "localhost", "[::1]"];
/// The name of the header that contains the token, in lower case. A page from another site or port
/// cannot send this header, because the browser would first ask this server for permission, which
/// the server never gives.
pub const HEADER: &str = "view-token";

/// The secret that requests must contain, and the host names that they may be sent to.
#[derive(Clone, Debug)]
pub struct Access {
    /// The secret in the printed address. The page keeps it in its origin's storage. A cookie
    /// wouldn't be safe, because browsers send a host's cookies to every port on that host.
    token: String,
    /// The host names under which this server can be reached.
    hosts: Vec<String>,
    /// The public name of the port in a codespace.
    forwarded: Option<String>,
}

impl Access {
    /// Creates a new secret for a server that listens on this port and can also be reached under
    /// these names.
    pub fn new(port: u16, allowed_hosts: &[String]) -> Result<Self, getrandom::Error> {
        let hosts = LOOPBACK.map(str::to_owned).into_iter();
        let forwarded = forwarded_host(port);
        let hosts = hosts
            .chain(allowed_hosts.iter().cloned())
            .chain(forwarded.clone());
        Ok(Access {
            token: secret()?,
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

    /// Returns the reason to refuse a request, or `None` if it should be answered. The page's files
    /// are public, because they are the same for everyone and contain no secrets.
    pub fn refusal(&self, request: &Request, is_public: bool) -> Option<&'static str> {
        // A page from another site can send requests here by resolving its own name to this
        // address, but it cannot change the name in `Host`.
        let host = request.header("host").map(without_port);
        if !host.is_some_and(|host| self.hosts.contains(&host.to_lowercase())) {
            return Some(
                "this host name is not allowed; to allow it, start `cargo view` with --allow-host \
                 NAME",
            );
        }
        let has_token = request
            .header(HEADER)
            .is_some_and(|given| same(given, &self.token));
        (!is_public && !has_token)
            .then_some("open the address that `cargo view` printed in the terminal")
    }
}

/// Returns the public name of this port if the environment variables of a GitHub codespace are set.
fn forwarded_host(port: u16) -> Option<String> {
    let name = env::var("CODESPACE_NAME").ok()?;
    let domain = env::var("GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN").ok()?;
    Some(format!("{name}-{port}.{domain}"))
}

/// Returns a host without its port. The port isn't compared, because a tunnel can use a different
/// port.
fn without_port(host: &str) -> &str {
    match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        Some(_) | None => host,
    }
}

/// Compares two secrets in time that doesn't depend on how many characters match.
fn same(given: &str, secret: &str) -> bool {
    let pairs = given.bytes().zip(secret.bytes());
    given.len() == secret.len() && pairs.fold(0, |different, (a, b)| different | (a ^ b)) == 0
}

/// Returns 128 random bits as hexadecimal digits.
fn secret() -> Result<String, getrandom::Error> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}
