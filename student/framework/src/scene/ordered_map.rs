//! Things by name, in the order of the file.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// Things by name, in the order of the file. A name that comes twice is an error: a map would
/// silently keep the last.
#[derive(Debug)]
pub(super) struct OrderedMap<T>(pub(super) Vec<(String, T)>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OrderedMap<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_map(OrderedMapVisitor(PhantomData))
    }
}

struct OrderedMapVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for OrderedMapVisitor<T> {
    type Value = OrderedMap<T>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("names with their meaning, such as { \"white\": { ... } }")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut things: Vec<(String, T)> = Vec::new();
        while let Some(name) = map.next_key::<String>()? {
            if things.iter().any(|(taken, _)| *taken == name) {
                return Err(A::Error::custom(format!("the name `{name}` comes twice")));
            }
            things.push((name, map.next_value()?));
        }
        Ok(OrderedMap(things))
    }
}
