//! The domains of materials: matte surfaces, mirrors and glass.

use glam::Vec3;
use protocol::function::Function;
use protocol::light::lambertian::{DirectionPair, Evaluate, Matte, Pdf, Scatter};
use protocol::light::specular::{
    Fresnel, GlassScatter, Medium, MirrorColor, MirrorScatter, Reflect, Refract,
};

use super::fields::{
    ALONG, AZIMUTHS, CHANNELS, COLORS, CONTRASTS, HEIGHTS, INDICES, NOT_ABOVE, azimuth_class,
    channel_class, color_class, contrast_class, height_class, index_class,
};
use super::{Outgoing, Row, rows_of};
use crate::domains::previous_call::NAME as ONLY_CHANGE;
use crate::domains::{Aspect, FunctionDomain, UntestedClasses, not_asked};
use crate::oracle::light::specular;

/// The domain of `Lambertian::evaluate`.
pub static MATTE_EVALUATE: FunctionDomain<Row<Evaluate>> = FunctionDomain {
    aspects: &[Aspect::COLORS, Aspect::OUT, Aspect::INCOMING],
    fields: &["out", "incoming", "albedo"],
    ..FunctionDomain::new("Lambertian::evaluate", rows_of!(Evaluate))
};

/// The domain of `Lambertian::pdf`.
pub static MATTE_PDF: FunctionDomain<Row<Pdf>> = FunctionDomain {
    aspects: &[Aspect::COLORS, Aspect::OUT, Aspect::INCOMING],
    fields: &["out", "incoming"],
    ..FunctionDomain::new("Lambertian::pdf", rows_of!(LambertianPdf))
};

/// The domain of `Lambertian::scatter`.
pub static MATTE_SCATTER: FunctionDomain<Row<Scatter>> = FunctionDomain {
    aspects: &[Aspect::COLORS, Aspect::OUT, Aspect::RANDOM],
    pairs: &[["random.x", "random.y"]],
    fields: &["random", "albedo"],
    not_asked: &[
        FROM_ABOVE,
        not_asked(&[ONLY_CHANGE])
            .classes(&["random"])
            .columns(&["attenuation"])
            .because("The attenuation doesn't depend on the random numbers."),
        not_asked(&[ONLY_CHANGE])
            .classes(&["albedo"])
            .columns(&["direction", "unit_direction", "pdf"])
            .because("Only the attenuation depends on the albedo."),
    ],
    ..FunctionDomain::new("Lambertian::scatter", rows_of!(LambertianScatter))
};

/// The domain of `reflect`.
pub static REFLECTION: FunctionDomain<Row<Reflect>> = FunctionDomain {
    aspects: &[Aspect::OUT],
    fields: &["direction"],
    not_asked: &[not_asked(&["first call"]).because("The function has no subject.")],
    ..FunctionDomain::new("reflect", rows_of!(Reflect))
};

/// The domain of `refract`.
pub static REFRACTED: FunctionDomain<Row<Refract>> = FunctionDomain {
    aspects: &[Aspect::OUT, Aspect::REFRACTION],
    fields: &["direction", "ior"],
    not_asked: &[
        NEVER_ALONG,
        NEVER_THROUGH,
        not_asked(&["index, from outside"])
            .classes(INDICES.split_at(4).1)
            .columns(&["`None`"])
            .because("There is no total reflection outside a medium with this index."),
        not_asked(&["index, from inside"])
            .classes(INDICES.split_at(5).0)
            .columns(&["`None`"])
            .because("There is no total reflection inside a medium with this index."),
        not_asked(&["out"])
            .classes(NEAR_THE_NORMAL)
            .columns(&["`None`"])
            .because("There is no total reflection so close to the normal, up to an index of 10."),
        not_asked(&["passage", "critical angle"])
            .classes(THROUGH)
            .columns(&["`None`"])
            .because("The path is refracted."),
        not_asked(&[ONLY_CHANGE])
            .classes(&["ior"])
            .columns(&["`None`"])
            .because("An answer kept from another medium is noticed where both refract."),
    ],
    ..FunctionDomain::new("refract", rows_of!(Refract))
};

/// The domain of `fresnel`.
pub static REFLECTED_FRACTION: FunctionDomain<Row<Fresnel>> = FunctionDomain {
    aspects: &[Aspect::OUT, Aspect::REFRACTION],
    fields: &["direction", "ior"],
    not_asked: &[NEVER_ALONG],
    ..FunctionDomain::new("fresnel", rows_of!(Fresnel))
};

/// The domain of `Mirror::scatter`.
pub static MIRROR_SCATTER: FunctionDomain<Row<MirrorScatter>> = FunctionDomain {
    aspects: &[Aspect::COLORS, Aspect::OUT],
    fields: &["direction", "reflectance"],
    not_asked: &[FROM_ABOVE],
    ..FunctionDomain::new("Mirror::scatter", rows_of!(MirrorScatter))
};

/// The domain of `Glass::scatter`.
pub static GLASS_SCATTER: FunctionDomain<Row<GlassScatter>> = FunctionDomain {
    aspects: &[Aspect::OUT, Aspect::REFRACTION, CHOICE_ASPECTS],
    fields: &["out", "random", "ior"],
    not_asked: &[NEVER_ALONG],
    ..FunctionDomain::new("Glass::scatter", rows_of!(GlassScatter))
};

/// The aspects of the choice between reflection and refraction.
const CHOICE_ASPECTS: &[Aspect<Row<GlassScatter>>] = &[
    Aspect::CHOICE,
    // How the random number compares with the fraction of light that glass reflects.
    Aspect::new(
        "choice and fraction",
        &[
            "far below",
            "just below",
            "just above",
            "far above",
            "the fraction is 1",
            "the fraction is 0",
            "below a fraction of less than 2e-3",
            "below a fraction of less than 2e-5",
            "both are 0",
            "above a fraction of more than 0.99",
            "both are more than 0.998, and the number is less",
        ],
        |row| {
            let (out, ior) = (row.input.out.as_dvec3(), f64::from(row.subject.ior));
            let fraction = specular::fresnel(out, ior);
            let above = f64::from(row.input.random) - fraction;
            Some(match above {
                _ if fraction == 1.0 => 4,
                0.0 if ior == 1.0 => 8,
                _ if ior == 1.0 => 5,
                ..0.0 if fraction < 2e-5 => 7,
                ..0.0 if fraction < 2e-3 => 6,
                ..0.0 if row.input.random > 0.998 => 10,
                0.0.. if fraction > 0.99 => 9,
                ..-0.03 => 0,
                ..0.0 => 1,
                ..0.03 => 2,
                _ => 3,
            })
        },
    ),
];

/// Directions that are never totally reflected.
const NEAR_THE_NORMAL: &[&str] = &[HEIGHTS[0], HEIGHTS[1], HEIGHTS[11], HEIGHTS[12]];
/// Paths that are refracted.
const THROUGH: &[&str] = &[
    PASSAGES[0],
    PASSAGES[1],
    PASSAGES[3],
    PASSAGES[4],
    PASSAGES[6],
    PASSAGES[7],
    CRITICAL_CLASSES[0],
];
/// Paths that are totally reflected.
const REFLECTED: &[&str] = &[PASSAGES[2], PASSAGES[5], CRITICAL_CLASSES[1]];

/// Classes that need no tests because, for most materials, the normal is on the side of `out`.
const FROM_ABOVE: UntestedClasses = not_asked(&["out"])
    .classes(NOT_ABOVE)
    .because("The normal of a matte surface or a mirror is on the same side as `out`.");

/// Classes that need no tests because the contract excludes directions along a surface that
/// refracts.
const NEVER_ALONG: UntestedClasses = not_asked(&["out"])
    .classes(ALONG)
    .because("The contract excludes directions along the surface.");

/// Classes that need no tests because, beyond the critical angle, there is no refracted direction.
const NEVER_THROUGH: UntestedClasses = not_asked(&["passage", "critical angle"])
    .classes(REFLECTED)
    .columns(&["some", "direction", "unit_direction"])
    .because("The path is totally reflected.");

/// A material with a colour.
pub trait Colored {
    /// Returns the fraction of light that is scattered, for each channel.
    fn color(&self) -> Vec3;
}

impl Colored for Matte {
    fn color(&self) -> Vec3 {
        self.albedo
    }
}

impl Colored for MirrorColor {
    fn color(&self) -> Vec3 {
        self.reflectance
    }
}

impl<F: Function<Subject: Colored>> Aspect<Row<F>> {
    /// The aspects of the material's colour.
    const COLORS: &'static [Self] = &[
        Aspect::new("red", CHANNELS, |row| {
            Some(channel_class(row.subject.color().x))
        }),
        Aspect::new("green", CHANNELS, |row| {
            Some(channel_class(row.subject.color().y))
        }),
        Aspect::new("blue", CHANNELS, |row| {
            Some(channel_class(row.subject.color().z))
        }),
        Aspect::new("colour", COLORS, |row| {
            Some(color_class(row.subject.color()))
        }),
        Aspect::new("brightest channel", CHANNELS, |row| {
            Some(channel_class(row.subject.color().max_element()))
        }),
        Aspect::new("dimmest over brightest channel", CONTRASTS, |row| {
            contrast_class(row.subject.color())
        }),
    ];
}

impl<F: Function<Input = DirectionPair>> Aspect<Row<F>> {
    /// The aspects of `incoming`, alone and together with `out`.
    const INCOMING: &'static [Self] = &[
        // The angle between `incoming` and the surface.
        Aspect::new("incoming", HEIGHTS, |row| {
            Some(height_class(row.input.incoming))
        }),
        Aspect::new("azimuth of incoming", AZIMUTHS, |row| {
            azimuth_class(row.input.incoming)
        }),
        // How the two directions are related.
        Aspect::new(
            "both directions",
            &[
                "are the same",
                "are opposite",
                "are mirror images about the normal",
                "are mirror images about the surface",
                "are both above",
                "are on two sides",
                "are both below",
                "both graze the surface",
            ],
            |row| {
                let DirectionPair { out, incoming } = row.input;
                let heights = [out.z, incoming.z];
                Some(match out {
                    _ if out == incoming => 0,
                    _ if out == -incoming => 1,
                    _ if out == incoming * Vec3::new(-1.0, -1.0, 1.0) => 2,
                    _ if out == incoming * Vec3::new(1.0, 1.0, -1.0) => 3,
                    _ if heights.iter().all(|height| (1e-30..0.1).contains(height)) => 7,
                    _ if heights.iter().all(|height| *height > 0.0) => 4,
                    _ if heights.iter().all(|height| *height < 0.0) => 6,
                    _ => 5,
                })
            },
        ),
    ];
}

/// How a path crosses the surface of a medium.
const PASSAGES: &[&str] = &[
    "enters a denser medium",
    "leaves a denser medium",
    "is totally reflected inside",
    "enters a thinner medium",
    "leaves a thinner medium",
    "is totally reflected outside",
    "enters an index of 1",
    "leaves an index of 1",
];

/// The classes of angles close to the critical angle.
const CRITICAL_CLASSES: &[&str] = &["just refracted", "just totally reflected"];

impl<F: Function<Subject = Medium, Input: Outgoing>> Aspect<Row<F>> {
    /// The aspects of a path at the surface of a medium.
    const REFRACTION: &'static [Self] = &[
        // The index of refraction, if the path is outside.
        Aspect::new("index, from outside", INDICES, |row| {
            (row.input.out().z > 0.0).then(|| index_class(row.subject.ior))
        }),
        // The index of refraction, if the path is inside.
        Aspect::new("index, from inside", INDICES, |row| {
            (row.input.out().z < 0.0).then(|| index_class(row.subject.ior))
        }),
        // How the path crosses the surface.
        Aspect::new("passage", PASSAGES, |row| {
            let (out, ior) = (row.input.out().as_dvec3(), f64::from(row.subject.ior));
            let leaves = usize::from(out.z < 0.0);
            Some(match specular::refract(out, ior) {
                _ if ior == 1.0 => 6 + leaves,
                None => 5 - 3 * leaves,
                Some(_) if ior > 1.0 => leaves,
                Some(_) => 3 + leaves,
            })
        }),
        // On which side of the critical angle the path is, if it is close to that angle.
        Aspect::new("critical angle", CRITICAL_CLASSES, |row| {
            let (out, ior) = (row.input.out().as_dvec3(), f64::from(row.subject.ior));
            let is_close = specular::critical_margin(out, ior) < 0.06;
            is_close.then(|| usize::from(specular::refract(out, ior).is_none()))
        }),
    ];
}
