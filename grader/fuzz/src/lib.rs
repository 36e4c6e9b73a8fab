//! Fuzz targets for all parsers of untrusted input. No input may make a parser panic, hang, or use
//! memory out of proportion to the input's size.
//!
//! Each target is a function that takes bytes. `cargo test -p fuzz` runs it on the corpus, on
//! changed copies of the corpus and on noise. This works on any machine. `cargo fuzz run` (see
//! README.md) runs it for as long as needed.

mod answers;
mod exam;
mod scene;
mod score;
mod submission;
mod wire;

use peak_alloc::PeakAlloc;

/// The global allocator, which counts the allocated bytes.
#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// A fuzz target: a parser of untrusted input.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The target's name, which is also the name of its archive in `corpus/`.
    pub name: &'static str,
    read: fn(&[u8]),
    /// The maximum number of bytes of memory per byte of input, in addition to
    /// [`Target::BASE_MEMORY`].
    memory_per_byte: usize,
}

/// All fuzz targets.
pub const TARGETS: [Target; 9] = [
    // A miss takes two bytes on the wire and 64 in memory, and a list grows by doubling.
    Target::new("wire", wire::read, 128),
    Target::new("answers", answers::read, 1024),
    // A megabyte of the same letter compresses to a kilobyte.
    Target::new("archive", submission::read_archive, 2048),
    Target::new("exam", exam::read, 512),
    Target::new("scene", scene::read_scene, 512),
    Target::new("mesh", scene::read_mesh, 512),
    Target::new("score", score::read, 1024),
    Target::new("source", submission::read_source, 64),
    Target::new("diagnostics", submission::read_diagnostics, 512),
];

impl Target {
    /// The memory that even the smallest input may use, in bytes: serde reserves up to 1 MiB for a
    /// declared length, and a report is a whole page.
    const BASE_MEMORY: usize = 16 << 20;

    /// Creates a target that may use `memory_per_byte` bytes of memory per byte of input.
    pub const fn new(name: &'static str, read: fn(&[u8]), memory_per_byte: usize) -> Self {
        Target {
            name,
            read,
            memory_per_byte,
        }
    }

    /// Returns the target with this name.
    pub fn find(name: &str) -> Option<Self> {
        TARGETS.into_iter().find(|target| target.name == name)
    }

    /// Runs the target on these bytes. Panics if it uses too much memory. Allocations made by other
    /// threads in the meantime are also counted.
    pub fn run(&self, bytes: &[u8]) {
        let before = MEMORY.current_usage();
        MEMORY.reset_peak_usage();
        (self.read)(bytes);
        let used = MEMORY.peak_usage().saturating_sub(before);
        let most = Self::BASE_MEMORY + self.memory_per_byte * bytes.len();
        let (name, length) = (self.name, bytes.len());
        assert!(
            used <= most,
            "{name}: {length} bytes of input used {used} bytes of memory; the limit is {most}"
        );
    }
}
