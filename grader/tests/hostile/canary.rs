//! Secrets that nobody may find, and listeners that nobody may reach.

use std::fs;
use std::io::ErrorKind;
use std::net::{Ipv4Addr, TcpListener, UdpSocket};
use std::os::unix::net::UnixListener;
use std::path::PathBuf;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use tempfile::TempDir;

/// Where the grader keeps what it uses again.
const GRADE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../target/grade");

/// Planted anew for each run.
pub struct Canaries {
    folder: TempDir,
    /// In a file that everyone on this machine may read.
    key: String,
    /// In the grader's environment.
    secret: String,
    /// Part of the name of everything that an entry leaves behind on purpose.
    pub mark: String,
    tcp: TcpListener,
    udp: UdpSocket,
    unix: UnixListener,
}

impl Canaries {
    /// The variable in the grader's environment.
    pub const VARIABLE: &str = "HOSTILE_SECRET";

    pub fn plant() -> Self {
        let token = || format!("{:016x}", getrandom::u64().expect("random numbers"));
        let folder = TempDir::new().expect("a folder");
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
        fs::write(canaries.key_file(), &canaries.key).expect("a file");
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

    /// A place for the grader's files, beside the key.
    pub fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    /// What an entry's text may name.
    pub fn placeholders(&self) -> [(&'static str, String); 8] {
        let port = |address: std::io::Result<std::net::SocketAddr>| {
            address.expect("it is bound").port().to_string()
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

    /// The secrets that stand in a text, as they are, backwards, or in base 64.
    pub fn secrets_in(&self, text: &str) -> Vec<&'static str> {
        let stands = |secret: &str| {
            let backwards: String = secret.chars().rev().collect();
            let encoded = STANDARD.encode(secret);
            [secret, &backwards, encoded.trim_end_matches('=')]
                .into_iter()
                .any(|form| text.contains(form))
        };
        let all = [
            ("the key's file", &self.key),
            ("the environment", &self.secret),
        ];
        let found = all.into_iter().filter(|(_, secret)| stands(secret));
        found.map(|(what, _)| what).collect()
    }

    /// The listeners that somebody has reached.
    pub fn reached_listeners(&self) -> Vec<&'static str> {
        let came = |result: std::io::Result<()>| match result {
            Ok(()) => true,
            Err(error) => error.kind() != ErrorKind::WouldBlock,
        };
        let all = [
            ("TCP", came(self.tcp.accept().map(drop))),
            ("UDP", came(self.udp.recv(&mut [0; 8]).map(drop))),
            ("a Unix socket", came(self.unix.accept().map(drop))),
        ];
        let reached = all.into_iter().filter(|(_, came)| *came);
        reached.map(|(what, _)| what).collect()
    }
}
