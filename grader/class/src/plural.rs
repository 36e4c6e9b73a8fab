//! Numbers with nouns.

/// Returns a number with its noun, which gets an `s` unless the number is 1.
pub fn count(number: usize, noun: &str) -> String {
    match number {
        1 => format!("1 {noun}"),
        number => format!("{number} {noun}s"),
    }
}
