//! The lights that samples pick.

use glam::DVec3;
use protocol::light::lights::{LightSample, LightsSample};

use super::{
    ALIKE, COSINES, FORMS, POINTS, RADII, alike_class, cosine_class, double, form_class, power,
    radii_class, side_class, spheres,
};
use crate::domains::Aspect;
use crate::domains::fields::{OCTANTS, octant};
use crate::domains::light::Row;
use crate::domains::light::fields::{
    LENGTHS, MAGNITUDES, SHARES, length_class, magnitude_class, share_class,
};
use crate::oracle::light::lights::Light64;
use crate::oracle::light::spherical_light::SphericalLight64;

/// The aspects of the light that a sample picks.
pub(super) const PICKED: &[Aspect<Row<LightsSample>>] = &[
    // The position of the picked light among the lights with power.
    Aspect::new(
        "picked light",
        &["the only one", "the first", "the last", "any other"],
        |row| Some(pick(row)?.place),
    ),
    Aspect::new("kind of the picked light", &["flat", "sphere"], |row| {
        Some(usize::from(pick(row)?.light.flat().is_none()))
    }),
    Aspect::new("share of the picked light", SHARES, |row| {
        Some(share_class(pick(row)?.share))
    }),
    Aspect::new("form of the picked light", FORMS, |row| {
        Some(form_class(&pick(row)?.light.flat()?))
    }),
    Aspect::new("longer edge of the picked light", LENGTHS, |row| {
        Some(side_class(&pick(row)?.light.flat()?))
    }),
    // The radiance of the picked light in its brightest channel.
    Aspect::new("radiance of the picked light", MAGNITUDES, |row| {
        Some(magnitude_class(pick(row)?.light.radiance().max_element()))
    }),
    // The colour of the picked light, classified by its number of channels.
    Aspect::new("channels of the picked light", &["1", "2", "3"], |row| {
        let channels = pick(row)?
            .light
            .radiance()
            .cmpgt(DVec3::ZERO)
            .bitmask()
            .count_ones();
        (channels as usize).checked_sub(1)
    }),
    // The distance of the point on the picked light.
    Aspect::new("distance", LENGTHS, |row| {
        Some(length_class(pick(row)?.to_light?.length()))
    }),
    // The cosine at the picked light.
    Aspect::new("cosine at the light", COSINES, |row| {
        let pick = pick(row)?;
        let normal = pick.light.flat()?.shape.normal();
        Some(cosine_class(-pick.to_light?.normalize().dot(normal)))
    }),
    // The octant of the direction to the point on the picked light.
    Aspect::new("octant", OCTANTS, |row| octant(pick(row)?.to_light?)),
    // A property that the picked light shares with another light.
    Aspect::new("shared with another light", ALIKE, |row| {
        Some(alike_class(&row.subject, &pick(row)?.light.flat()?))
    }),
    // The distance of the picked sphere.
    Aspect::new("distance in radii", RADII, |row| {
        Some(radii_class(&pick(row)?.light.sphere()?, row.input.from))
    }),
    // The radius of the picked sphere.
    Aspect::new("radius of the sphere", LENGTHS, |row| {
        Some(length_class(pick(row)?.light.sphere()?.radius))
    }),
    // Whether the point is inside a sphere.
    Aspect::new("point", POINTS, |row| {
        let is_inside = |light: &SphericalLight64| radii_class(light, row.input.from) == 0;
        if pick(row)?.light.sphere().as_ref().is_some_and(is_inside) {
            return Some(1);
        }
        let is_inside_any = spheres(&row.subject).any(|light| is_inside(&light));
        Some(2 * usize::from(is_inside_any))
    }),
    // Whether the list contains lights without power.
    Aspect::new(
        "lights without power",
        &["the first", "another one", "none"],
        |row| {
            let lights = row.subject.lights.iter().map(double);
            let dark: Vec<bool> = lights.map(|light| light.power() == 0.0).collect();
            Some(match dark.iter().position(|is_dark| *is_dark) {
                Some(0) => 0,
                Some(_) => 1,
                None => 2,
            })
        },
    ),
];

/// The light that a sample picks.
struct Pick {
    light: Light64,
    share: f64,
    /// Its position among the lights with power: 0 for the only one, 1 for the first, 2 for the
    /// last and 3 for any other.
    place: usize,
    /// The vector from the point that is lit to the point on the light, if the light is flat.
    to_light: Option<DVec3>,
}

/// Returns the light that a sample picks, or `None` if no light has power.
fn pick(row: &Row<LightsSample>) -> Option<Pick> {
    let LightSample {
        from,
        choice,
        random,
    } = row.input;
    let lights = row.subject.lights.iter().map(double);
    let lights: Vec<Light64> = lights.filter(|light| light.power() > 0.0).collect();
    let total = power(&row.subject);
    let mut rest = f64::from(choice) * total;
    let picked = lights.iter().position(|light| {
        rest -= light.power();
        rest < 0.0
    });
    let last = lights.len().checked_sub(1)?;
    let index = picked.unwrap_or(last);
    let light = lights[index];
    Some(Pick {
        light,
        share: light.power() / total,
        place: match index {
            _ if last == 0 => 0,
            0 => 1,
            _ if index == last => 2,
            _ => 3,
        },
        to_light: light
            .flat()
            .map(|light| light.point(random.as_dvec2()) - from.as_dvec3()),
    })
}
