//! Suggestions for misspelt names.

/// The minimum similarity of a suggested name: 1 means equal, 0 means nothing in common.
const MIN_SIMILARITY: f64 = 0.6;

/// Returns a question to append to a message about an unknown name, such as ` (did you mean red?)`,
/// or nothing if no known name is similar.
pub(crate) fn suggestion(name: &str, known: &[impl AsRef<str>]) -> String {
    let rated = known.iter().map(|known| {
        let known = known.as_ref();
        (similarity(&name.to_lowercase(), known), known)
    });
    let best = rated.max_by(|(a, _), (b, _)| a.total_cmp(b));
    match best {
        Some((similarity, known)) if similarity >= MIN_SIMILARITY => {
            format!(" (did you mean {known}?)")
        }
        Some(_) | None => String::new(),
    }
}

/// Returns the share of letters that are unchanged. A prefix of a name scores as high as the full
/// name.
fn similarity(name: &str, known: &str) -> f64 {
    if !name.is_empty() && known.starts_with(name) {
        return 1.0;
    }
    strsim::normalized_damerau_levenshtein(name, known)
}

#[cfg(test)]
mod tests {
    use super::suggestion;

    #[test]
    fn suggests_the_most_similar_name_if_one_is_similar() {
        assert_eq!(suggestion("rde", &["red", "green"]), " (did you mean red?)");
        let known = ["cornell-box", "checkered-teapot", "spheres"];
        assert_eq!(suggestion("cornel", &known), " (did you mean cornell-box?)");
        assert_eq!(suggestion("Sphres", &known), " (did you mean spheres?)");
        assert_eq!(suggestion("bunny", &known), "");
        assert_eq!(suggestion("bunny", &[""; 0]), "");
    }
}
