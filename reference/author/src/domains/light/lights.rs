//! The domains of lights.

use glam::{DVec3, Vec3};
use protocol::function::Function;
use protocol::light::lights::{
    AreaLightPdf, FlatLight, LightList, LightSample, LightsPdf, LightsSample, ListedLight, Toward,
};

use super::fields::{LENGTHS, MAGNITUDES, SHARES, length_class, magnitude_class, share_class};
use super::{Row, rows_of};
use crate::domains::fields::{DIRECTIONS, OCTANTS, class_up_to, direction_class, octant};
use crate::domains::previous_call::NAME as ONLY_CHANGE;
use crate::domains::{Aspect, FunctionDomain, UntestedClasses, not_asked};
use crate::oracle::light::flat_shape::FlatShape;
use crate::oracle::light::lights::{FlatLight64, Light64};
use crate::oracle::light::spherical_light::SphericalLight64;

/// The domain of `AreaLight::pdf`.
pub static AREA_LIGHT_PDF: FunctionDomain<Row<AreaLightPdf>> = FunctionDomain {
    function: "AreaLight::pdf",
    subject_aspects: &[],
    aspects: &[
        Aspect::FORM,
        Aspect::SIDE,
        Aspect::DISTANCE,
        DISTANCE_IN_EDGES,
        Aspect::COSINE,
        Aspect::SEEN,
        Aspect::RAY_DIRECTION,
    ],
    pairs: &[["form of the light", "seen"]],
    fields: &["from", "direction", "lights"],
    calls: rows_of!(AreaLightPdf),
    not_asked: &[WITHIN_THE_SCENE],
};

/// The domain of `Lights::pdf`.
pub static LIGHTS_PDF: FunctionDomain<Row<LightsPdf>> = FunctionDomain {
    function: "Lights::pdf",
    subject_aspects: &[Aspect::COUNT, Aspect::KINDS],
    aspects: &[
        Aspect::FORM,
        Aspect::SIDE,
        Aspect::DISTANCE,
        Aspect::COSINE,
        Aspect::SEEN,
        Aspect::RAY_DIRECTION,
        LIGHTS_AHEAD,
        SHARE_AHEAD,
        ALIKE_AHEAD,
        SPHERE_AHEAD,
        SPHERE_AHEAD_RADIUS,
    ],
    pairs: &[],
    fields: &["from", "direction", "lights"],
    calls: rows_of!(LightsPdf),
    not_asked: &[WITHIN_THE_SCENE, NOT_THAT_SLANTED],
};

/// The domain of `Lights::sample`.
pub static LIGHTS_SAMPLE: FunctionDomain<Row<LightsSample>> = FunctionDomain {
    function: "Lights::sample",
    subject_aspects: &[Aspect::COUNT, Aspect::KINDS],
    aspects: &[
        Aspect::CHOICE,
        Aspect::RANDOM_X,
        Aspect::RANDOM_Y,
        PICKED,
        PICKED_KIND,
        PICKED_SHARE,
        PICKED_FORM,
        PICKED_SIDE,
        PICKED_RADIANCE,
        PICKED_COLOR,
        PICKED_DISTANCE,
        PICKED_COSINE,
        PICKED_OCTANT,
        PICKED_ALIKE,
        PICKED_SPHERE,
        PICKED_SPHERE_RADIUS,
        INSIDE,
        WITHOUT_POWER,
    ],
    pairs: &[
        ["kind of the picked light", "choice"],
        ["kind of the picked light", "random.x"],
        ["kind of the picked light", "random.y"],
    ],
    fields: &["from", "choice", "random", "lights"],
    calls: rows_of!(LightsSample),
    not_asked: &[
        WITHIN_THE_SCENE,
        not_asked(
            &["lights"],
            &["none"],
            &["some", "direction", "unit_direction"],
            "Without lights, there is no direction.",
        ),
        not_asked(
            &["cosine at the light"],
            COSINES.split_at(5).1,
            &["some", "direction", "unit_direction"],
            "Seen from behind, the light faces away.",
        ),
        not_asked(
            &["cosine at the light"],
            COSINES.split_at(5).0,
            &["`None`"],
            "Seen from the front, the light doesn't face away.",
        ),
        not_asked(
            &["kinds of lights"],
            &["spheres"],
            &["`None`"],
            "A sphere that is seen from outside never faces away.",
        ),
        not_asked(
            &["kind of the picked light"],
            &["sphere"],
            &["`None`"],
            "A sphere that is seen from outside never faces away.",
        ),
        not_asked(
            &["distance in radii"],
            OUTSIDE,
            &["`None`"],
            "A sphere that is seen from outside never faces away.",
        ),
        not_asked(
            &["distance in radii"],
            INSIDE_A_SPHERE,
            &["some", "direction", "unit_direction"],
            "From inside, there is no direction to a sphere.",
        ),
        not_asked(
            &["point"],
            INSIDE_THE_PICKED,
            &["some", "direction", "unit_direction"],
            "From inside, there is no direction to a sphere.",
        ),
        not_asked(
            &["share of the picked light"],
            SHARES.split_at(3).0,
            &[],
            "A light with so little power is only picked by numbers close to a border.",
        ),
        not_asked(
            &["shared with another light"],
            &[],
            &["`None`"],
            "Whether the picked light faces away doesn't depend on the other lights.",
        ),
        not_asked(
            &[ONLY_CHANGE],
            &["random", "lights"],
            &["`None`"],
            "An answer kept from other random numbers or lights is noticed where both exist.",
        ),
        not_asked(
            &["radiance of the picked light"],
            &["0"],
            &[],
            "A light without power is never picked.",
        ),
    ],
};

/// Classes that need no tests because scenes have coordinates up to 1,000.
const WITHIN_THE_SCENE: UntestedClasses = not_asked(
    &[
        "longer edge of the light",
        "longer edge of the picked light",
        "radius of the sphere",
    ],
    &["1000"],
    &[],
    "Scenes have coordinates up to 1,000, so hardly any light is this large.",
);

/// The cosines of directions almost in the light's plane.
const ALMOST_IN_ITS_PLANE: &[&str] = &[COSINES[4], COSINES[5]];

/// Classes that need no tests because only a single light parallel to the axes is seen from so
/// close to its plane.
const NOT_THAT_SLANTED: UntestedClasses = not_asked(
    &["cosine at the light"],
    ALMOST_IN_ITS_PLANE,
    &[],
    "Correct formulas lose too many digits, unless the light is parallel to two axes.",
);

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

/// Returns the class of a light's form. A rectangle is narrow if it is more than five times as long
/// as it is wide, and very narrow if it is more than a hundred times as long.
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
    let class = match cosine.abs() {
        0.99.. => 0,
        0.1.. => 1,
        0.02.. => 2,
        1e-3.. => 3,
        _ => 4,
    };
    if cosine > 0.0 {
        class
    } else {
        COSINES.len() - 1 - class
    }
}

/// The classes of positions at which a line crosses the plane of a light.
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
fn sights(list: &LightList, toward: &Toward) -> Vec<Sight> {
    let (from, direction) = (toward.from.as_dvec3(), toward.direction.as_dvec3());
    let lights = list.lights.iter().filter_map(flat);
    let sights = lights.filter_map(|light| {
        let hit = light.shape.intersect_plane(from, direction)?;
        let inset = inset(&light.shape, from + hit.distance * direction);
        let seen = match inset {
            _ if hit.distance < 0.0 => 5,
            0.25.. => 0,
            0.05.. => 1,
            0.0.. => 2,
            -0.1.. => 3,
            _ => 4,
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
fn main_sight(list: &LightList, toward: &Toward) -> Option<Sight> {
    let sights = sights(list, toward).into_iter();
    sights.min_by_key(|sight| (!sight.is_lit(), sight.seen))
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

/// Converts a flat light to double precision. Returns `None` for a sphere.
fn flat(light: &ListedLight) -> Option<FlatLight64> {
    match double(light) {
        Light64::Flat(light) => Some(light),
        Light64::Sphere(_) => None,
    }
}

impl<F: Function<Subject = LightList>> Aspect<Row<F>> {
    /// The number of lights.
    pub const COUNT: Self = Aspect {
        name: "lights",
        classes: &["none", "1", "2", "3 to 9", "10 to 49", "50 or more"],
        class: |row| {
            let count = row.subject.lights.len();
            Some(class_up_to(&[0, 1, 2, 9, 49], count))
        },
    };

    /// The kinds of lights in the list.
    pub const KINDS: Self = Aspect {
        name: "kinds of lights",
        classes: &["flat lights", "spheres", "both"],
        class: |row| {
            let lights = || row.subject.lights.iter();
            let spheres = lights().filter(|light| flat(light).is_none()).count();
            let all = lights().count();
            (all > 0).then_some(match spheres {
                0 => 0,
                _ if spheres == all => 1,
                _ => 2,
            })
        },
    };
}

impl<F: Function<Subject = LightList, Input = Toward>> Aspect<Row<F>> {
    /// The form of the light.
    pub const FORM: Self = Aspect {
        name: "form of the light",
        classes: FORMS,
        class: |row| Some(form_class(&main_sight(&row.subject, &row.input)?.light)),
    };

    /// The longer edge of the light.
    pub const SIDE: Self = Aspect {
        name: "longer edge of the light",
        classes: LENGTHS,
        class: |row| Some(side_class(&main_sight(&row.subject, &row.input)?.light)),
    };

    /// The distance of the light.
    pub const DISTANCE: Self = Aspect {
        name: "distance",
        classes: LENGTHS,
        class: |row| Some(length_class(main_sight(&row.subject, &row.input)?.distance)),
    };

    /// The cosine at the light.
    pub const COSINE: Self = Aspect {
        name: "cosine at the light",
        classes: COSINES,
        class: |row| Some(cosine_class(main_sight(&row.subject, &row.input)?.cosine)),
    };

    /// Where the direction crosses the plane of the light.
    pub const SEEN: Self = Aspect {
        name: "seen",
        classes: SEEN,
        class: |row| Some(main_sight(&row.subject, &row.input)?.seen),
    };

    /// The direction in the world.
    pub const RAY_DIRECTION: Self = Aspect {
        name: "direction",
        classes: DIRECTIONS,
        class: |row| direction_class(row.input.direction),
    };
}

/// The distance of the light, as a multiple of its longer edge.
const DISTANCE_IN_EDGES: Aspect<Row<AreaLightPdf>> = Aspect {
    name: "distance in edges",
    classes: &["below 0.05", "0.05 to 20", "20 to 300", "above 300"],
    class: |row| {
        let Sight {
            light, distance, ..
        } = main_sight(&row.subject, &row.input)?;
        Some(match distance / longer_edge(&light) {
            ..0.05 => 0,
            ..20.0 => 1,
            ..300.0 => 2,
            _ => 3,
        })
    },
};

/// The number of lights whose density is positive.
const LIGHTS_AHEAD: Aspect<Row<LightsPdf>> = Aspect {
    name: "lights ahead",
    classes: &["none", "1", "2", "3 to 8", "9 or more"],
    class: |row| {
        let sights = sights(&row.subject, &row.input);
        let lit = sights.iter().filter(|sight| sight.is_lit()).count();
        Some(class_up_to(&[0, 1, 2, 8], lit))
    },
};

/// The share of the light that is seen.
const SHARE_AHEAD: Aspect<Row<LightsPdf>> = Aspect {
    name: "share of the light",
    classes: SHARES,
    class: |row| {
        let sight = main_sight(&row.subject, &row.input).filter(Sight::is_lit)?;
        Some(share_class(sight.light.power() / power(&row.subject)))
    },
};

/// The classes of distances from the centre of a sphere.
const RADII: &[&str] = &[
    "below 1",
    "1 to 1.001",
    "1.001 to 1.05",
    "1.05 to 300",
    "above 300",
];

/// The distances outside a sphere.
const OUTSIDE: &[&str] = RADII.split_at(1).1;

/// The distance inside a sphere.
const INSIDE_A_SPHERE: &[&str] = &[RADII[0]];

/// Returns the class of a point's distance from the centre of a sphere, in radii.
fn radii_class(sphere: &SphericalLight64, point: Vec3) -> usize {
    let radii = point.as_dvec3().distance(sphere.center) / sphere.radius;
    let limits = [1.0, 1.001, 1.05, 300.0];
    limits.iter().filter(|limit| radii > **limit).count()
}

/// Converts the spheres in a list to double precision.
fn spheres(list: &LightList) -> impl Iterator<Item = SphericalLight64> {
    list.lights.iter().filter_map(|light| match double(light) {
        Light64::Sphere(light) => Some(light),
        Light64::Flat(_) => None,
    })
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

/// The distance of a sphere that has a density or that the point is inside of.
const SPHERE_AHEAD: Aspect<Row<LightsPdf>> = Aspect {
    name: "distance in radii",
    classes: RADII,
    class: |row| Some(radii_class(&sphere_ahead(row)?, row.input.from)),
};

/// The radius of that sphere.
const SPHERE_AHEAD_RADIUS: Aspect<Row<LightsPdf>> = Aspect {
    name: "radius of the sphere",
    classes: LENGTHS,
    class: |row| Some(length_class(sphere_ahead(row)?.radius)),
};

/// The classes of lights, by what they have in common with another light in the list.
const ALIKE: &[&str] = &[
    "everything",
    "the corner",
    "the power",
    "neither the corner nor the power",
];

/// Returns what a flat light has in common with another one in the list.
fn alike_class(list: &LightList, light: &FlatLight64) -> usize {
    let lights: Vec<FlatLight64> = list.lights.iter().filter_map(flat).collect();
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

/// A property that the light that is seen shares with another light.
const ALIKE_AHEAD: Aspect<Row<LightsPdf>> = Aspect {
    name: "shared with another light",
    classes: ALIKE,
    class: |row| {
        let sight = main_sight(&row.subject, &row.input).filter(Sight::is_lit)?;
        Some(alike_class(&row.subject, &sight.light))
    },
};

/// Returns the sum of the lights' powers.
fn power(list: &LightList) -> f64 {
    list.lights.iter().map(|light| double(light).power()).sum()
}

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

impl Pick {
    fn flat(&self) -> Option<FlatLight64> {
        match self.light {
            Light64::Flat(light) => Some(light),
            Light64::Sphere(_) => None,
        }
    }
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
        to_light: match light {
            Light64::Flat(light) => Some(light.point(random.as_dvec2()) - from.as_dvec3()),
            Light64::Sphere(_) => None,
        },
    })
}

/// The position of the picked light among the lights with power.
const PICKED: Aspect<Row<LightsSample>> = Aspect {
    name: "picked light",
    classes: &["the only one", "the first", "the last", "any other"],
    class: |row| Some(pick(row)?.place),
};

/// The kind of the picked light.
const PICKED_KIND: Aspect<Row<LightsSample>> = Aspect {
    name: "kind of the picked light",
    classes: &["flat", "sphere"],
    class: |row| Some(usize::from(pick(row)?.flat().is_none())),
};

/// The share of the picked light.
const PICKED_SHARE: Aspect<Row<LightsSample>> = Aspect {
    name: "share of the picked light",
    classes: SHARES,
    class: |row| Some(share_class(pick(row)?.share)),
};

/// The form of the picked light.
const PICKED_FORM: Aspect<Row<LightsSample>> = Aspect {
    name: "form of the picked light",
    classes: FORMS,
    class: |row| Some(form_class(&pick(row)?.flat()?)),
};

/// The longer edge of the picked light.
const PICKED_SIDE: Aspect<Row<LightsSample>> = Aspect {
    name: "longer edge of the picked light",
    classes: LENGTHS,
    class: |row| Some(side_class(&pick(row)?.flat()?)),
};

/// The radiance of the picked light in its brightest channel.
const PICKED_RADIANCE: Aspect<Row<LightsSample>> = Aspect {
    name: "radiance of the picked light",
    classes: MAGNITUDES,
    class: |row| {
        let radiance = match pick(row)?.light {
            Light64::Flat(light) => light.radiance,
            Light64::Sphere(light) => light.radiance,
        };
        Some(magnitude_class(radiance.max_element()))
    },
};

/// The colour of the picked light, classified by its number of channels.
const PICKED_COLOR: Aspect<Row<LightsSample>> = Aspect {
    name: "channels of the picked light",
    classes: &["1", "2", "3"],
    class: |row| {
        let radiance = match pick(row)?.light {
            Light64::Flat(light) => light.radiance,
            Light64::Sphere(light) => light.radiance,
        };
        let channels = radiance.cmpgt(DVec3::ZERO).bitmask().count_ones();
        (channels as usize).checked_sub(1)
    },
};

/// The distance of the point on the picked light.
const PICKED_DISTANCE: Aspect<Row<LightsSample>> = Aspect {
    name: "distance",
    classes: LENGTHS,
    class: |row| Some(length_class(pick(row)?.to_light?.length())),
};

/// The cosine at the picked light.
const PICKED_COSINE: Aspect<Row<LightsSample>> = Aspect {
    name: "cosine at the light",
    classes: COSINES,
    class: |row| {
        let pick = pick(row)?;
        let normal = pick.flat()?.shape.normal();
        Some(cosine_class(-pick.to_light?.normalize().dot(normal)))
    },
};

/// The octant of the direction to the point on the picked light.
const PICKED_OCTANT: Aspect<Row<LightsSample>> = Aspect {
    name: "octant",
    classes: OCTANTS,
    class: |row| octant(pick(row)?.to_light?),
};

/// The distance of the picked sphere.
const PICKED_SPHERE: Aspect<Row<LightsSample>> = Aspect {
    name: "distance in radii",
    classes: RADII,
    class: |row| match pick(row)?.light {
        Light64::Sphere(light) => Some(radii_class(&light, row.input.from)),
        Light64::Flat(_) => None,
    },
};

/// The radius of the picked sphere.
const PICKED_SPHERE_RADIUS: Aspect<Row<LightsSample>> = Aspect {
    name: "radius of the sphere",
    classes: LENGTHS,
    class: |row| match pick(row)?.light {
        Light64::Sphere(light) => Some(length_class(light.radius)),
        Light64::Flat(_) => None,
    },
};

/// A property that the picked light shares with another light.
const PICKED_ALIKE: Aspect<Row<LightsSample>> = Aspect {
    name: "shared with another light",
    classes: ALIKE,
    class: |row| Some(alike_class(&row.subject, &pick(row)?.flat()?)),
};

/// The classes of points, by whether they are inside a sphere.
const POINTS: &[&str] = &[
    "outside all spheres",
    "inside the picked sphere",
    "inside a sphere that isn't picked",
];

/// The points that the picked light doesn't emit to.
const INSIDE_THE_PICKED: &[&str] = &[POINTS[1]];

/// Whether the point is inside a sphere.
const INSIDE: Aspect<Row<LightsSample>> = Aspect {
    name: "point",
    classes: POINTS,
    class: |row| {
        let is_inside = |light: &SphericalLight64| radii_class(light, row.input.from) == 0;
        let is_inside_picked = match pick(row)?.light {
            Light64::Sphere(light) => is_inside(&light),
            Light64::Flat(_) => false,
        };
        Some(match spheres(&row.subject).any(|light| is_inside(&light)) {
            _ if is_inside_picked => 1,
            true => 2,
            false => 0,
        })
    },
};

/// Whether the list contains lights without power.
const WITHOUT_POWER: Aspect<Row<LightsSample>> = Aspect {
    name: "lights without power",
    classes: &["the first", "another one", "none"],
    class: |row| {
        let lights = row.subject.lights.iter().map(double);
        let dark: Vec<bool> = lights.map(|light| light.power() == 0.0).collect();
        Some(match dark.iter().position(|is_dark| *is_dark) {
            Some(0) => 0,
            Some(_) => 1,
            None => 2,
        })
    },
};
