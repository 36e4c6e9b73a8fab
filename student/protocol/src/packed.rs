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
        if list.len() > 10_000_000 {
            return Err(A::Error::custom(
                "a list has more than ten million elements",
            ));
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
