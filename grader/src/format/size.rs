//! Keeps files within the size limits of platforms, no matter how much text a submission produces.

/// The limits on the number of characters per text, in the order they are tried.
const TEXT_LIMITS: [usize; 5] = [4_000, 1_000, 250, 60, 0];

/// Renders a file with smaller and smaller text limits until it is at most `max_bytes` long. If it
/// is too long even with the smallest limit, returns it anyway.
pub fn fit(max_bytes: usize, render: impl Fn(usize) -> String) -> String {
    let mut texts = TEXT_LIMITS.into_iter().map(&render);
    let fitting = texts.find(|text| text.len() <= max_bytes);
    fitting.unwrap_or_else(|| render(0))
}

/// Truncates text to `max_chars` characters. Appends a mark if anything was cut off.
pub fn truncate(text: &str, max_chars: usize) -> String {
    match text.char_indices().nth(max_chars) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}… (cut)", &text[..end]),
    }
}

#[cfg(test)]
mod tests {
    use super::{fit, truncate};

    #[test]
    fn truncates_texts_until_the_file_fits() {
        let text = "é".repeat(5_000);
        let fitted = |max_bytes| fit(max_bytes, |max_chars| truncate(&text, max_chars));
        assert_eq!(fitted(100_000), format!("{}… (cut)", "é".repeat(4_000)));
        assert_eq!(fitted(600), format!("{}… (cut)", "é".repeat(250)));
        assert_eq!(fitted(1), "… (cut)", "nothing is left to cut");
        assert_eq!(truncate("short", 5), "short");
    }
}
