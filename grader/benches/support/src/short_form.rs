//! The short form of a benchmark: with `--check`, it measures everything once, and so checks that it
//! still works.

/// Returns whether the command line asks for the short form.
pub fn is_short() -> bool {
    std::env::args().any(|argument| argument == "--check")
}

/// Returns `full`, or in the short form 1.
pub fn repetitions(full: usize) -> usize {
    if is_short() { 1 } else { full }
}
