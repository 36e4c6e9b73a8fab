//! Hashes of a result's inputs. These are the only hashes in the grader and the tools around it.

/// The number of hexadecimal digits in a hash, which has 128 bits.
const DIGITS: usize = 32;

/// A hash of several parts, used as the cache key for a result that is computed from them.
#[derive(Clone, Debug, Default)]
pub struct ContentHash(blake2b_simd::State);

impl ContentHash {
    /// Adds a part. Its length is hashed too, so that adding `ab` and `c` results in a different
    /// hash from adding `a` and `bc`.
    pub fn add(&mut self, part: &[u8]) {
        self.0.update(&(part.len() as u64).to_le_bytes());
        self.0.update(part);
    }

    /// Returns this hash with another part added.
    pub fn with(mut self, part: &[u8]) -> Self {
        self.add(part);
        self
    }

    /// Returns the hash in hexadecimal.
    pub fn hex(&self) -> String {
        self.0.finalize().to_hex()[..DIGITS].to_owned()
    }
}

/// Returns the hash of a single file, as published in score files: a prefix of `b2sum`'s output.
pub fn file_hash(bytes: &[u8]) -> String {
    blake2b_simd::blake2b(bytes).to_hex()[..DIGITS].to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_do_not_run_together() {
        let hash = |parts: &[&[u8]]| {
            let all = parts
                .iter()
                .fold(ContentHash::default(), |hash, part| hash.with(part));
            all.hex()
        };
        assert_eq!(hash(&[b"ab", b"c"]).len(), DIGITS);
        assert_ne!(hash(&[b"ab", b"c"]), hash(&[b"a", b"bc"]));
        assert_ne!(hash(&[b""]), hash(&[]));
        assert_ne!(hash(&[b"ab"]), hash(&[b"cd"]));
    }

    #[test]
    fn the_hash_of_a_file_is_that_of_b2sum() {
        assert_eq!(file_hash(b"abc"), "ba80a53f981c4d0d6a2797b69f12f6e9");
    }
}
