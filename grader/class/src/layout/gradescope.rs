//! Gradescope's `submission_metadata.yml`, whose keys are Ruby symbols that start with a colon.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::records::SubmissionRecord;
use crate::entry::Person;
use crate::error::Error;

/// The name of the file that lists the people who submitted each folder.
pub const METADATA: &str = "submission_metadata.yml";

/// The metadata of one submission. Other keys, such as earlier results, are ignored.
#[derive(Debug, Deserialize)]
struct Metadata {
    #[serde(alias = ":submitters", default)]
    submitters: Vec<Submitter>,
    #[serde(alias = ":created_at", default)]
    created_at: Option<String>,
}

/// A person who submitted. Student ids may be numbers without quotes, which are read as text.
#[derive(Debug, Deserialize)]
struct Submitter {
    #[serde(alias = ":name", default)]
    name: Option<String>,
    #[serde(alias = ":sid", default)]
    sid: Option<String>,
    #[serde(alias = ":email", default)]
    email: Option<String>,
}

/// Parses the file. Returns the record of each submission, keyed by the name of its folder.
pub(super) fn read_metadata(metadata: &str) -> Result<BTreeMap<String, SubmissionRecord>, Error> {
    // The exports of large classes include all earlier results and exceed the default limits, which
    // are meant for untrusted input.
    let budget = serde_saphyr::budget! {
        max_reader_input_bytes: Some(256 << 20),
        max_events: 50_000_000,
        max_nodes: 50_000_000,
        max_total_scalar_bytes: 256 << 20,
    };
    let options = serde_saphyr::options! { budget: budget };
    let submissions: Result<BTreeMap<String, Metadata>, _> =
        serde_saphyr::from_str_with_options(metadata, options);
    let submissions = submissions.map_err(|error| {
        Error::user(format!(
            "cannot read {METADATA}: {error}; export the submissions again, or delete the file to \
             use the folder names instead"
        ))
    })?;
    let submissions = submissions.into_iter();
    let records = submissions.map(|(name, metadata)| (name, record(metadata)));
    Ok(records.collect())
}

fn record(metadata: Metadata) -> SubmissionRecord {
    let person = |submitter: Submitter| Person {
        name: submitter.name.unwrap_or_default(),
        email: submitter.email.unwrap_or_default(),
        sid: submitter.sid.unwrap_or_default(),
        ..Person::default()
    };
    SubmissionRecord {
        people: metadata.submitters.into_iter().map(person).collect(),
        time: metadata.created_at,
    }
}
