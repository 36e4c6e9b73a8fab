//! Finds, starts and stops Chromium.

use std::env;
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;

use crate::devtools::Tab;

const NAMES: [&str; 5] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
];

const SKIP_NOTICE: &[u8] =
    b"SKIPPED: there is no Chromium, so the page was not tested in a browser\n";

/// A browser with its own temporary profile.
pub struct Chromium {
    process: Child,
    address: String,
    _profile: TempDir,
}

impl Chromium {
    /// Starts Chromium. If it isn't installed, prints a notice and returns `None`, or panics if
    /// `CI` is set.
    pub fn start() -> Option<Self> {
        let Some(program) = find() else {
            assert!(
                env::var_os("CI").is_none(),
                "CI is set, but there is no Chromium: apt-get install chromium"
            );
            // A passing test hides the output of `eprintln!`.
            std::io::stderr().write_all(SKIP_NOTICE).unwrap();
            return None;
        };
        let profile = TempDir::new().unwrap();
        let mut process = Command::new(program)
            .args(["--headless=new", "--remote-debugging-port=0"])
            // Test machines often don't allow the user namespaces needed for Chromium's sandbox,
            // and the pages are trusted.
            .args([
                "--no-sandbox",
                "--disable-gpu",
                "--no-first-run",
                "--disable-dev-shm-usage",
            ])
            .args([
                "--disable-background-networking",
                "--disable-component-update",
            ])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(process.stderr.take().unwrap()).lines();
        let address = lines
            .by_ref()
            .map_while(Result::ok)
            .find_map(|line| Some(line.strip_prefix("DevTools listening on ")?.to_owned()))
            .expect("Chromium prints its address");
        // The thread keeps reading, so that Chromium never blocks on a full pipe.
        std::thread::spawn(move || lines.map_while(Result::ok).for_each(drop));
        Some(Chromium {
            process,
            address,
            _profile: profile,
        })
    }

    /// Opens a tab.
    pub fn tab(&self) -> Tab {
        Tab::open(&self.address)
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        // The process may already have ended.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn find() -> Option<PathBuf> {
    let named = env::var_os("CHROME").map(PathBuf::from);
    let path = env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = env::split_paths(&path).collect();
    let on_path = NAMES.iter().flat_map(|name| {
        let file = format!("{name}{}", env::consts::EXE_SUFFIX);
        folders.iter().map(move |folder| folder.join(&file))
    });
    let elsewhere = [
        "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
        "/Applications/Chromium.app/Contents/MacOS/Chromium",
    ];
    let mut all = named
        .into_iter()
        .chain(on_path)
        .chain(elsewhere.map(PathBuf::from));
    all.find(|program| program.is_file())
}
