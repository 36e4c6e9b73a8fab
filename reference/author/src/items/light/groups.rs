//! The groups of items in the assignment `light`.

use crate::items::Group;

/// The light that a matte surface scatters, and its density.
pub(super) const MATTE: Group = Group("matte surfaces");
/// The direction in which a matte surface scatters a path.
pub(super) const MATTE_SAMPLES: Group = Group("samples of matte surfaces");
/// Mirrors and glass.
pub(super) const SPECULAR: Group = Group("mirrors and glass");
/// The directions toward lights.
pub(super) const LIGHT_SAMPLES: Group = Group("samples of lights");
/// The densities of those directions.
pub(super) const LIGHT_DENSITIES: Group = Group("densities of lights");
/// Environment maps.
pub(super) const MAPS: Group = Group("environment maps");
/// Direct light.
pub(super) const DIRECT: Group = Group("direct light");
/// Direct light from environment maps.
pub(super) const DIRECT_MAPS: Group = Group("direct light from environment maps");
