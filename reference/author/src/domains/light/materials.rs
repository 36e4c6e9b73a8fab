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
    function: "Lambertian::evaluate",
    subject_aspects: Aspect::COLORS,
    aspects: Aspect::DIRECTIONS,
    pairs: &[],
    fields: &["out", "incoming", "albedo"],
    calls: rows_of!(Evaluate),
    not_asked: &[],
};

/// The domain of `Lambertian::pdf`.
pub static MATTE_PDF: FunctionDomain<Row<Pdf>> = FunctionDomain {
    function: "Lambertian::pdf",
    subject_aspects: Aspect::COLORS,
    aspects: Aspect::DIRECTIONS,
    pairs: &[],
    fields: &["out", "incoming"],
    calls: rows_of!(LambertianPdf),
    not_asked: &[],
};

/// The domain of `Lambertian::scatter`.
pub static MATTE_SCATTER: FunctionDomain<Row<Scatter>> = FunctionDomain {
    function: "Lambertian::scatter",
    subject_aspects: Aspect::COLORS,
    aspects: &[
        Aspect::OUT,
        Aspect::OUT_AZIMUTH,
        Aspect::RANDOM_X,
        Aspect::RANDOM_Y,
    ],
    pairs: &[["random.x", "random.y"]],
    fields: &["random", "albedo"],
    calls: rows_of!(LambertianScatter),
    not_asked: &[
        FROM_ABOVE,
        not_asked(
            &[ONLY_CHANGE],
            &["random"],
            &["attenuation"],
            "The attenuation doesn't depend on the random numbers.",
        ),
        not_asked(
            &[ONLY_CHANGE],
            &["albedo"],
            &["direction", "unit_direction", "pdf"],
            "Only the attenuation depends on the albedo.",
        ),
    ],
};

/// The domain of `reflect`.
pub static REFLECTION: FunctionDomain<Row<Reflect>> = FunctionDomain {
    function: "reflect",
    subject_aspects: &[],
    aspects: &[Aspect::OUT, Aspect::OUT_AZIMUTH],
    pairs: &[],
    fields: &["direction"],
    calls: rows_of!(Reflect),
    not_asked: &[not_asked(
        &["first call"],
        &[],
        &[],
        "The function has no subject.",
    )],
};

/// The domain of `refract`.
pub static REFRACTED: FunctionDomain<Row<Refract>> = FunctionDomain {
    function: "refract",
    subject_aspects: &[],
    aspects: Aspect::REFRACTION,
    pairs: &[],
    fields: &["direction", "ior"],
    calls: rows_of!(Refract),
    not_asked: &[
        NEVER_ALONG,
        NEVER_THROUGH,
        not_asked(
            &["index, from outside"],
            INDICES.split_at(4).1,
            &["`None`"],
            "There is no total reflection outside a medium with this index.",
        ),
        not_asked(
            &["index, from inside"],
            INDICES.split_at(5).0,
            &["`None`"],
            "There is no total reflection inside a medium with this index.",
        ),
        not_asked(
            &["out"],
            NEAR_THE_NORMAL,
            &["`None`"],
            "There is no total reflection so close to the normal, up to an index of 10.",
        ),
        not_asked(
            &["passage", "critical angle"],
            THROUGH,
            &["`None`"],
            "The path is refracted.",
        ),
        not_asked(
            &[ONLY_CHANGE],
            &["ior"],
            &["`None`"],
            "An answer kept from another medium is noticed where both refract.",
        ),
    ],
};

/// The domain of `fresnel`.
pub static REFLECTED_FRACTION: FunctionDomain<Row<Fresnel>> = FunctionDomain {
    function: "fresnel",
    subject_aspects: &[],
    aspects: Aspect::REFRACTION,
    pairs: &[],
    fields: &["direction", "ior"],
    calls: rows_of!(Fresnel),
    not_asked: &[NEVER_ALONG],
};

/// The domain of `Mirror::scatter`.
pub static MIRROR_SCATTER: FunctionDomain<Row<MirrorScatter>> = FunctionDomain {
    function: "Mirror::scatter",
    subject_aspects: Aspect::COLORS,
    aspects: &[Aspect::OUT, Aspect::OUT_AZIMUTH],
    pairs: &[],
    fields: &["direction", "reflectance"],
    calls: rows_of!(MirrorScatter),
    not_asked: &[FROM_ABOVE],
};

/// The domain of `Glass::scatter`.
pub static GLASS_SCATTER: FunctionDomain<Row<GlassScatter>> = FunctionDomain {
    function: "Glass::scatter",
    subject_aspects: &[],
    aspects: &[
        Aspect::OUT,
        Aspect::OUT_AZIMUTH,
        Aspect::INDEX_OUTSIDE,
        Aspect::INDEX_INSIDE,
        Aspect::PASSAGE,
        Aspect::CRITICAL,
        Aspect::CHOICE,
        BESIDE_THE_FRACTION,
    ],
    pairs: &[],
    fields: &["out", "random", "ior"],
    calls: rows_of!(GlassScatter),
    not_asked: &[NEVER_ALONG],
};

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
const FROM_ABOVE: UntestedClasses = not_asked(
    &["out"],
    NOT_ABOVE,
    &[],
    "The normal of a matte surface or a mirror is on the same side as `out`.",
);

/// Classes that need no tests because the contract excludes directions along a surface that
/// refracts.
const NEVER_ALONG: UntestedClasses = not_asked(
    &["out"],
    ALONG,
    &[],
    "The contract excludes directions along the surface.",
);

/// Classes that need no tests because, beyond the critical angle, there is no refracted direction.
const NEVER_THROUGH: UntestedClasses = not_asked(
    &["passage", "critical angle"],
    REFLECTED,
    &["some", "direction", "unit_direction"],
    "The path is totally reflected.",
);

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
    /// The red channel of the material's colour.
    pub const RED: Self = Aspect {
        name: "red",
        classes: CHANNELS,
        class: |row| Some(channel_class(row.subject.color().x)),
    };

    /// The green channel of the material's colour.
    pub const GREEN: Self = Aspect {
        name: "green",
        classes: CHANNELS,
        class: |row| Some(channel_class(row.subject.color().y)),
    };

    /// The blue channel of the material's colour.
    pub const BLUE: Self = Aspect {
        name: "blue",
        classes: CHANNELS,
        class: |row| Some(channel_class(row.subject.color().z)),
    };

    /// The material's colour as a whole.
    pub const COLOR: Self = Aspect {
        name: "colour",
        classes: COLORS,
        class: |row| Some(color_class(row.subject.color())),
    };

    /// The brightest channel of the material's colour.
    pub const BRIGHTEST: Self = Aspect {
        name: "brightest channel",
        classes: CHANNELS,
        class: |row| Some(channel_class(row.subject.color().max_element())),
    };

    /// The contrast between the channels of the material's colour.
    pub const CONTRAST: Self = Aspect {
        name: "dimmest over brightest channel",
        classes: CONTRASTS,
        class: |row| contrast_class(row.subject.color()),
    };

    /// All aspects of the material's colour.
    const COLORS: &'static [Self] = &[
        Self::RED,
        Self::GREEN,
        Self::BLUE,
        Self::COLOR,
        Self::BRIGHTEST,
        Self::CONTRAST,
    ];
}

impl<F: Function<Input = DirectionPair>> Aspect<Row<F>> {
    /// The angle between `incoming` and the surface.
    pub const INCOMING: Self = Aspect {
        name: "incoming",
        classes: HEIGHTS,
        class: |row| Some(height_class(row.input.incoming)),
    };

    /// The azimuth of `incoming`.
    pub const INCOMING_AZIMUTH: Self = Aspect {
        name: "azimuth of incoming",
        classes: AZIMUTHS,
        class: |row| azimuth_class(row.input.incoming),
    };

    /// How the two directions are related.
    pub const RELATION: Self = Aspect {
        name: "both directions",
        classes: &[
            "are the same",
            "are opposite",
            "are mirror images about the normal",
            "are mirror images about the surface",
            "are both above",
            "are on two sides",
            "are both below",
            "both graze the surface",
        ],
        class: |row| {
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
    };

    /// All aspects of the two directions.
    const DIRECTIONS: &'static [Self] = &[
        Self::OUT,
        Self::OUT_AZIMUTH,
        Self::INCOMING,
        Self::INCOMING_AZIMUTH,
        Self::RELATION,
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
    /// The index of refraction, if the path is outside.
    pub const INDEX_OUTSIDE: Self = Aspect {
        name: "index, from outside",
        classes: INDICES,
        class: |row| (row.input.out().z > 0.0).then(|| index_class(row.subject.ior)),
    };

    /// The index of refraction, if the path is inside.
    pub const INDEX_INSIDE: Self = Aspect {
        name: "index, from inside",
        classes: INDICES,
        class: |row| (row.input.out().z < 0.0).then(|| index_class(row.subject.ior)),
    };

    /// How the path crosses the surface.
    pub const PASSAGE: Self = Aspect {
        name: "passage",
        classes: PASSAGES,
        class: |row| {
            let (out, ior) = (row.input.out().as_dvec3(), f64::from(row.subject.ior));
            let leaves = usize::from(out.z < 0.0);
            Some(match specular::refract(out, ior) {
                _ if ior == 1.0 => 6 + leaves,
                None => 5 - 3 * leaves,
                Some(_) if ior > 1.0 => leaves,
                Some(_) => 3 + leaves,
            })
        },
    };

    /// On which side of the critical angle the path is, if it is close to that angle.
    pub const CRITICAL: Self = Aspect {
        name: "critical angle",
        classes: CRITICAL_CLASSES,
        class: |row| {
            let (out, ior) = (row.input.out().as_dvec3(), f64::from(row.subject.ior));
            let is_close = specular::critical_margin(out, ior) < 0.06;
            is_close.then(|| usize::from(specular::refract(out, ior).is_none()))
        },
    };

    /// All aspects of a path at the surface of a medium.
    const REFRACTION: &'static [Self] = &[
        Self::OUT,
        Self::OUT_AZIMUTH,
        Self::INDEX_OUTSIDE,
        Self::INDEX_INSIDE,
        Self::PASSAGE,
        Self::CRITICAL,
    ];
}

/// How the random number compares with the fraction of light that glass reflects.
const BESIDE_THE_FRACTION: Aspect<Row<GlassScatter>> = Aspect {
    name: "choice and fraction",
    classes: &[
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
    class: |row| {
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
};
