//! Suggestions for misspelt names.

/// Returns the known name that is nearest to a misspelt name. Returns `None` if even the nearest
/// name differs by more than one edit per three characters (rounded up), which is too many for a
/// typo.
pub fn nearest_name<'a>(
    misspelt: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let misspelt = misspelt.to_lowercase();
    let distance = |name: &&str| strsim::osa_distance(&misspelt, &name.to_lowercase());
    let nearest = known.into_iter().min_by_key(distance)?;
    let max_edits = nearest.chars().count().div_ceil(3);
    (distance(&nearest) <= max_edits).then_some(nearest)
}

/// Returns a question to append to a message about a misspelt name, such as ` (did you mean
/// sphere?)`, or nothing.
pub fn suggestion<'a>(misspelt: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    match nearest_name(misspelt, known) {
        Some(name) => format!(" (did you mean {name}?)"),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_nearest_name_if_it_is_near() {
        let known = ["camera", "triangle", "sphere", "bbox", "build", "traverse"];
        for (misspelt, nearest) in [
            ("sphre", Some("sphere")),
            ("Trinagle", Some("triangle")),
            ("travers", Some("traverse")),
            ("bxo", Some("bbox")),
            ("light", None),
            ("", None),
        ] {
            assert_eq!(nearest_name(misspelt, known), nearest, "{misspelt}");
        }
    }
}
