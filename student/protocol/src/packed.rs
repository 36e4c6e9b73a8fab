//! Compact serialisation of long lists in text formats such as JSON.
//!
//! `#[serde(with = "packed")]` writes a list of more than [`MAX_PLAIN_LEN`] elements as one string:
//! the base64 form of its binary encoding. Shorter lists stay readable, and binary formats aren't
//! affected.

use std::fmt;
use std::marker::PhantomData;

use base64::Engine;
use base64::engine::general_purpose::STANDARD_NO_PAD;
use serde::de::{DeserializeOwned, Error as _, SeqAccess, Visitor};
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The maximum length of a list that is written element by element in text formats.
pub const MAX_PLAIN_LEN: usize = 32;

/// The maximum length of a list that is read.
const MAX_LEN: usize = 10_000_000;
const TOO_LONG: &str = "a list has more than ten million elements";

/// Serialises a list as described in the module documentation.
pub fn serialize<T: Serialize, S: Serializer>(list: &[T], out: S) -> Result<S::Ok, S::Error> {
    if !out.is_human_readable() || list.len() <= MAX_PLAIN_LEN {
        return list.serialize(out);
    }
    let bytes = postcard::to_stdvec(list).map_err(S::Error::custom)?;
    out.serialize_str(&STANDARD_NO_PAD.encode(bytes))
}

/// Deserialises a list of any length from either form.
pub fn deserialize<'de, T: DeserializeOwned, D: Deserializer<'de>>(
    from: D,
) -> Result<Vec<T>, D::Error> {
    if from.is_human_readable() {
        from.deserialize_any(ListOrText(PhantomData))
    } else {
        Vec::deserialize(from)
    }
}

struct ListOrText<T>(PhantomData<T>);

impl<'de, T: DeserializeOwned> Visitor<'de> for ListOrText<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a list, or a string with the base64 form of its binary encoding")
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Vec<T>, E> {
        decode(text)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Vec<T>, A::Error> {
        let mut list = Vec::new();
        while let Some(element) = seq.next_element()? {
            list.push(element);
        }
        if list.len() > MAX_LEN {
            return Err(A::Error::custom(TOO_LONG));
        }
        Ok(list)
    }
}

/// Compact serialisation of a value of any type and size: `#[serde(with = "packed::text")]`.
pub mod text {
    use super::*;

    /// Serialises a value as the base64 form of its binary encoding in text formats, and unchanged
    /// in binary formats.
    pub fn serialize<T: Serialize, S: Serializer>(value: &T, out: S) -> Result<S::Ok, S::Error> {
        if !out.is_human_readable() {
            return value.serialize(out);
        }
        let bytes = postcard::to_stdvec(value).map_err(S::Error::custom)?;
        out.serialize_str(&STANDARD_NO_PAD.encode(bytes))
    }

    /// Deserialises a value that [`serialize`] wrote.
    pub fn deserialize<'de, T: DeserializeOwned, D: Deserializer<'de>>(
        from: D,
    ) -> Result<T, D::Error> {
        if !from.is_human_readable() {
            return T::deserialize(from);
        }
        let text = String::deserialize(from)?;
        decode(&text)
    }
}

/// Compact serialisation of lists in which neighbours are often equal:
/// `#[serde(with = "packed::runs")]`.
pub mod runs {
    use super::*;

    /// Serialises a list as its runs of equal elements in text formats, and unchanged in binary
    /// formats.
    pub fn serialize<T: Serialize + PartialEq, S: Serializer>(
        list: &[T],
        out: S,
    ) -> Result<S::Ok, S::Error> {
        if !out.is_human_readable() {
            return list.serialize(out);
        }
        let runs = list.chunk_by(PartialEq::eq);
        let runs: Vec<(usize, &T)> = runs.map(|run| (run.len(), &run[0])).collect();
        super::serialize(&runs, out)
    }

    /// Deserialises a list that [`serialize`] wrote.
    pub fn deserialize<'de, T: DeserializeOwned + Clone, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Vec<T>, D::Error> {
        if !from.is_human_readable() {
            return Vec::deserialize(from);
        }
        let runs: Vec<(usize, T)> = super::deserialize(from)?;
        let count = runs
            .iter()
            .try_fold(0, |sum: usize, run| sum.checked_add(run.0));
        if count.is_none_or(|count| count > MAX_LEN) {
            return Err(D::Error::custom(TOO_LONG));
        }
        let lists = runs
            .into_iter()
            .map(|(count, element)| vec![element; count]);
        Ok(lists.collect::<Vec<_>>().concat())
    }
}

fn decode<T: DeserializeOwned, E: serde::de::Error>(text: &str) -> Result<T, E> {
    let bytes = STANDARD_NO_PAD.decode(text).map_err(E::custom)?;
    match postcard::take_from_bytes(&bytes).map_err(E::custom)? {
        (value, []) => Ok(value),
        (_, rest) => Err(E::custom(format!(
            "unexpected trailing bytes: {}",
            rest.len()
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Holder {
        #[serde(with = "super")]
        list: Vec<(u32, f32)>,
    }

    fn holder(n: usize) -> Holder {
        Holder {
            list: (0..n).map(|i| (i as u32, i as f32 / 3.0)).collect(),
        }
    }

    #[test]
    fn short_lists_stay_readable_and_long_ones_become_text() {
        assert!(serde_json::to_value(holder(2)).unwrap()["list"].is_array());
        assert!(serde_json::to_value(holder(MAX_PLAIN_LEN + 1)).unwrap()["list"].is_string());
    }

    #[test]
    fn both_forms_round_trip_exactly() {
        for n in [0, 2, MAX_PLAIN_LEN, MAX_PLAIN_LEN + 1] {
            let text = serde_json::to_string(&holder(n)).unwrap();
            assert_eq!(serde_json::from_str::<Holder>(&text).unwrap(), holder(n));
            let bytes = postcard::to_stdvec(&holder(n)).unwrap();
            assert_eq!(postcard::from_bytes::<Holder>(&bytes).unwrap(), holder(n));
        }
    }

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Picture {
        #[serde(with = "runs")]
        pixels: Vec<f32>,
    }

    #[test]
    fn runs_of_equal_elements_are_written_once() {
        let pixels = [vec![0.25; 1000], vec![0.5; 200], vec![0.25]].concat();
        let picture = Picture { pixels };
        let text = serde_json::to_string(&picture).unwrap();
        assert_eq!(text, r#"{"pixels":[[1000,0.25],[200,0.5],[1,0.25]]}"#);
        assert_eq!(serde_json::from_str::<Picture>(&text).unwrap(), picture);
        let bytes = postcard::to_stdvec(&picture).unwrap();
        assert_eq!(postcard::from_bytes::<Picture>(&bytes).unwrap(), picture);
        let error = serde_json::from_str::<Picture>(r#"{"pixels":[[20000000,0.25]]}"#);
        assert!(error.unwrap_err().to_string().starts_with(TOO_LONG));
    }

    #[test]
    fn rejects_trailing_bytes() {
        let mut bytes = postcard::to_stdvec(&vec![(1u32, 1f32)]).unwrap();
        bytes.push(0);
        let text = format!(r#"{{"list":"{}"}}"#, STANDARD_NO_PAD.encode(bytes));
        let error = serde_json::from_str::<Holder>(&text).unwrap_err();
        let message = error.to_string();
        assert!(message.contains("trailing bytes: 1"), "{message}");
    }
}
