//! Values in the JSON text of a scene. They store their positions, so that errors can point at
//! them. The parser itself only reports how far it has read, which is often the closing brace.

use glam::Vec3;
use serde::de::{DeserializeOwned, IgnoredAny};

use super::error::{SceneError, TextPosition};
use crate::suggestion::suggestion;

/// The largest coordinate, radius or scale. In the formulas for triangles and spheres, the fourth
/// power of a larger number overflows, so correct code would seem wrong.
pub(super) const MAX_COORDINATE: f32 = 1e9;

/// A value or a key in JSON text.
#[derive(Clone, Debug)]
pub(super) struct Value<'a> {
    /// The whole text, which is valid JSON.
    text: &'a str,
    /// The offset of the value.
    start: usize,
    /// The key of the value, or of the list that contains it.
    pub(super) key: String,
}

/// An object whose keys are known.
pub(super) struct Object<'a> {
    value: Value<'a>,
    members: Vec<Value<'a>>,
}

impl<'a> Value<'a> {
    /// Parses JSON text.
    pub(super) fn parse(text: &'a str) -> Result<Self, SceneError> {
        // This also finds numbers that are too large and lists that are nested too deeply.
        serde_json::from_str::<serde_json::Value>(text).map_err(|error| {
            let position = TextPosition::new(text, error.line(), error.column());
            SceneError::new(Some(position), syntax_message(&error))
        })?;
        Ok(Value {
            text,
            start: skip_space(text, 0),
            key: String::new(),
        })
    }

    /// Creates an error that points at this value.
    pub(super) fn error(&self, message: impl Into<String>) -> SceneError {
        let position = TextPosition::at_offset(self.text, self.start);
        SceneError::new(Some(position), message)
    }

    /// Creates an error about a value of an unexpected type or size.
    fn unexpected(&self, expected: &str) -> SceneError {
        let end = self.read::<IgnoredAny>().map_or(self.start, |(_, end)| end);
        let got = match &self.text[self.start..end] {
            text if text.starts_with('"') => format!("the string {text}"),
            text if text.starts_with('{') => "an object".to_owned(),
            text if text.len() > 60 || text.contains('\n') => "a list".to_owned(),
            text => text.to_owned(),
        };
        self.error(format!("`{}`: expected {expected}, got {got}", self.key))
    }

    /// Creates an error about this name, which isn't one of the known names.
    pub(super) fn unknown(
        &self,
        problem: &str,
        name: &str,
        (list, known): (&str, &[impl AsRef<str>]),
    ) -> SceneError {
        let suggestion = suggestion(name, known);
        let known: Vec<&str> = known.iter().map(AsRef::as_ref).collect();
        let known = known.join(", ");
        self.error(format!("{problem} `{name}`{suggestion}; {list}: {known}"))
    }

    /// Returns the members of an object as keys and values. The keys must all be different.
    pub(super) fn members(&self) -> Result<Vec<(Value<'a>, Value<'a>)>, SceneError> {
        let mut members: Vec<(Value, Value)> = Vec::new();
        let items = self.items('{');
        let items = items.ok_or_else(|| self.unexpected("an object in { }"))?;
        for [mut key, mut value] in items.as_chunks::<2>().0.iter().cloned() {
            value.key = key.string()?;
            if members.iter().any(|(_, other)| other.key == value.key) {
                return Err(key.error(format!("the key `{}` occurs twice", value.key)));
            }
            key.key.clone_from(&value.key);
            members.push((key, value));
        }
        Ok(members)
    }

    /// Returns the object, which must not have unknown keys.
    pub(super) fn object(&self, known: &[&str]) -> Result<Object<'a>, SceneError> {
        let members = self.members()?;
        let is_unknown = |(key, _): &&(Value, Value)| !known.contains(&key.key.as_str());
        if let Some((key, _)) = members.iter().find(is_unknown) {
            return Err(key.unknown("unknown key", &key.key, ("the keys here are", known)));
        }
        Ok(Object {
            value: self.clone(),
            members: members.into_iter().map(|(_, value)| value).collect(),
        })
    }

    /// Returns the only member of an object. The member's key is the object's kind. Scene files use
    /// this form rather than a `type` key, so that the known keys follow from the kind.
    pub(super) fn kind(&self) -> Result<(Value<'a>, Value<'a>), SceneError> {
        let expected = || self.unexpected("an object in { } whose only key is its kind");
        match <[_; 1]>::try_from(self.members().map_err(|_| expected())?) {
            Ok([member]) => Ok(member),
            Err(_) => Err(expected()),
        }
    }

    /// Returns the elements of a list.
    pub(super) fn list<T>(
        &self,
        read: impl FnMut(&Value<'a>) -> Result<T, SceneError>,
    ) -> Result<Vec<T>, SceneError> {
        let items = self.items('[');
        let items = items.ok_or_else(|| self.unexpected("a list in [ ]"))?;
        items.iter().map(read).collect()
    }

    /// Returns a string.
    pub(super) fn string(&self) -> Result<String, SceneError> {
        let string = self.read().map(|(string, _)| string);
        string.ok_or_else(|| self.unexpected("a string in quotes"))
    }

    /// Returns the value as a Rust type, if it is valid.
    pub(super) fn parsed<T: DeserializeOwned>(
        &self,
        expected: &str,
        is_valid: impl Fn(&T) -> bool,
    ) -> Result<T, SceneError> {
        let value = self.read().map(|(value, _)| value).filter(is_valid);
        value.ok_or_else(|| self.unexpected(expected))
    }

    /// Returns a valid number.
    pub(super) fn number(
        &self,
        expected: &str,
        is_valid: impl Fn(f32) -> bool,
    ) -> Result<f32, SceneError> {
        // A number that fits into an f64 can become infinite as an f32.
        let number = self.read().map(|(number, _): (f64, _)| number as f32);
        let number = number.filter(|&x| x.is_finite() && is_valid(x));
        number.ok_or_else(|| self.unexpected(expected))
    }

    /// Returns a list of `N` valid numbers.
    pub(super) fn numbers<const N: usize>(
        &self,
        expected: &str,
        is_valid: impl Fn(f32) -> bool,
    ) -> Result<[f32; N], SceneError> {
        let numbers = self.list(|element| element.number("", &is_valid));
        let numbers = numbers.ok().and_then(|numbers| numbers.try_into().ok());
        numbers.ok_or_else(|| self.unexpected(expected))
    }

    /// Returns a positive number, such as a radius, a scale or an index of refraction.
    pub(super) fn positive(&self) -> Result<f32, SceneError> {
        self.number("a number greater than 0 and at most 1e9", |x| {
            x > 0.0 && x <= MAX_COORDINATE
        })
    }

    /// Returns a point or a direction.
    pub(super) fn point(&self) -> Result<Vec3, SceneError> {
        let is_valid = |x: f32| x.abs() <= MAX_COORDINATE;
        let numbers = self.numbers("three numbers from -1e9 to 1e9", is_valid);
        numbers.map(Vec3::from_array)
    }

    /// Returns an RGB reflectance: the fraction of the light that a surface reflects.
    pub(super) fn reflectance(&self) -> Result<Vec3, SceneError> {
        let is_valid = |x| (0.0..=1.0).contains(&x);
        let numbers = self.numbers("red, green and blue, each from 0 to 1", is_valid);
        numbers.map(Vec3::from_array)
    }

    /// Returns an RGB radiance.
    pub(super) fn radiance(&self) -> Result<Vec3, SceneError> {
        let numbers = self.numbers("red, green and blue, each 0 or more", |x| x >= 0.0);
        numbers.map(Vec3::from_array)
    }

    /// Returns the elements of a list, or the keys and values of an object, in sequence. Returns
    /// `None` if the value doesn't begin with the bracket `open`.
    fn items(&self, open: char) -> Option<Vec<Value<'a>>> {
        let mut rest = self.text[self.start..].strip_prefix(open)?;
        let mut items = Vec::new();
        loop {
            let item = Value {
                start: skip_space(self.text, self.text.len() - rest.len()),
                ..self.clone()
            };
            // After the last item, or in an empty list, there is only the closing bracket.
            let Some((_, end)) = item.read::<IgnoredAny>() else {
                return Some(items);
            };
            items.push(item);
            rest = &self.text[skip_space(self.text, end)..];
            match rest.strip_prefix([',', ':']) {
                Some(next) => rest = next,
                None => return Some(items),
            }
        }
    }

    /// Reads the value as a Rust type and returns it with the offset of its end.
    fn read<T: DeserializeOwned>(&self) -> Option<(T, usize)> {
        let parser = serde_json::Deserializer::from_str(&self.text[self.start..]);
        let mut values = parser.into_iter::<T>();
        let value = values.next()?.ok()?;
        Some((value, self.start + values.byte_offset()))
    }
}

impl<'a> Object<'a> {
    /// Reads the value of a key, if the object has it.
    pub(super) fn optional<T>(
        &self,
        key: &str,
        read: impl FnOnce(&Value<'a>) -> Result<T, SceneError>,
    ) -> Result<Option<T>, SceneError> {
        let member = self.members.iter().find(|member| member.key == key);
        member.map(read).transpose()
    }

    /// Reads the value of a key that the object must have.
    pub(super) fn required<T>(
        &self,
        key: &str,
        read: impl FnOnce(&Value<'a>) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        let value = self.optional(key, read)?;
        value.ok_or_else(|| self.value.error(format!("missing key `{key}`")))
    }

    /// Returns the value of a key that the object must have.
    pub(super) fn value(&self, key: &str) -> Result<Value<'a>, SceneError> {
        self.required(key, |value| Ok(value.clone()))
    }
}

/// Returns the offset of the first character that isn't white space.
fn skip_space(text: &str, start: usize) -> usize {
    text.len() - text[start..].trim_start().len()
}

/// Returns the message about invalid JSON, including how to fix it.
fn syntax_message(error: &serde_json::Error) -> String {
    let message = error.to_string();
    let (message, _) = message.rsplit_once(" at line ").unwrap_or((&message, ""));
    let text = match message {
        "EOF while parsing a list" => "the file ends inside a list: a `]` is missing",
        "EOF while parsing an object" => "the file ends inside an object: a `}` is missing",
        "EOF while parsing a string" => "the file ends inside a string: a quote is missing",
        "EOF while parsing a value" => "the file ends where a value is expected",
        "expected value" => {
            "expected a value: a number, a string in quotes, a list in [ ] or an object in { }"
        }
        "expected ident" => "expected a value; write `true`, `false` and `null` in full",
        "key must be a string" => "expected a key in quotes",
        "trailing comma" => "remove the comma before this closing bracket",
        "trailing characters" => "the scene ends before this point: remove the rest",
        "number out of range" => "the number is too large",
        "recursion limit exceeded" => "the lists and objects are nested too deeply",
        _ if message.starts_with("control character") => "the string has no closing quote",
        other => other,
    };
    text.to_owned()
}
