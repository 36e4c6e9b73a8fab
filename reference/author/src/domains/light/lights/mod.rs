//! The domains of lights.

mod ahead;
mod picked;

use glam::Vec3;
use protocol::function::Function;
use protocol::light::lights::{
    AreaLightPdf, FlatLight, LightList, LightsPdf, LightsSample, ListedLight,
};

use self::ahead::{DISTANCE_IN_EDGES, LIGHTS_AHEAD};
use self::picked::PICKED;
use super::fields::{SHARES, length_class};
use super::{Row, rows_of};
use crate::domains::fields::{class_from, class_up_to};
use crate::domains::previous_call::NAME as ONLY_CHANGE;
use crate::domains::{Aspect, FunctionDomain, UntestedClasses, not_asked};
use crate::oracle::light::flat_shape::FlatShape;
use crate::oracle::light::lights::{FlatLight64, Light64};
use crate::oracle::light::spherical_light::SphericalLight64;

/// The domain of `AreaLight::pdf`.
pub static AREA_LIGHT_PDF: FunctionDomain<Row<AreaLightPdf>> = FunctionDomain {
    aspects: &[Aspect::LIGHT_AHEAD, &[DISTANCE_IN_EDGES], Aspect::SIGHT],
    pairs: &[["form of the light", "seen"]],
    fields: &["from", "direction", "lights"],
    not_asked: &[WITHIN_THE_SCENE],
    ..FunctionDomain::new("AreaLight::pdf", rows_of!(AreaLightPdf))
};

/// The domain of `Lights::pdf`.
pub static LIGHTS_PDF: FunctionDomain<Row<LightsPdf>> = FunctionDomain {
    aspects: &[
        Aspect::LIST,
        Aspect::LIGHT_AHEAD,
        Aspect::SIGHT,
        LIGHTS_AHEAD,
    ],
    fields: &["from", "direction", "lights"],
    not_asked: &[WITHIN_THE_SCENE, NOT_THAT_SLANTED],
    ..FunctionDomain::new("Lights::pdf", rows_of!(LightsPdf))
};

/// The domain of `Lights::sample`.
pub static LIGHTS_SAMPLE: FunctionDomain<Row<LightsSample>> = FunctionDomain {
    aspects: &[Aspect::LIST, &[Aspect::CHOICE], Aspect::RANDOM, PICKED],
    pairs: &[
        ["kind of the picked light", "choice"],
        ["kind of the picked light", "random.x"],
        ["kind of the picked light", "random.y"],
    ],
    fields: &["from", "choice", "random", "lights"],
    not_asked: &[
        WITHIN_THE_SCENE,
        not_asked(&["lights"])
            .classes(&["none"])
            .columns(&["some", "direction", "unit_direction"])
            .because("Without lights, there is no direction."),
        not_asked(&["cosine at the light"])
            .classes(COSINES.split_at(5).1)
            .columns(&["some", "direction", "unit_direction"])
            .because("Seen from behind, the light faces away."),
        not_asked(&["cosine at the light"])
            .classes(COSINES.split_at(5).0)
            .columns(&["`None`"])
            .because("Seen from the front, the light doesn't face away."),
        not_asked(&[
            "kinds of lights",
            "kind of the picked light",
            "distance in radii",
        ])
        .classes(OUTSIDE)
        .columns(&["`None`"])
        .because("A sphere that is seen from outside never faces away."),
        not_asked(&["distance in radii", "point"])
            .classes(INSIDE)
            .columns(&["some", "direction", "unit_direction"])
            .because("From inside, there is no direction to a sphere."),
        not_asked(&["share of the picked light"])
            .classes(SHARES.split_at(3).0)
            .because("A light with so little power is only picked by numbers close to a border."),
        not_asked(&["shared with another light"])
            .columns(&["`None`"])
            .because("Whether the picked light faces away doesn't depend on the other lights."),
        not_asked(&[ONLY_CHANGE])
            .classes(&["random", "lights"])
            .columns(&["`None`"])
            .because(
                "An answer kept from other random numbers or lights is noticed where both exist.",
            ),
        not_asked(&["radiance of the picked light"])
            .classes(&["0"])
            .because("A light without power is never picked."),
    ],
    ..FunctionDomain::new("Lights::sample", rows_of!(LightsSample))
};

/// Classes that need no tests because scenes have coordinates up to 1,000.
const WITHIN_THE_SCENE: UntestedClasses = not_asked(&[
    "longer edge of the light",
    "longer edge of the picked light",
    "radius of the sphere",
])
.classes(&["1000"])
.because("Scenes have coordinates up to 1,000, so hardly any light is this large.");

/// The cosines of directions almost in the light's plane.
const ALMOST_IN_ITS_PLANE: &[&str] = &[COSINES[4], COSINES[5]];

/// Classes that need no tests because only a single light parallel to the axes is seen from so
/// close to its plane.
const NOT_THAT_SLANTED: UntestedClasses = not_asked(&["cosine at the light"])
    .classes(ALMOST_IN_ITS_PLANE)
    .because("Correct formulas lose too many digits, unless the light is parallel to two axes.");

/// The forms of flat lights.
const FORMS: &[&str] = &[
    "rectangle",
    "narrow rectangle",
    "parallelogram",
    "very narrow rectangle",
    "right triangle",
    "narrow right triangle",
    "triangle",
    "very narrow right triangle",
];

/// Returns the class of a light's form. A rectangle is narrow if its length is more than five times
/// its width, and very narrow if it is more than a hundred times its width.
fn form_class(light: &FlatLight64) -> usize {
    let [e0, e1] = light.shape.edges;
    let lengths = [e0.length(), e1.length()];
    let cosine = e0.dot(e1) / (lengths[0] * lengths[1]);
    let ratio = lengths[0] / lengths[1];
    let class = match ratio.max(1.0 / ratio) {
        _ if cosine.abs() > 1e-3 => 2,
        100.0.. => 3,
        5.0.. => 1,
        _ => 0,
    };
    class + 4 * usize::from(light.shape.is_triangle)
}

/// Returns the class of a light's longer edge.
fn side_class(light: &FlatLight64) -> usize {
    length_class(longer_edge(light))
}

fn longer_edge(light: &FlatLight64) -> f64 {
    let [e0, e1] = light.shape.edges;
    e0.length().max(e1.length())
}

/// The classes of the cosine at a light, from in front of it to behind it.
const COSINES: &[&str] = &[
    "head-on",
    "0.1",
    "0.02",
    "1e-3",
    "below 1e-3",
    "below 1e-3, from behind",
    "1e-3, from behind",
    "0.02, from behind",
    "0.1, from behind",
    "head-on, from behind",
];

/// Returns the class of the cosine at a light. It is positive in front of the light.
fn cosine_class(cosine: f64) -> usize {
    let class = class_from(&[0.99, 0.1, 0.02, 1e-3], cosine.abs());
    if cosine > 0.0 {
        class
    } else {
        COSINES.len() - 1 - class
    }
}

/// The classes of points, by whether they are inside a sphere.
const POINTS: &[&str] = &[
    "outside all spheres",
    "inside the picked sphere",
    "inside a sphere that isn't picked",
];

/// The classes of distances from the centre of a sphere.
const RADII: &[&str] = &[
    "below 1",
    "1 to 1.001",
    "1.001 to 1.05",
    "1.05 to 300",
    "above 300",
];

/// The classes of spheres that are seen from outside.
const OUTSIDE: &[&str] = &["spheres", "sphere", RADII[1], RADII[2], RADII[3], RADII[4]];

/// The classes of points inside the picked sphere.
const INSIDE: &[&str] = &[RADII[0], POINTS[1]];

/// Returns the class of a point's distance from the centre of a sphere, in radii.
fn radii_class(sphere: &SphericalLight64, point: Vec3) -> usize {
    let radii = point.as_dvec3().distance(sphere.center) / sphere.radius;
    class_up_to(&[1.0, 1.001, 1.05, 300.0], radii)
}

/// The classes of lights, by what they have in common with another light in the list.
const ALIKE: &[&str] = &[
    "everything",
    "the corner",
    "the power",
    "neither the corner nor the power",
];

/// Returns what a flat light has in common with another light in the list.
fn alike_class(list: &LightList, light: &FlatLight64) -> usize {
    let lights: Vec<FlatLight64> = flat_lights(list).collect();
    let is_shared =
        |is_alike: &dyn Fn(&&FlatLight64) -> bool| lights.iter().filter(is_alike).count() > 1;
    // Sums and products of the same numbers can be rounded differently.
    let is_equal = |a: f64, b: f64| (a - b).abs() <= 1e-6 * a.max(b);
    if is_shared(&|it| *it == light) {
        0
    } else if is_shared(&|it| it.shape.corner == light.shape.corner) {
        1
    } else if is_shared(&|it| is_equal(it.power(), light.power())) {
        2
    } else {
        3
    }
}

/// Converts a light to double precision.
fn double(light: &ListedLight) -> Light64 {
    match light {
        ListedLight::Flat(FlatLight {
            corner,
            edges,
            is_triangle,
            radiance,
        }) => Light64::Flat(FlatLight64 {
            shape: FlatShape {
                corner: corner.as_dvec3(),
                edges: edges.map(Vec3::as_dvec3),
                is_triangle: *is_triangle,
            },
            radiance: radiance.as_dvec3(),
        }),
        ListedLight::Sphere(light) => Light64::Sphere(SphericalLight64 {
            center: light.center.as_dvec3(),
            radius: light.radius.into(),
            radiance: light.radiance.as_dvec3(),
        }),
    }
}

/// Converts the flat lights in a list to double precision.
fn flat_lights(list: &LightList) -> impl Iterator<Item = FlatLight64> {
    list.lights.iter().filter_map(|light| double(light).flat())
}

/// Converts the spheres in a list to double precision.
fn spheres(list: &LightList) -> impl Iterator<Item = SphericalLight64> {
    list.lights
        .iter()
        .filter_map(|light| double(light).sphere())
}

/// Returns the sum of the lights' powers.
fn power(list: &LightList) -> f64 {
    list.lights.iter().map(|light| double(light).power()).sum()
}

impl<F: Function<Subject = LightList>> Aspect<Row<F>> {
    /// The aspects of a list of lights.
    const LIST: &'static [Self] = &[
        Aspect::new(
            "lights",
            &["none", "1", "2", "3 to 9", "10 to 49", "50 or more"],
            |row| Some(class_up_to(&[0, 1, 2, 9, 49], row.subject.lights.len())),
        ),
        Aspect::new(
            "kinds of lights",
            &["flat lights", "spheres", "both"],
            |row| {
                let (all, spheres) = (row.subject.lights.len(), spheres(&row.subject).count());
                (all > 0).then_some(match spheres {
                    0 => 0,
                    _ if spheres == all => 1,
                    _ => 2,
                })
            },
        ),
    ];
}
