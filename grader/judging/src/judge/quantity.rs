//! The quantities compared in each row, each with its own tolerance: fields and the lengths of
//! directions.

use protocol::{Record, Value};

use super::{Deviation, FailureKind, Threshold};
use crate::types::{self, FieldType, UnitLength};

/// The prefix of a quantity's name if the quantity is the length of a direction.
const UNIT: &str = "unit_";

/// A quantity in the rows of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Quantity {
    name: &'static str,
    /// The index of the field.
    field: usize,
    /// Whether the field is a direction and only its length is compared.
    is_unit_length: bool,
}

impl Quantity {
    /// Returns the quantity with this name, or `None` if none of the fields in `names` provides it.
    pub(crate) fn named(quantity: &str, names: &'static [&'static str]) -> Option<Self> {
        let direction = quantity.strip_prefix(UNIT);
        let field = names
            .iter()
            .position(|name| *name == direction.unwrap_or(quantity))?;
        Some(Quantity {
            name: names[field],
            field,
            is_unit_length: direction.is_some(),
        })
    }

    /// Returns the first of these fields that is a length.
    pub(crate) fn first_length(record: &dyn Record) -> Option<Self> {
        let mut values = record.values();
        let field = values.position(|value| matches!(value, Value::Length(_)))?;
        Some(Quantity {
            name: record.names()[field],
            field,
            is_unit_length: false,
        })
    }

    /// Calls `with` with the value of the quantity in a record.
    fn with<T>(self, record: &dyn Record, with: impl FnOnce(&dyn FieldType) -> T) -> T {
        let value = record.value(self.field);
        if let Value::Direction(direction) = value
            && self.is_unit_length
        {
            return with(&UnitLength(direction));
        }
        with(&*types::of(&value))
    }

    /// Returns the quantity's deviation from its expected value.
    pub(super) fn deviation(self, got: &dyn Record, wanted: &dyn Record, scale: f32) -> Deviation {
        let wanted = wanted.value(self.field);
        self.with(got, |value| Deviation {
            threshold: value.tolerance().map(|tolerance| {
                if self.is_unit_length {
                    Threshold::UnitLength
                } else {
                    Threshold::Field(self.name, tolerance)
                }
            }),
            value: value.error(&wanted, scale),
        })
    }

    /// Returns the failure to report if the quantity is wrong.
    pub(super) fn failure(self, got: &dyn Record, wanted: &dyn Record) -> FailureKind {
        FailureKind::Wrong {
            what: self.label(),
            side: self.with(got, |value| value.side(&wanted.value(self.field))),
            got: self.with(got, |value| value.text()),
            wanted: self.with(wanted, |value| value.text()),
        }
    }

    /// Returns the name of the quantity and its value in a record.
    pub(crate) fn text(self, record: &dyn Record) -> (String, String) {
        (self.label(), self.with(record, |value| value.text()))
    }

    fn label(self) -> String {
        if self.is_unit_length {
            format!("length of the {}", self.name)
        } else {
            self.name.to_owned()
        }
    }

    /// Returns the numbers in the quantity as multiples of its tolerance.
    pub(crate) fn in_tolerances(self, record: &dyn Record, scale: f32) -> Vec<f32> {
        self.with(record, |value| value.in_tolerances(scale))
    }
}
