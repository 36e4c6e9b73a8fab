//! Aspects that all calls on something with a size and a position have in common.

use super::Aspect;
use super::fields::{OCTANTS, PLACES, ROUND, SIZES, octant, place_class, round_class, size_class};
use crate::oracle::bbox::Bounds;

/// A call on objects in space.
pub trait Placed {
    /// Returns the box around all objects in the call, or `None` if the box is empty or only a
    /// point.
    fn bounds(&self) -> Option<Bounds>;
}

impl<C: Placed> Aspect<C> {
    /// The size: half of the longest side of the box.
    pub const SIZE: Self = Aspect::new("size", SIZES, |call| {
        Some(size_class(call.bounds()?.half_side()))
    });

    /// How close the size is to a power of ten.
    pub const ROUND: Self = Aspect::new("round size", ROUND, |call| {
        Some(round_class(call.bounds()?.half_side()))
    });

    /// The position of the box's centre.
    pub const PLACE: Self = Aspect::new("place", PLACES, |call| {
        let bounds = call.bounds()?;
        Some(place_class(bounds.center(), bounds.half_side()))
    });

    /// The octant of the box's centre.
    pub const OCTANT: Self = Aspect::new("octant", OCTANTS, |call| octant(call.bounds()?.center()));

    /// The octant that contains the entire box, if any.
    pub const OCTANT_OF_ALL: Self = Aspect {
        class: |call| {
            let Bounds { min, max } = call.bounds()?;
            let is_in_one = (min * max).min_element() > 0.0;
            is_in_one.then(|| octant(min)).flatten()
        },
        ..Self::OCTANT
    };
}
