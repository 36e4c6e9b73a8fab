//! The domains of part two's fields: directions at a surface, colours, random numbers, indices of
//! refraction and lengths. Each has classes, a function that classifies a value and, where the
//! items need one, a function that picks a random value.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::domains::fields::{class_below, class_from};
use crate::seed::Rng;

/// The largest number in single precision that is less than 1.
pub const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// The classes of a direction's angle to a surface, by its z component, from +z to −z.
pub const HEIGHTS: &[&str] = &[
    "along the normal",
    "nearly along the normal",
    "above",
    "1e-2 above",
    "1e-3 above",
    "less than 1e-3 above",
    "along the surface",
    "less than 1e-3 below",
    "1e-3 below",
    "1e-2 below",
    "below",
    "nearly opposite to the normal",
    "opposite to the normal",
];

/// The number of [`HEIGHTS`] above the surface.
pub const ABOVE: usize = 6;
/// The class of directions along the surface.
pub const HORIZON: usize = 6;
/// The classes of directions below the surface and along it.
pub const NOT_ABOVE: &[&str] = HEIGHTS.split_at(HORIZON).1;
/// The classes of directions along the surface.
pub const ALONG: &[&str] = &[HEIGHTS[HORIZON]];

/// Returns the class of a direction's angle to the surface.
pub fn height_class(direction: Vec3) -> usize {
    let height = direction.z.abs();
    let class = match height {
        0.0 => HORIZON,
        _ if direction.truncate() == Vec2::ZERO => 0,
        _ => 1 + class_from(&[0.999, 0.1, 1e-2, 1e-3], height),
    };
    if direction.z < 0.0 {
        HEIGHTS.len() - 1 - class
    } else {
        class
    }
}

/// Picks a random direction whose angle to the surface is in this class. Half of the directions
/// are in a plane between two axes.
pub fn direction(rng: &mut Rng, class: usize) -> DVec3 {
    let (class, sign) = if class > HORIZON {
        (HEIGHTS.len() - 1 - class, -1.0)
    } else {
        (class, 1.0)
    };
    let height = match class {
        0 => return sign * DVec3::Z,
        1 => 1.0 - rng.log_uniform(1e-6, 9e-4),
        2 => rng.uniform(0.101, 0.998),
        3 => rng.log_uniform(0.0101, 0.099),
        4 => rng.log_uniform(1.01e-3, 9.9e-3),
        5 => rng.log_uniform(1e-12, 9.9e-4),
        _ => 0.0,
    };
    let around = if rng.coin() {
        let axes = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
        axes[rng.index(axes.len())]
    } else {
        DVec2::from_angle(rng.uniform(0.0, TAU))
    };
    let flat = around * (1.0 - height * height).sqrt();
    flat.extend(sign * height).as_vec3().as_dvec3()
}

/// The classes of a direction's azimuth: along an axis or in a quadrant, by the signs of x and y.
pub const AZIMUTHS: &[&str] = &["+x", "+y", "-x", "-y", "++", "-+", "+-", "--"];

/// Returns the class of a direction's azimuth, or `None` along the normal.
pub fn azimuth_class(direction: Vec3) -> Option<usize> {
    let Vec3 { x, y, .. } = direction;
    match (x == 0.0, y == 0.0) {
        (true, true) => None,
        (false, true) => Some(if x > 0.0 { 0 } else { 2 }),
        (true, false) => Some(if y > 0.0 { 1 } else { 3 }),
        (false, false) => Some(4 + usize::from(x < 0.0) + 2 * usize::from(y < 0.0)),
    }
}

/// The classes of random numbers.
pub const NUMBERS: &[&str] = &[
    "0",
    "below 1e-3",
    "below 0.5",
    "0.5",
    "above 0.5",
    "above 0.999",
    "the largest below 1",
];

/// Returns the class of a random number.
pub fn number_class(number: f32) -> usize {
    match number {
        0.0 => 0,
        ..1e-3 => 1,
        ..0.5 => 2,
        0.5 => 3,
        ..=0.999 => 4,
        ..BELOW_ONE => 5,
        _ => 6,
    }
}

/// Picks a random number. Half of the numbers are at the ends, close to them or in the middle.
pub fn number(rng: &mut Rng) -> f32 {
    if rng.coin() {
        return rng.uniform(0.0, 0.999) as f32;
    }
    match rng.index(5) {
        0 => 0.0,
        1 => rng.log_uniform(1e-7, 9.9e-4) as f32,
        2 => 0.5,
        3 => 1.0 - rng.log_uniform(1.2e-7, 9.9e-4) as f32,
        _ => BELOW_ONE,
    }
}

/// Picks two random numbers as [`number`] does.
pub fn number_pair(rng: &mut Rng) -> Vec2 {
    Vec2::new(number(rng), number(rng))
}

/// The classes of one channel of a reflectance.
pub const CHANNELS: &[&str] = &["0", "below 0.1", "between", "above 0.9", "1"];

/// Returns the class of one channel of a reflectance.
pub fn channel_class(channel: f32) -> usize {
    match channel {
        0.0 => 0,
        ..0.1 => 1,
        ..=0.9 => 2,
        ..1.0 => 3,
        _ => 4,
    }
}

fn channel(rng: &mut Rng, class: usize) -> f64 {
    match class {
        0 => 0.0,
        1 => rng.log_uniform(1e-3, 0.099),
        2 => rng.uniform(0.11, 0.89),
        3 => rng.uniform(0.91, 0.995),
        _ => 1.0,
    }
}

/// The classes of colours.
pub const COLORS: &[&str] = &[
    "black",
    "grey",
    "white",
    "one channel",
    "two channels",
    "three channels",
];

/// Returns the class of a colour.
pub fn color_class(color: Vec3) -> usize {
    let Vec3 { x, y, z } = color;
    match color.cmpgt(Vec3::ZERO).bitmask().count_ones() {
        0 => 0,
        3 if color == Vec3::ONE => 2,
        3 if x == y && y == z => 1,
        channels => 2 + channels as usize,
    }
}

/// The classes of colours with several channels, by the dimmest one as a fraction of the brightest.
pub const CONTRASTS: &[&str] = &["above 0.1", "above 1e-3", "smaller"];

/// Returns the class of a colour, or `None` if it has fewer than two channels.
pub fn contrast_class(color: Vec3) -> Option<usize> {
    let channels = color
        .to_array()
        .into_iter()
        .filter(|channel| *channel > 0.0);
    let channels: Vec<f32> = channels.collect();
    let dimmest = channels.iter().copied().fold(f32::INFINITY, f32::min);
    let contrast = dimmest / color.max_element();
    (channels.len() > 1).then(|| class_from(&[0.1, 1e-3], contrast))
}

/// Returns a factor for each channel of a colour. One of the factors is very small.
pub fn saturation(rng: &mut Rng) -> DVec3 {
    let mut factors = DVec3::ONE;
    factors[rng.index(3)] = rng.log_uniform(1e-5, 4e-5);
    factors
}

/// Picks random reflectances, so that each class of colours occurs, and each class of channels in
/// each channel. One of them is dark in all channels, and one in a single channel.
pub fn reflectances(rng: &mut Rng) -> Vec<DVec3> {
    let count = CHANNELS.len();
    let mut all: Vec<DVec3> = (0..count)
        .map(|class| {
            let channels = [class, class + 2, class + 4].map(|class| channel(rng, class % count));
            DVec3::from_array(channels)
        })
        .collect();
    let axis = DVec3::AXES[rng.index(3)];
    let grey = DVec3::splat(channel(rng, 2));
    let dark = DVec3::from_array([2; 3].map(|class| channel(rng, class)));
    let dark = rng.log_uniform(1e-3, 0.015) * dark;
    let saturated = channel(rng, 2) * saturation(rng);
    all.extend([channel(rng, 2) * axis, grey, dark, saturated]);
    all.extend([DVec3::ONE, DVec3::ZERO]);
    all
}

/// The classes of indices of refraction.
pub const INDICES: &[&str] = &[
    "below 0.5",
    "0.5 to 0.9",
    "0.9 to 0.98",
    "just below 1",
    "1",
    "just above 1",
    "1.02 to 1.1",
    "1.1 to 2",
    "above 2",
];

/// Returns the class of an index of refraction.
pub fn index_class(ior: f32) -> usize {
    match ior {
        ..0.5 => 0,
        ..0.9 => 1,
        ..0.98 => 2,
        ..1.0 => 3,
        1.0 => 4,
        ..1.02 => 5,
        ..1.1 => 6,
        ..=2.0 => 7,
        _ => 8,
    }
}

/// Picks a random index of refraction in this class.
pub fn index(rng: &mut Rng, class: usize) -> f32 {
    let index = match class {
        0 => rng.log_uniform(0.1, 0.4999),
        1 => rng.uniform(0.5001, 0.8999),
        2 => rng.uniform(0.9001, 0.9799),
        3 => 1.0 - rng.log_uniform(1e-5, 0.0199),
        4 => 1.0,
        5 => 1.0 + rng.log_uniform(1e-5, 0.0199),
        6 => rng.uniform(1.0201, 1.0999),
        7 => rng.uniform(1.1001, 1.9999),
        _ => rng.log_uniform(2.0001, 10.0),
    };
    index as f32
}

/// The classes of lengths and distances: decades, named after their lower limits.
pub const LENGTHS: &[&str] = &["below 0.01", "0.01", "0.1", "1", "10", "100", "1000"];

/// Returns the class of a length.
pub fn length_class(length: f64) -> usize {
    let decade = length.log10().floor() as i32 + 3;
    decade.clamp(0, LENGTHS.len() as i32 - 1) as usize
}

/// The classes of a positive quantity without a usual size, such as a radiance.
pub const MAGNITUDES: &[&str] = &["0", "below 0.1", "0.1", "1", "10", "100", "above 1000"];

/// Returns the class of a quantity.
pub fn magnitude_class(value: f64) -> usize {
    match value {
        0.0 => 0,
        _ => 1 + class_below(&[0.1, 1.0, 10.0, 100.0, 1e3], value),
    }
}

/// The classes of shares.
pub const SHARES: &[&str] = &[
    "0",
    "below 1e-7",
    "1e-7",
    "1e-4",
    "1e-2",
    "0.1",
    "above 0.5",
];

/// Returns the class of a share.
pub fn share_class(share: f64) -> usize {
    match share {
        0.0 => 0,
        _ => 1 + class_below(&[1e-7, 1e-4, 1e-2, 0.1, 0.5], share),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn values_are_picked_from_their_classes() {
        let mut rng = Seed(1).rng("fields");
        for _ in 0..200 {
            for class in 0..HEIGHTS.len() {
                let direction = direction(&mut rng, class);
                assert_eq!(height_class(direction.as_vec3()), class, "{direction}");
            }
            for class in 0..INDICES.len() {
                assert_eq!(index_class(index(&mut rng, class)), class);
            }
            for class in 0..CHANNELS.len() {
                assert_eq!(channel_class(channel(&mut rng, class) as f32), class);
            }
            assert!((0.0..1.0).contains(&number(&mut rng)));
        }
    }

    #[test]
    fn indices_reach_both_ends_of_their_classes() {
        let mut rng = Seed(1).rng("fields");
        let limits = [0.1, 0.5, 0.9, 0.98, 1.0, 1.0, 1.02, 1.1, 2.0, 10.0];
        for class in 0..INDICES.len() {
            let drawn: Vec<f32> = (0..2000).map(|_| index(&mut rng, class)).collect();
            let ends = [f32::min, f32::max].map(|end| drawn.iter().copied().reduce(end));
            for (end, limit) in ends.into_iter().flatten().zip(&limits[class..]) {
                assert!(
                    (end / limit - 1.0).abs() < 0.02,
                    "{end} isn't close to {limit}"
                );
            }
        }
    }

    #[test]
    fn every_class_of_colors_channels_and_numbers_occurs() {
        let mut rng = Seed(1).rng("fields");
        let colors = reflectances(&mut rng);
        let occurs = |count: usize, class: &dyn Fn(Vec3) -> usize| {
            let classes: Vec<usize> = colors.iter().map(|it| class(it.as_vec3())).collect();
            (0..count).all(|class| classes.contains(&class))
        };
        assert!(occurs(COLORS.len(), &color_class));
        for axis in 0..3 {
            assert!(occurs(CHANNELS.len(), &|color| channel_class(color[axis])));
        }
        let numbers: Vec<usize> = (0..200).map(|_| number_class(number(&mut rng))).collect();
        assert!((0..NUMBERS.len()).all(|class| numbers.contains(&class)));
    }
}
