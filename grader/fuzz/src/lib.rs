//! Everything that reads what others wrote, given any bytes at all: it must not panic, must not
//! hang, and must not take more memory than its input is worth.
//!
//! Each target is a function of bytes. `cargo test -p fuzz` runs it on the corpus, on changes to the
//! corpus and on noise, everywhere; `cargo fuzz run` (see README.md) runs it for as long as one likes.

mod answers;
mod archive;
mod diagnostics;
mod exam;
mod mesh;
mod scene;
mod score;
mod source;
mod wire;

use peak_alloc::PeakAlloc;

/// Counts what is allocated.
#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// One thing that reads what others wrote.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Also the name of its folder in `corpus/`.
    pub name: &'static str,
    read: fn(&[u8]),
    /// The most bytes of memory for each byte of input, beside [`Target::ROOM`].
    memory_per_byte: usize,
}

/// All of them.
pub const TARGETS: [Target; 9] = [
    // A miss is two bytes on the wire and 64 in memory, and a list grows by doubling.
    Target::new("wire", wire::read, 128),
    Target::new("answers", answers::read, 1024),
    // A megabyte of the same letter is a kilobyte when it is packed.
    Target::new("archive", archive::read, 2048),
    Target::new("exam", exam::read, 512),
    Target::new("scene", scene::read, 512),
    Target::new("mesh", mesh::read, 512),
    Target::new("score", score::read, 1024),
    Target::new("source", source::read, 64),
    Target::new("diagnostics", diagnostics::read, 512),
];

impl Target {
    /// What the smallest input may take: serde reserves up to 1 MiB on the word of a length, and a
    /// report is a page.
    const BASE_MEMORY: usize = 16 << 20;

    /// A target of this name, and how many bytes of memory each byte of input may take.
    pub const fn new(name: &'static str, read: fn(&[u8]), growth: usize) -> Self {
        Target {
            name,
            read,
            memory_per_byte: growth,
        }
    }

    /// The target of this name.
    pub fn find(name: &str) -> Option<Self> {
        TARGETS.into_iter().find(|target| target.name == name)
    }

    /// Reads the bytes, and panics if that takes more memory than they are worth. What other
    /// threads allocate meanwhile counts as well.
    pub fn run(&self, bytes: &[u8]) {
        let before = MEMORY.current_usage();
        MEMORY.reset_peak_usage();
        (self.read)(bytes);
        let taken = MEMORY.peak_usage().saturating_sub(before);
        let most = Self::BASE_MEMORY + self.memory_per_byte * bytes.len();
        let (name, length) = (self.name, bytes.len());
        assert!(
            taken <= most,
            "{name}: {length} bytes took {taken} bytes of memory, and at most {most} are fine"
        );
    }
}
