//! Files that keep within what a platform takes, whatever a submission has to say.

/// The most characters of each text, one try after the other.
const TEXT_LIMITS: [usize; 5] = [4_000, 1_000, 250, 60, 0];

/// The first text of at most `most` bytes, made with texts that are cut shorter and shorter.
pub fn fit(most: usize, make: impl Fn(usize) -> String) -> String {
    let mut texts = TEXT_LIMITS.into_iter().map(&make);
    let fitting = texts.find(|text| text.len() <= most);
    fitting.unwrap_or_else(|| make(0))
}

/// The beginning of a text, with a mark where it was cut.
pub fn truncate(text: &str, longest: usize) -> String {
    match text.char_indices().nth(longest) {
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
        let made = |most| fit(most, |longest| truncate(&text, longest));
        assert_eq!(made(100_000), format!("{}… (cut)", "é".repeat(4_000)));
        assert_eq!(made(600), format!("{}… (cut)", "é".repeat(250)));
        assert_eq!(made(1), "… (cut)", "nothing is left to cut");
        assert_eq!(truncate("short", 5), "short");
    }
}
