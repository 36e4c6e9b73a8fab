//! Runs the fuzz targets as ordinary tests: on the inputs in the corpus, on changed inputs and on
//! noise.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use fuzz::{TARGETS, Target};
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use tar::{Archive, Entry};

/// The number of random inputs per target. Roughly half are changed inputs from the corpus, and
/// half are noise. `cargo fuzz` tries millions of inputs.
const CASES: u32 = 300;
/// The maximum length of a noise input, in bytes.
const MAX_NOISE_BYTES: usize = 300;

/// Returns the target's inputs, sorted by name.
fn corpus(target: &Target) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let file = folder.join(target.name).with_extension("tar");
    let mut archive = Archive::new(File::open(file).expect("each target has a corpus"));
    let entries = archive.entries().expect("the corpus can be read");
    let input = |mut entry: Entry<File>| {
        let mut bytes = Vec::new();
        entry.read_to_end(&mut bytes).map(|_| bytes)
    };
    let inputs = entries.map(|entry| entry.and_then(input));
    inputs.collect::<Result<_, _>>().unwrap()
}

/// A small change to an input, such as a flipped bit, a missing part or an extreme number.
#[derive(Clone, Debug)]
enum Change {
    Cut(Index),
    Flip(Index, u8),
    Set(Index, u8),
    Double(Index, Index),
    Drop(Index, Index),
    Splice(Index, Vec<u8>),
}

fn change() -> impl Strategy<Value = Change> {
    let index = any::<Index>;
    let digits = prop::sample::select(vec!["-1", "99999999999999999999", "1e400", "null", "[[[["]);
    prop_oneof![
        index().prop_map(Change::Cut),
        (index(), 0..8_u8).prop_map(|(at, bit)| Change::Flip(at, 1 << bit)),
        (index(), any::<u8>()).prop_map(|(at, byte)| Change::Set(at, byte)),
        (index(), index()).prop_map(|(from, to)| Change::Double(from, to)),
        (index(), index()).prop_map(|(from, to)| Change::Drop(from, to)),
        (index(), digits).prop_map(|(at, text)| Change::Splice(at, text.into())),
    ]
}

impl Change {
    fn apply(&self, bytes: &mut Vec<u8>) {
        if bytes.is_empty() {
            return;
        }
        let length = bytes.len();
        let span = |a: &Index, b: &Index| {
            let (a, b) = (a.index(length), b.index(length));
            a.min(b)..a.max(b)
        };
        match self {
            Change::Cut(at) => bytes.truncate(at.index(length)),
            Change::Flip(at, bit) => bytes[at.index(length)] ^= bit,
            Change::Set(at, byte) => bytes[at.index(length)] = *byte,
            Change::Double(a, b) => bytes.extend_from_within(span(a, b)),
            Change::Drop(a, b) => drop(bytes.drain(span(a, b))),
            Change::Splice(at, text) => {
                let at = at.index(length);
                bytes.splice(at..at, text.iter().copied());
            }
        }
    }
}

/// Returns a test runner with a fixed seed, so that tests are reproducible.
fn runner() -> TestRunner {
    let config = Config {
        cases: CASES,
        failure_persistence: None,
        ..Config::default()
    };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

fn survives_anything(target: Target) {
    println!("{target:?}");
    let corpus = corpus(&target);
    corpus.iter().for_each(|bytes| target.run(bytes));

    let changed = (
        prop::sample::select(corpus),
        prop::collection::vec(change(), 1..4),
    );
    let changed = changed.prop_map(|(mut bytes, changes)| {
        changes.iter().for_each(|change| change.apply(&mut bytes));
        bytes
    });
    let noise = prop::collection::vec(any::<u8>(), 0..MAX_NOISE_BYTES);
    let survived = runner().run(&prop_oneof![changed, noise], |bytes| {
        target.run(&bytes);
        Ok(())
    });
    survived.unwrap();
}

/// Runs all targets in one test, because memory is counted for the whole process.
#[test]
fn no_target_panics_or_uses_too_much_memory_whatever_the_bytes_are() {
    TARGETS.into_iter().for_each(survives_anything);

    let wasteful = Target::new("wasteful", |_| drop(vec![1_u8; 64 << 20]), 1);
    let panic = std::panic::catch_unwind(|| wasteful.run(b"few")).unwrap_err();
    let message = panic.downcast_ref::<String>().expect("a message");
    assert!(message.contains("3 bytes of input used"), "{message}");
}
