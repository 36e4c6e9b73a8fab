//! The lights that a direction leads to.

use glam::DVec3;
use protocol::function::Function;
use protocol::light::lights::{AreaLightPdf, LightList, LightsPdf, Toward};

use super::{
    ALIKE, COSINES, FORMS, RADII, alike_class, cosine_class, flat_lights, form_class, longer_edge,
    power, radii_class, side_class, spheres,
};
use crate::domains::Aspect;
use crate::domains::fields::{DIRECTIONS, class_below, class_from, class_up_to, direction_class};
use crate::domains::light::Row;
use crate::domains::light::fields::{LENGTHS, SHARES, length_class, share_class};
use crate::oracle::light::flat_shape::FlatShape;
use crate::oracle::light::lights::FlatLight64;
use crate::oracle::light::spherical_light::SphericalLight64;

impl<F: Function<Subject = LightList, Input = Toward>> Aspect<Row<F>> {
    /// The aspects of the light that decides the answer.
    pub(super) const LIGHT_AHEAD: &'static [Self] = &[
        Aspect::new("form of the light", FORMS, |row| {
            Some(form_class(&main_sight(row)?.light))
        }),
        Aspect::new("longer edge of the light", LENGTHS, |row| {
            Some(side_class(&main_sight(row)?.light))
        }),
        Aspect::new("distance", LENGTHS, |row| {
            Some(length_class(main_sight(row)?.distance))
        }),
    ];

    /// The aspects of how that light is seen.
    pub(super) const SIGHT: &'static [Self] = &[
        Aspect::new("cosine at the light", COSINES, |row| {
            Some(cosine_class(main_sight(row)?.cosine))
        }),
        // Where the direction crosses the plane of the light.
        Aspect::new("seen", SEEN, |row| Some(main_sight(row)?.seen)),
        // The direction in the world.
        Aspect::new("direction", DIRECTIONS, |row| {
            direction_class(row.input.direction)
        }),
    ];
}

/// The distance of the light, as a multiple of its longer edge.
pub(super) const DISTANCE_IN_EDGES: Aspect<Row<AreaLightPdf>> = Aspect::new(
    "distance in edges",
    &["below 0.05", "0.05 to 20", "20 to 300", "above 300"],
    |row| {
        let Sight {
            light, distance, ..
        } = main_sight(row)?;
        Some(class_below(
            &[0.05, 20.0, 300.0],
            distance / longer_edge(&light),
        ))
    },
);

/// The aspects of all lights in a direction.
pub(super) const LIGHTS_AHEAD: &[Aspect<Row<LightsPdf>>] = &[
    // The number of lights whose density is positive.
    Aspect::new(
        "lights ahead",
        &["none", "1", "2", "3 to 8", "9 or more"],
        |row| {
            let sights = sights(row);
            let lit = sights.iter().filter(|sight| sight.is_lit()).count();
            Some(class_up_to(&[0, 1, 2, 8], lit))
        },
    ),
    // The share of the light that is seen.
    Aspect::new("share of the light", SHARES, |row| {
        let sight = main_sight(row).filter(Sight::is_lit)?;
        Some(share_class(sight.light.power() / power(&row.subject)))
    }),
    // A property that the light that is seen shares with another light.
    Aspect::new("shared with another light", ALIKE, |row| {
        let sight = main_sight(row).filter(Sight::is_lit)?;
        Some(alike_class(&row.subject, &sight.light))
    }),
    // The distance of a sphere that has a density or that the point is inside of.
    Aspect::new("distance in radii", RADII, |row| {
        Some(radii_class(&sphere_ahead(row)?, row.input.from))
    }),
    // The radius of that sphere.
    Aspect::new("radius of the sphere", LENGTHS, |row| {
        Some(length_class(sphere_ahead(row)?.radius))
    }),
];

/// The classes of the point where a line crosses the plane of a light.
const SEEN: &[&str] = &[
    "in the middle",
    "between the middle and an edge",
    "near an edge",
    "just past an edge",
    "past an edge",
    "in the opposite direction",
];

/// A light and the point where a direction crosses its plane, on the light or beside it.
struct Sight {
    light: FlatLight64,
    distance: f64,
    /// The cosine at the light.
    cosine: f64,
    /// The class in [`SEEN`].
    seen: usize,
}

impl Sight {
    /// Returns whether the direction leads to the front of the light.
    fn is_lit(&self) -> bool {
        self.seen < 3 && self.cosine > 0.0
    }
}

/// Returns how each flat light is seen.
fn sights<F>(row: &Row<F>) -> Vec<Sight>
where
    F: Function<Subject = LightList, Input = Toward>,
{
    let Toward { from, direction } = row.input;
    let (from, direction) = (from.as_dvec3(), direction.as_dvec3());
    let sights = flat_lights(&row.subject).filter_map(|light| {
        let hit = light.shape.intersect_plane(from, direction)?;
        let inset = inset(&light.shape, from + hit.distance * direction);
        let seen = if hit.distance < 0.0 {
            5
        } else {
            class_from(&[0.25, 0.05, 0.0, -0.1], inset)
        };
        Some(Sight {
            light,
            distance: hit.distance.abs(),
            cosine: -hit.cosine,
            seen,
        })
    });
    sights.collect()
}

/// Returns the sight of the light that decides the answer: one that is lit, if possible.
fn main_sight<F>(row: &Row<F>) -> Option<Sight>
where
    F: Function<Subject = LightList, Input = Toward>,
{
    sights(row)
        .into_iter()
        .min_by_key(|sight| (!sight.is_lit(), sight.seen))
}

/// Returns how far a point in the plane of a shape is from the nearest edge, as a fraction of the
/// edges. Negative outside.
fn inset(shape: &FlatShape, point: DVec3) -> f64 {
    let [e0, e1] = shape.edges;
    let (normal, from_corner) = (e0.cross(e1), point - shape.corner);
    let a = from_corner.cross(e1).dot(normal) / normal.length_squared();
    let b = e0.cross(from_corner).dot(normal) / normal.length_squared();
    let far = if shape.is_triangle {
        1.0 - a - b
    } else {
        (1.0 - a).min(1.0 - b)
    };
    a.min(b).min(far)
}

/// Returns a sphere that has a density or that the point is inside of.
fn sphere_ahead(row: &Row<LightsPdf>) -> Option<SphericalLight64> {
    let Toward { from, direction } = row.input;
    let pdf = |light: &SphericalLight64| light.pdf(from.as_dvec3(), direction.as_dvec3()).value;
    spheres(&row.subject).find(|light| {
        let is_inside = radii_class(light, from) == 0;
        is_inside || pdf(light) > 0.0
    })
}
