//! A submission that answers an exam by heart: a table from the exam's questions to their keys, and
//! no other code. It shows that knowing the practice exam earns nothing in a final exam.
//!
//! A path-traced picture cannot be answered by heart, because no method of a submission returns a
//! pixel.

mod question_hash;
mod stubs;
mod tables;

use std::collections::BTreeMap;

use grader::handed_out::HandedOut;
use judging::exam::Exam;

use crate::solutions::sources::Sources;
use crate::solutions::workbench::{BuiltSolution, WorkbenchError};

use stubs::{BOX_NUMBERS, STUBS};

/// The reason why there is no submission that answers an exam by heart.
#[derive(Debug, thiserror::Error)]
pub enum ByHeartError {
    /// The trees cannot be built.
    #[error(transparent)]
    Workbench(#[from] WorkbenchError),
    /// The starter has changed.
    #[error(
        "{file} of the starter does not contain this once: {was}; adapt \
         reference/author/src/solutions/by_heart/stubs.rs"
    )]
    Stub {
        /// The name of the task file.
        file: &'static str,
        /// The text in the stub.
        was: &'static str,
    },
}

/// Returns the submission that answers this exam by heart. Its trees are those that `builder`
/// builds.
pub fn by_heart(
    exam: &Exam,
    builder: &BuiltSolution,
    handed_out: &'static HandedOut,
) -> Result<Sources, ByHeartError> {
    let mut sources = Sources::starter(handed_out);
    for stub in STUBS {
        let text = sources.text(stub.file).unwrap_or_default();
        if text.matches(stub.was).count() != 1 {
            let (file, was) = (stub.file, stub.was);
            return Err(ByHeartError::Stub { file, was });
        }
        let text = text.replacen(stub.was, stub.now, 1);
        sources = sources.with_file(stub.file, text);
    }
    for (file, table) in tables::tables(exam, builder)? {
        let mut text = sources.text(file).unwrap_or_default().to_owned();
        text += "\n// An answer's hash, its length, and its words.\n";
        text += &format!("static TABLE: &str = \"{}\";\n\n", encode(&table));
        for part in parts(file) {
            text += part;
            text += "\n";
        }
        sources = sources.with_file(file, text);
    }
    Ok(sources)
}

/// Returns the functions that the code of a task file calls.
fn parts(file: &str) -> &'static [&'static str] {
    const LOOKUP: &str = include_str!("lookup.rs");
    const HASH: &str = include_str!("question_hash.rs");
    const DESCRIBE: &str = include_str!("describe.rs");
    const TRACE: &str = include_str!("trace.rs");
    match file {
        "camera.rs" => &[LOOKUP, HASH],
        "bbox.rs" => &[LOOKUP, HASH, DESCRIBE],
        "bvh.rs" => &[LOOKUP, HASH, DESCRIBE, TRACE, BOX_NUMBERS],
        _ => &[LOOKUP, HASH, DESCRIBE, TRACE],
    }
}

/// A table from the hash of a question to the words of its answer.
type Table = BTreeMap<u64, Vec<u32>>;

/// Returns the text that `lookup.rs` decodes.
fn encode(table: &Table) -> String {
    const DIGITS: &[u8; 64] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_";
    let words = table.iter().flat_map(|(hash, answer)| {
        let head = [*hash as u32, (hash >> 32) as u32, answer.len() as u32];
        head.into_iter().chain(answer.iter().copied())
    });
    let digit = |word: u32, shift: u32| char::from(DIGITS[(word >> shift & 63) as usize]);
    words
        .flat_map(|word| [30, 24, 18, 12, 6, 0].map(|shift| digit(word, shift)))
        .collect()
}
