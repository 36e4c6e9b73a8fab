//! Systematic mistakes: families of wrong solutions that a generator makes from the reference. They
//! stand between the catalogue, which lists what people do, and the mutants of cargo-mutants, which
//! replaces operators and bodies: each comparison gets an absolute epsilon, each number, name,
//! operand and initial value is another one, each property of an answer and each early return is
//! dropped, and each method keeps a state between its calls.

mod changes;
mod code;
mod state;
mod syntax;

use std::collections::BTreeMap;

use grader::handed_out::HandedOut;

use crate::solutions::sources::Sources;

/// Returns all systematic mistakes, sorted by name. A name consists of the file, the family, the
/// change and the function; changes that are alike are numbered.
pub fn systematic_mistakes(handed_out: &HandedOut, reference: &Sources) -> Vec<(String, Sources)> {
    let mut found = BTreeMap::new();
    for file in handed_out.files {
        let text = reference.text(file.name).unwrap_or_default();
        let parts = code::parts(text);
        let all = parts.iter().flat_map(|code| {
            let mut all = changes::changes(code);
            all.extend(state::changes(code));
            all
        });
        let mut numbers: BTreeMap<String, u32> = BTreeMap::new();
        for change in all {
            let name = format!(
                "{}: {}, in {}",
                file.name,
                one_line(&change.what),
                change.function
            );
            let number = numbers.entry(name.clone()).or_default();
            *number += 1;
            let name = match number {
                1 => name,
                number => format!("{name}, again {number}"),
            };
            let (before, after) = (&text[..change.bytes.start], &text[change.bytes.end..]);
            let text = format!("{before}{}{after}", change.now);
            found.insert(name, reference.clone().with_file(file.name, text));
        }
    }
    found.into_iter().collect()
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use grader::handed_out::RAYS;

    use super::*;

    #[test]
    fn every_family_changes_every_file_and_nothing_else() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let reference = Sources::reference(&root, &RAYS).expect("the reference can be read");
        let all = systematic_mistakes(&RAYS, &reference);
        assert!(all.len() > 500, "only {} mistakes", all.len());
        for family in [
            "epsilon",
            "number",
            "initial value",
            "name",
            "operands",
            "dropped",
            "condition",
            "state",
        ] {
            let family = format!(": {family}: ");
            assert!(
                all.iter().any(|(name, _)| name.contains(&family)),
                "{family}"
            );
        }
        for (name, sources) in &all {
            let changed = RAYS.files.iter();
            let changed =
                changed.filter(|file| sources.text(file.name) != reference.text(file.name));
            let changed: Vec<&str> = changed.map(|file| file.name).collect();
            assert_eq!(
                changed,
                [name.split(':').next().unwrap_or_default()],
                "{name}"
            );
        }
    }
}
