//! The domains of part two's functions.
//!
//! Each aspect is about one field, or about how a few fields are related. Functions that have a
//! field in common share its aspects.

pub mod environment;
pub mod fields;
pub mod lights;
pub mod materials;
pub mod transport;

use std::rc::Rc;

use glam::{Vec2, Vec3};
use protocol::Table;
use protocol::function::{Function, LocalDirection};
use protocol::light::environment::{MapSample, RandomPair};
use protocol::light::lambertian::{DirectionPair, MatteSample};
use protocol::light::lights::LightSample;
use protocol::light::specular::GlassSample;

use self::fields::{AZIMUTHS, HEIGHTS, NUMBERS, azimuth_class, height_class, number_class};
use super::Aspect;

/// A call: a row of a table.
#[derive(Clone, Debug)]
pub struct Row<F: Function> {
    /// The value that the function is called on.
    pub subject: Rc<F::Subject>,
    /// The arguments.
    pub input: F::Input,
}

/// Returns the rows of a table.
fn rows<F: Function>(table: &Table<F>) -> Vec<Row<F>> {
    let subject = Rc::new(table.subject.clone());
    let rows = table.rows.to_vec();
    let row = |input: &F::Input| Row {
        subject: subject.clone(),
        input: input.clone(),
    };
    rows.iter().map(row).collect()
}

/// Returns a function that returns the rows of a question about one function. The argument is the
/// function's variant of [`protocol::LightQuestion`].
macro_rules! rows_of {
    ($function:ident) => {
        |question: &protocol::Question| {
            let protocol::Question::Light(protocol::LightQuestion::$function(table)) = question
            else {
                return Vec::new();
            };
            $crate::domains::light::rows(table)
        }
    };
}
use rows_of;

/// Arguments with the direction to where a path came from.
pub trait Outgoing {
    /// Returns the direction.
    fn out(&self) -> Vec3;
}

/// Arguments with a random number that chooses between a few possibilities.
pub trait Choosing {
    /// Returns the random number.
    fn choice(&self) -> f32;
}

/// Arguments with two random numbers that pick a point or a direction.
pub trait Sampling {
    /// Returns the random numbers.
    fn random(&self) -> Vec2;
}

/// Implements a trait by returning a field.
macro_rules! field {
    ($($trait:ident for $input:ident: $method:ident() -> $type:ty = $field:ident;)*) => {
        $(impl $trait for $input {
            fn $method(&self) -> $type {
                self.$field
            }
        })*
    };
}

field! {
    Outgoing for DirectionPair: out() -> Vec3 = out;
    Outgoing for MatteSample: out() -> Vec3 = out;
    Outgoing for LocalDirection: out() -> Vec3 = direction;
    Outgoing for GlassSample: out() -> Vec3 = out;
    Choosing for GlassSample: choice() -> f32 = random;
    Choosing for LightSample: choice() -> f32 = choice;
    Choosing for MapSample: choice() -> f32 = choice;
    Sampling for MatteSample: random() -> Vec2 = random;
    Sampling for RandomPair: random() -> Vec2 = random;
    Sampling for LightSample: random() -> Vec2 = random;
    Sampling for MapSample: random() -> Vec2 = random;
}

impl<F: Function<Input: Outgoing>> Aspect<Row<F>> {
    /// The aspects of `out`.
    pub const OUT: &'static [Self] = &[
        // The angle between `out` and the surface.
        Aspect::new("out", HEIGHTS, |row| Some(height_class(row.input.out()))),
        Aspect::new("azimuth of out", AZIMUTHS, |row| {
            azimuth_class(row.input.out())
        }),
    ];
}

impl<F: Function<Input: Choosing>> Aspect<Row<F>> {
    /// The random number that chooses.
    pub const CHOICE: Self = Aspect::new("choice", NUMBERS, |row| {
        Some(number_class(row.input.choice()))
    });
}

impl<F: Function<Input: Sampling>> Aspect<Row<F>> {
    /// The two random numbers.
    pub const RANDOM: &'static [Self] = &[
        Aspect::new("random.x", NUMBERS, |row| {
            Some(number_class(row.input.random().x))
        }),
        Aspect::new("random.y", NUMBERS, |row| {
            Some(number_class(row.input.random().y))
        }),
    ];
}
