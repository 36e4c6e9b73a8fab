//! Secrets that submissions must not find, and listeners that they must not contact.

use std::fs;
use std::io::ErrorKind;
use std::net::{Ipv4Addr, TcpListener, UdpSocket};
use std::os::unix::net::UnixListener;
use std::path::PathBuf;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use tempfile::TempDir;

/// The grader's cache folder.
const GRADE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../target/grade");

/// The secrets and listeners of one run.
pub struct Canaries {
    folder: TempDir,
    /// A secret in a file that everyone on this machine may read.
    key: String,
    /// A secret in the grader's environment.
    secret: String,
    /// Text that is part of the name of every file that an entry deliberately leaves behind.
    pub mark: String,
    tcp: TcpListener,
    udp: UdpSocket,
    unix: UnixListener,
}

impl Canaries {
    /// The name of the environment variable that contains the secret.
    pub const VARIABLE: &str = "HOSTILE_SECRET";

    pub fn plant() -> Self {
        let token = || format!("{:016x}", getrandom::u64().expect("random numbers"));
        let folder = TempDir::new().expect("temporary folder");
        let local = (Ipv4Addr::LOCALHOST, 0);
        let canaries = Canaries {
            key: format!("canary{}", token()),
            secret: format!("canary{}", token()),
            mark: format!("hostile{}", token()),
            tcp: TcpListener::bind(local).expect("a port"),
            udp: UdpSocket::bind(local).expect("a port"),
            unix: UnixListener::bind(folder.path().join("socket")).expect("a socket"),
            folder,
        };
        fs::write(canaries.key_file(), &canaries.key).expect("the file can be written");
        canaries.tcp.set_nonblocking(true).expect("a socket");
        canaries.udp.set_nonblocking(true).expect("a socket");
        canaries.unix.set_nonblocking(true).expect("a socket");
        canaries
    }

    pub fn key_file(&self) -> PathBuf {
        self.folder.path().join("key")
    }

    pub fn secret(&self) -> &str {
        &self.secret
    }

    /// Returns the folder for the grader's output files, which is next to the key.
    pub fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    /// Returns the placeholders that an entry's text may contain, each with its value.
    pub fn placeholders(&self) -> [(&'static str, String); 8] {
        let port = |address: std::io::Result<std::net::SocketAddr>| {
            address.expect("the socket is bound").port().to_string()
        };
        [
            ("KEY", self.key_file().display().to_string()),
            ("VARIABLE", Canaries::VARIABLE.to_owned()),
            ("MARK", self.mark.clone()),
            ("OUT", self.out().display().to_string()),
            ("GRADE", GRADE.to_owned()),
            ("TCP", port(self.tcp.local_addr())),
            ("UDP", port(self.udp.local_addr())),
            (
                "UNIX",
                self.folder.path().join("socket").display().to_string(),
            ),
        ]
    }

    /// Returns the names of the secrets that `text` contains, unchanged, reversed or in base 64.
    pub fn secrets_in(&self, text: &str) -> Vec<&'static str> {
        let is_in_text = |secret: &str| {
            let reversed: String = secret.chars().rev().collect();
            let encoded = STANDARD.encode(secret);
            [secret, &reversed, encoded.trim_end_matches('=')]
                .into_iter()
                .any(|encoding| text.contains(encoding))
        };
        let all = [
            ("the key file", &self.key),
            ("the environment", &self.secret),
        ];
        let found = all.into_iter().filter(|(_, secret)| is_in_text(secret));
        found.map(|(what, _)| what).collect()
    }

    /// Returns the names of the listeners that were contacted.
    pub fn reached_listeners(&self) -> Vec<&'static str> {
        let is_contacted = |result: std::io::Result<()>| match result {
            Ok(()) => true,
            Err(error) => error.kind() != ErrorKind::WouldBlock,
        };
        let all = [
            ("TCP", is_contacted(self.tcp.accept().map(drop))),
            ("UDP", is_contacted(self.udp.recv(&mut [0; 8]).map(drop))),
            ("a Unix socket", is_contacted(self.unix.accept().map(drop))),
        ];
        let reached = all.into_iter().filter(|(_, is_contacted)| *is_contacted);
        reached.map(|(what, _)| what).collect()
    }
}
