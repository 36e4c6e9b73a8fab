//! Divides a class into shards: parts that are each graded on a different machine.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// One of the `of` parts that a class is divided into. `part` is its number, counting from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    part: usize,
    of: usize,
}

impl Shard {
    /// The whole class.
    pub const ALL: Shard = Shard { part: 1, of: 1 };

    /// Selects the elements of this part. It takes every `of`th element, so that all parts have
    /// about the same size.
    pub fn select<T>(self, all: Vec<T>) -> Vec<T> {
        let own =
            |(index, element): (usize, T)| (index % self.of == self.part - 1).then_some(element);
        all.into_iter().enumerate().filter_map(own).collect()
    }

    /// Returns the parts of the class that aren't among `these`.
    pub fn missing(these: &[Shard]) -> Vec<Shard> {
        let of = these.iter().map(|shard| shard.of).max().unwrap_or(0);
        let parts = (1..=of).map(|part| Shard { part, of });
        parts.filter(|part| !these.contains(part)).collect()
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.part, self.of)
    }
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const EXPECTED: &str = "expected K/N with K from 1 to N, such as 2/8";
        let (part, of) = text.split_once('/').ok_or(EXPECTED)?;
        let number = |text: &str| text.parse::<usize>().map_err(|_| EXPECTED);
        let (part, of) = (number(part)?, number(of)?);
        if (1..=of).contains(&part) {
            Ok(Shard { part, of })
        } else {
            Err(EXPECTED)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_partition_the_class() {
        let all: Vec<usize> = (0..11).collect();
        let shards = ["1/3", "2/3", "3/3"].map(|text| text.parse::<Shard>().unwrap());
        let mut joined: Vec<usize> = shards.iter().flat_map(|s| s.select(all.clone())).collect();
        joined.sort_unstable();
        assert_eq!(joined, all);
        let missing = |these: &[Shard]| -> Vec<String> {
            let missing = Shard::missing(these).into_iter();
            missing.map(|shard| shard.to_string()).collect()
        };
        assert_eq!(missing(&[shards[2], shards[0]]), ["2/3"]);
        let half = "1/2".parse().unwrap();
        assert_eq!(missing(&[half, shards[0], shards[2]]), ["2/3"]);
        assert!(Shard::missing(&shards).is_empty());
        assert!(Shard::missing(&[]).is_empty());
        for bad in ["0/3", "4/3", "1/0", "1", "a/b", "-1/3"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }
}
