//! The results of part two's functions. Functions with results of the same kind share a type.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::answer::{Answer, ElementOutcome};
use crate::function::{Output, ResultText};
use crate::value::{Fields, fields};

/// A direction at a point on a surface, in a frame whose +z is the normal, or a direction in the
/// world where there is no surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LocalDirection {
    /// The direction, as a unit vector.
    pub direction: Vec3,
}

/// A value for each of the colour channels red, green and blue, such as a radiance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Color {
    /// The value of each channel.
    pub value: Vec3,
}

/// A probability density of directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Density {
    /// The density, per solid angle.
    pub pdf: f32,
}

/// A fraction of the light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Fraction {
    /// The fraction, from 0 to 1.
    pub fraction: f32,
}

/// How a material continues a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scattered {
    /// The direction of the rest of the path, in the surface's frame.
    pub direction: Vec3,
    /// The factor, for each colour channel, that is applied to the light from this direction.
    pub attenuation: Vec3,
    /// The probability density of the direction, per solid angle, or `None` if the material didn't
    /// choose from a continuous range of directions.
    pub pdf: Option<f32>,
}

fields! {
    LocalDirection {
        "direction": Direction = direction,
    }
}

fields! {
    Color {
        "value": Color = value,
    }
}

fields! {
    Density {
        "pdf": Density = pdf,
    }
}

fields! {
    Fraction {
        "fraction": Fraction = fraction,
    }
}

fields! {
    Scattered {
        "direction": Direction = direction,
        "attenuation": Color = attenuation,
        "pdf": OptionalDensity = pdf,
    }
}

/// Implements [`Output`] for a record that a function always returns.
macro_rules! always {
    ($record:ident, $answer:ident, $text:literal, floats: $floats:literal) => {
        impl Output for $record {
            type Record = $record;

            const NAMES: &'static [&'static str] = <$record as Fields>::NAMES;
            const RESULT_TEXT: ResultText = ResultText {
                record: $text,
                present: $text,
                absent: "None",
            };
            const MAX_BYTES: usize = $floats * size_of::<f32>() + 1;

            fn record(&self) -> Option<&$record> {
                Some(self)
            }

            fn record_mut(&mut self) -> Option<&mut $record> {
                Some(self)
            }

            fn answer(rows: Vec<ElementOutcome<Self>>) -> Answer {
                Answer::$answer(rows)
            }
        }
    };
}

always!(LocalDirection, Directions, "{direction}", floats: 3);
always!(Color, Colors, "{value}", floats: 3);
always!(Density, Densities, "{pdf}", floats: 1);
always!(Fraction, Fractions, "{fraction}", floats: 1);
always!(
    Scattered,
    Scattered,
    "direction {direction}, attenuation {attenuation}, pdf {pdf}",
    floats: 7
);

impl Output for Option<LocalDirection> {
    type Record = LocalDirection;

    const NAMES: &'static [&'static str] = <LocalDirection as Fields>::NAMES;
    const RESULT_TEXT: ResultText = ResultText {
        record: "{direction}",
        present: "{direction}",
        absent: "None",
    };
    const MAX_BYTES: usize = 3 * size_of::<f32>() + 1;

    fn record(&self) -> Option<&LocalDirection> {
        self.as_ref()
    }

    fn record_mut(&mut self) -> Option<&mut LocalDirection> {
        self.as_mut()
    }

    fn answer(rows: Vec<ElementOutcome<Self>>) -> Answer {
        Answer::OptionalDirections(rows)
    }
}
