//! Gradescope's "Export submissions": a folder for each submission, and `submission_metadata.yml`,
//! whose keys are Ruby symbols, with a colon in front.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::{LayoutContents, unmatched_path};
use crate::entry::{Entry, Person, Source};
use crate::error::Error;
use crate::listing::Node;

/// The name of the file that lists the people who submitted each folder.
pub const METADATA: &str = "submission_metadata.yml";

/// The metadata of one submission. Other keys, such as earlier results, are ignored.
#[derive(Debug, Deserialize)]
struct Metadata {
    #[serde(alias = ":submitters", default)]
    submitters: Vec<Submitter>,
    #[serde(alias = ":created_at", default)]
    created_at: Option<Scalar>,
}

#[derive(Debug, Deserialize)]
struct Submitter {
    #[serde(alias = ":name", default)]
    name: Option<Scalar>,
    #[serde(alias = ":sid", default)]
    sid: Option<Scalar>,
    #[serde(alias = ":email", default)]
    email: Option<Scalar>,
}

/// A YAML value that is read as text. Student ids may be numbers without quotes.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Scalar {
    Text(String),
    Number(u64),
    Other(IgnoredAny),
}

pub(super) fn read(root: &Node, metadata: &str) -> Result<LayoutContents, Error> {
    let mut known = parse(metadata)?;
    let (mut entries, mut others) = (Vec::new(), Vec::new());
    for node in root.children() {
        match known.remove(&node.name) {
            Some(metadata) => {
                let source = Source::Path(node.path.clone());
                entries.push(entry(&node.name, metadata, source));
            }
            None if node.name == METADATA => {}
            None => others.push(unmatched_path(node, "it is not in submission_metadata.yml")),
        }
    }
    for (name, metadata) in known {
        let source = Source::Missing("its folder is not in the export".to_owned());
        entries.push(entry(&name, metadata, source));
    }
    Ok((entries, others))
}

fn parse(metadata: &str) -> Result<BTreeMap<String, Metadata>, Error> {
    // The exports of large classes include all earlier results, and exceed the default limits,
    // which are meant for untrusted input.
    let budget = serde_saphyr::budget! {
        max_reader_input_bytes: Some(256 << 20),
        max_events: 50_000_000,
        max_nodes: 50_000_000,
        max_total_scalar_bytes: 256 << 20,
    };
    let options = serde_saphyr::options! { budget: budget };
    serde_saphyr::from_str_with_options(metadata, options).map_err(|error| {
        Error::user(format!(
            "cannot read {METADATA}: {error}; export the submissions again, or delete the file to go \
             by folder names"
        ))
    })
}

fn entry(name: &str, metadata: Metadata, source: Source) -> Entry {
    let text = |scalar: Option<Scalar>| scalar.and_then(Scalar::text).unwrap_or_default();
    let person = |submitter: Submitter| Person {
        name: text(submitter.name),
        email: text(submitter.email),
        sid: text(submitter.sid),
        ..Person::default()
    };
    let people: Vec<Person> = metadata.submitters.into_iter().map(person).collect();
    let mut entry = Entry::new(name, Person::named_by_file(name), name, source);
    if !people.is_empty() {
        entry.info.people = people;
    }
    entry.info.submitted = metadata.created_at.and_then(Scalar::text);
    entry
}

impl Scalar {
    fn text(self) -> Option<String> {
        match self {
            Scalar::Text(text) => Some(text),
            Scalar::Number(number) => Some(number.to_string()),
            Scalar::Other(_) => None,
        }
    }
}
