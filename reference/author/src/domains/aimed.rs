//! Aspects that all calls with a ray have in common.

use protocol::Ray;

use super::Aspect;
use super::fields::{DIAGONALS, DIRECTIONS, RANGES, diagonal_class, direction_class, range_class};

/// A call with a ray.
pub trait Aimed {
    /// Returns the ray.
    fn ray(&self) -> &Ray;
}

impl<C: Aimed> Aspect<C> {
    /// The direction of the ray.
    pub const DIRECTION: Self = Aspect::new("direction", DIRECTIONS, |call| {
        direction_class(call.ray().dir)
    });

    /// The diagonal that the ray is parallel to.
    pub const DIAGONAL: Self =
        Aspect::new("diagonal", DIAGONALS, |call| diagonal_class(call.ray().dir));

    /// The range of the ray.
    pub const RANGE: Self = Aspect::new("range", RANGES, |call| range_class(call.ray().range));
}
