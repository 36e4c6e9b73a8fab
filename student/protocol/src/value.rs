//! Fields: the named parts of a function's subject, inputs and outputs. In every function, a
//! field's type determines how the field is compared, moved and printed.

use std::borrow::Cow;
use std::fmt::Debug;

use glam::{UVec2, Vec2, Vec3};

use crate::function::light::environment::MapImage;
use crate::function::light::lights::ListedLight;
use crate::function::light::transport::Room;
use crate::interval::Interval;
use crate::shape::Shape;
use crate::tree::TreeNode;

/// The value of a field. The variant is the field's type.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'a> {
    /// A distance along a ray.
    Length(f32),
    /// A position in space.
    Point(Vec3),
    /// A direction, as a unit vector.
    Direction(Vec3),
    /// Texture coordinates. u is periodic: 0 and 1 are the same.
    Uv(Vec2),
    /// A part of a ray, from one distance to another.
    Interval(Interval),
    /// The range of a ray, which may be unbounded.
    Range(Interval),
    /// The number of a shape or a node.
    Index(u32),
    /// A count.
    Count(u32),
    /// An angle in degrees.
    Angle(f32),
    /// A ratio, such as that of two lengths.
    Ratio(f32),
    /// The width and height of a film, in pixels.
    Film(UVec2),
    /// A pixel. (0, 0) is at the bottom left.
    Pixel(UVec2),
    /// A position in a pixel, each component in `[0, 1)`.
    Offset(Vec2),
    /// A list of shapes.
    Shapes(Cow<'a, [Shape]>),
    /// The nodes of a tree.
    Nodes(Cow<'a, [TreeNode]>),
    /// A value for each of the colour channels red, green and blue.
    Color(Vec3),
    /// A probability density, per solid angle.
    Density(f32),
    /// A probability density, or `None` if there isn't one.
    OptionalDensity(Option<f32>),
    /// A fraction of the light, from 0 to 1.
    Fraction(f32),
    /// A random number in `[0, 1)`.
    Random(f32),
    /// Two random numbers in `[0, 1)`.
    RandomPair(Vec2),
    /// A list of lights.
    Lights(Cow<'a, [ListedLight]>),
    /// A scene of rectangles.
    Scene(Cow<'a, Room>),
    /// An environment map.
    Map(Cow<'a, MapImage>),
}

/// A subject, an input or an output: a list of fields.
pub trait Record: Debug {
    /// Returns the names of the fields, in order.
    fn names(&self) -> &'static [&'static str];

    /// Returns the value of the field at `index`.
    ///
    /// # Panics
    ///
    /// If `index` is out of range.
    fn value(&self, index: usize) -> Value<'_>;

    /// Changes the value of the field at `index`. A value of a different type is ignored.
    ///
    /// # Panics
    ///
    /// If `index` is out of range.
    fn set(&mut self, index: usize, value: Value<'_>);
}

impl dyn Record + '_ {
    /// Returns the values of all fields, in order.
    pub fn values(&self) -> impl Iterator<Item = Value<'_>> {
        (0..self.names().len()).map(|index| self.value(index))
    }

    /// Applies `change` to the value of every field.
    pub fn change(&mut self, change: &dyn Fn(Value<'_>) -> Value<'static>) {
        for index in 0..self.names().len() {
            let changed = change(self.value(index));
            self.set(index, changed);
        }
    }
}

/// The empty record, which stands for the subject of a function that has no subject.
impl Record for () {
    fn names(&self) -> &'static [&'static str] {
        &[]
    }

    fn value(&self, index: usize) -> Value<'_> {
        panic!("there is no field {index}")
    }

    fn set(&mut self, _: usize, _: Value<'_>) {}
}

/// A record whose fields don't depend on its value.
pub trait Fields: Record {
    /// The names of the fields, in order.
    const NAMES: &'static [&'static str];
}

/// Declares the fields of a struct, each with its name, type and location in the struct.
macro_rules! fields {
    ($record:ty { $($name:literal: $type:ident = $($part:ident).+,)+ }) => {
        impl $crate::value::Fields for $record {
            const NAMES: &'static [&'static str] = &[$($name),+];
        }

        impl $crate::value::Record for $record {
            fn names(&self) -> &'static [&'static str] {
                <Self as $crate::value::Fields>::NAMES
            }

            fn value(&self, index: usize) -> $crate::value::Value<'_> {
                const VALUES: &[fn(&$record) -> $crate::value::Value<'static>] =
                    &[$(|record| $crate::value::Value::$type(record.$($part).+)),+];
                VALUES[index](self)
            }

            fn set(&mut self, index: usize, value: $crate::value::Value<'_>) {
                match (<Self as $crate::value::Fields>::NAMES[index], value) {
                    $(($name, $crate::value::Value::$type(value)) => self.$($part).+ = value,)+
                    _ => {}
                }
            }
        }
    };
}

pub(crate) use fields;
