//! What this machine offers.

use std::process::Command;

use grader::sandbox::Isolation;

/// The best level that holds here, as the grader's own trial has it. Where `CI` is set, it has to
/// be one that keeps submissions apart.
pub fn best_level() -> Isolation {
    let output = Command::new(env!("CARGO_BIN_EXE_grader"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .arg("--doctor")
        .output()
        .expect("the grader starts");
    let told = String::from_utf8_lossy(&output.stdout);
    let holds = |level: &Isolation| {
        let mut lines = told.lines().map(str::split_whitespace);
        lines.any(|mut words| words.next() == Some(level.name()) && words.next() == Some("holds"))
    };
    let best = Isolation::ALL
        .into_iter()
        .find(holds)
        .unwrap_or(Isolation::None);
    if best == Isolation::None {
        assert!(
            std::env::var_os("CI").is_none(),
            "no isolation here:\n{told}"
        );
        eprintln!("SKIPPED: what only a sandbox keeps, since there is none here:\n{told}");
    }
    best
}
