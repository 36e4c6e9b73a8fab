//! Of what cargo-mutants makes of the reference, a fixed part is asked: through the real binary. The
//! whole is asked by `cargo author mutants`.

use std::process::Command;

#[test]
fn sampled_mutants_are_caught_or_equivalent() {
    let output = Command::new(env!("CARGO_BIN_EXE_author"))
        .args(["mutants", "--fast", "--check"])
        .output()
        .expect("the binary was built for this test");
    let said = String::from_utf8_lossy(&output.stdout);
    let complaints = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}{complaints}");
    assert!(said.contains("asked: one in 8"), "{said}");
    assert!(said.trim_end().ends_with(", 0 survive"), "{said}");
}
