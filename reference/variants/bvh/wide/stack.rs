// The stack of the traversal.

/// A child to visit and the distance at which the ray enters its box.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct StackEntry(u64);

impl StackEntry {
    /// Creates an entry with the entry distance in the bits above the child. The bit patterns of
    /// non-negative floats have the same order as the floats, so the nearest of several entries is
    /// the smallest integer.
    fn new(entry: f32, child: u32) -> Self {
        StackEntry(u64::from(entry.to_bits()) << 32 | u64::from(child))
    }

    fn entry(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    fn child(self) -> u32 {
        self.0 as u32
    }
}

/// The children to visit. The nearest comes last.
struct Stack {
    entries: [StackEntry; Stack::SIZE],
    len: usize,
    /// Older entries, moved here when the array was almost full. Few trees are deep enough to need
    /// it.
    overflow: Vec<StackEntry>,
}

impl Stack {
    /// The size of the array: a power of two, so that `%` becomes a mask and the index doesn't need
    /// a bounds check.
    const SIZE: usize = 32;

    fn new() -> Self {
        Stack {
            entries: [StackEntry(0); Stack::SIZE],
            len: 0,
            overflow: Vec::new(),
        }
    }

    /// Makes room for one more node's children. Returns the index of the first child.
    fn reserve_eight(&mut self) -> usize {
        if self.len > Stack::SIZE - 8 {
            self.overflow.extend_from_slice(&self.entries[..self.len]);
            self.len = 0;
        }
        self.len
    }

    /// Inserts an entry into the sorted entries that begin at `base`.
    fn insert(&mut self, base: usize, entry: StackEntry) {
        let mut index = self.len;
        while index > base && self.entries[(index - 1) % Stack::SIZE] < entry {
            self.entries[index % Stack::SIZE] = self.entries[(index - 1) % Stack::SIZE];
            index -= 1;
        }
        self.entries[index % Stack::SIZE] = entry;
        self.len += 1;
    }

    fn pop(&mut self) -> Option<StackEntry> {
        match self.len.checked_sub(1) {
            Some(len) => {
                self.len = len;
                Some(self.entries[len % Stack::SIZE])
            }
            None => self.overflow.pop(),
        }
    }
}
