//! The domains of environment maps.

use glam::{DVec3, UVec2, Vec3};
use protocol::function::{Function, LocalDirection};
use protocol::light::environment::{
    EnvironmentPdf, EnvironmentSample, MapImage, MapSample, UniformSphere,
};

use super::fields::{
    AZIMUTHS, COLORS, MAGNITUDES, NUMBERS, SHARES, azimuth_class, color_class, magnitude_class,
    share_class,
};
use super::{Row, rows_of};
use crate::domains::fields::class_up_to;
use crate::domains::{Aspect, FunctionDomain, not_asked};
use crate::oracle::light::environment::Map64;
use crate::oracle::light::luminance;

/// The domain of `uniform_sphere`.
pub static UNIFORM_SPHERE: FunctionDomain<Row<UniformSphere>> = FunctionDomain {
    function: "uniform_sphere",
    subject_aspects: &[],
    aspects: &[Aspect::RANDOM_X, Aspect::RANDOM_Y],
    pairs: &[["random.x", "random.y"]],
    fields: &[],
    calls: rows_of!(UniformSphere),
    not_asked: &[
        not_asked(&["first call"], &[], &[], "The function has no subject."),
        not_asked(
            &["random.x", "random.y"],
            EXACT_NUMBERS,
            &["evenness"],
            "Evenly distributed numbers hardly ever have this exact value.",
        ),
    ],
};

/// The domain of `Environment::sample`.
pub static MAP_SAMPLE: FunctionDomain<Row<EnvironmentSample>> = FunctionDomain {
    function: "Environment::sample",
    subject_aspects: &[Aspect::MAP_SIZE, Aspect::BLACK, Aspect::PEAK, Aspect::TOTAL],
    aspects: &[
        Aspect::PIXEL_ROW,
        Aspect::PIXEL_COLUMN,
        Aspect::PIXEL_SHARE,
        Aspect::PIXEL_COLOR,
        Aspect::PIXEL_RADIANCE,
        Aspect::CHOICE,
        Aspect::RANDOM_X,
        Aspect::RANDOM_Y,
    ],
    pairs: &[],
    fields: &["choice", "random", "map"],
    calls: rows_of!(EnvironmentSample),
    not_asked: &[
        not_asked(
            &["share", "colour", "radiance"],
            &["0", "black"],
            &[],
            "A black pixel is never picked.",
        ),
        not_asked(
            &["share"],
            NEVER_PICKED,
            &[],
            "A pixel with so small a share is only picked by numbers close to a border.",
        ),
        not_asked(
            &["black pixels"],
            &["all"],
            &[],
            "The contract excludes samples of a black map.",
        ),
    ],
};

/// The domain of `Environment::pdf`.
pub static MAP_PDF: FunctionDomain<Row<EnvironmentPdf>> = FunctionDomain {
    function: "Environment::pdf",
    subject_aspects: &[Aspect::MAP_SIZE, Aspect::BLACK, Aspect::PEAK, Aspect::TOTAL],
    aspects: &[
        Aspect::PIXEL_ROW,
        Aspect::PIXEL_COLUMN,
        Aspect::PIXEL_SHARE,
        Aspect::PIXEL_COLOR,
        Aspect::PIXEL_RADIANCE,
        DENSITY,
        SINE,
        LONGITUDE,
    ],
    pairs: &[],
    fields: &["direction", "map"],
    calls: rows_of!(EnvironmentPdf),
    not_asked: &[not_asked(
        &["longitude"],
        SEAMS,
        &[],
        "In every map, this is at the edge of a pixel, which the contract excludes.",
    )],
};

/// The classes of random numbers that consist of a single number.
const EXACT_NUMBERS: &[&str] = &[NUMBERS[0], NUMBERS[3], NUMBERS[6]];

/// The shares that are too small for a random number to pick.
const NEVER_PICKED: &[&str] = &[SHARES[1]];

/// The longitudes where every map has an edge between two columns.
const SEAMS: &[&str] = &[AZIMUTHS[0], AZIMUTHS[2]];

/// The arguments of a function about a pixel of a map.
trait OnMap {
    /// Returns the index of the pixel.
    fn pixel(&self, map: &Map64) -> usize;
}

impl OnMap for MapSample {
    fn pixel(&self, map: &Map64) -> usize {
        picked(map, self.choice)
    }
}

impl OnMap for LocalDirection {
    fn pixel(&self, map: &Map64) -> usize {
        map.index(self.direction.as_dvec3()).value
    }
}

/// Returns the index of the pixel that a random number picks.
pub fn picked(map: &Map64, choice: f32) -> usize {
    let mut rest = f64::from(choice);
    let picked = map.shares().iter().position(|share| {
        rest -= share;
        rest < 0.0
    });
    let is_bright = |share: &f64| *share > 0.0;
    let last = || map.shares().iter().rposition(is_bright);
    picked.or_else(last).unwrap_or_default()
}

/// A pixel of a map.
struct Pixel {
    /// The column and the row.
    position: UVec2,
    share: f64,
    radiance: Vec3,
}

/// Returns the pixel that a call is about.
fn pixel<F: Function<Subject = MapImage, Input: OnMap>>(row: &Row<F>) -> Pixel {
    let MapImage { size, pixels } = &*row.subject;
    let map = Map64::new(*size, pixels);
    let index = row.input.pixel(&map);
    let [column, line] = [index as u32 % size.x, index as u32 / size.x];
    Pixel {
        position: UVec2::new(column, line),
        share: map.shares()[index],
        radiance: pixels[index],
    }
}

#[expect(private_bounds, reason = "only the aspects are public")]
impl<F: Function<Subject = MapImage, Input: OnMap>> Aspect<Row<F>> {
    /// The size of the map.
    pub const MAP_SIZE: Self = Aspect {
        name: "map",
        classes: &["2 × 1", "4 × 2", "up to 16 × 8", "up to 64 × 32", "larger"],
        class: |row| Some(class_up_to(&[2, 4, 16, 64], row.subject.size.x as usize)),
    };

    /// How many pixels are black.
    pub const BLACK: Self = Aspect {
        name: "black pixels",
        classes: &["none", "some", "most", "all but one", "all"],
        class: |row| {
            let pixels = &row.subject.pixels;
            let black = pixels.iter().filter(|pixel| **pixel == Vec3::ZERO).count();
            Some(match black {
                0 => 0,
                _ if black == pixels.len() => 4,
                _ if black + 1 == pixels.len() => 3,
                _ if 2 * black > pixels.len() => 2,
                _ => 1,
            })
        },
    };

    /// The luminance of the brightest pixel, divided by the mean.
    pub const PEAK: Self = Aspect {
        name: "brightest pixel over the mean",
        classes: &["up to 10", "up to 1,000", "beyond"],
        class: |row| {
            let pixels = row.subject.pixels.iter();
            let luminances: Vec<f64> = pixels.map(|it| luminance(it.as_dvec3())).collect();
            let sum: f64 = luminances.iter().sum();
            let brightest = luminances.iter().copied().fold(0.0, f64::max);
            let ratio = brightest * luminances.len() as f64 / sum;
            (sum > 0.0).then(|| [10.0, 1e3].iter().filter(|limit| ratio > **limit).count())
        },
    };

    /// The sum of the pixels' luminances.
    pub const TOTAL: Self = Aspect {
        name: "sum of the luminances",
        classes: &["below 1e-7", "below 1", "below 1,000", "more"],
        class: |row| {
            let pixels = row.subject.pixels.iter();
            let sum: f64 = pixels.map(|it| luminance(it.as_dvec3())).sum();
            let limits = [1e-7, 1.0, 1e3];
            (sum > 0.0).then(|| limits.iter().filter(|limit| sum >= **limit).count())
        },
    };

    /// The pixel's row.
    pub const PIXEL_ROW: Self = Aspect {
        name: "row",
        classes: &["the only one", "the top one", "the bottom one", "any other"],
        class: |row| Some(place_class(pixel(row).position.y, row.subject.size.y)),
    };

    /// The pixel's column.
    pub const PIXEL_COLUMN: Self = Aspect {
        name: "column",
        classes: &["the first", "the last", "any other"],
        class: |row| Some(place_class(pixel(row).position.x, row.subject.size.x) - 1),
    };

    /// The pixel's share.
    pub const PIXEL_SHARE: Self = Aspect {
        name: "share",
        classes: SHARES,
        class: |row| Some(share_class(pixel(row).share)),
    };

    /// The pixel's colour.
    pub const PIXEL_COLOR: Self = Aspect {
        name: "colour",
        classes: COLORS,
        class: |row| Some(color_class(pixel(row).radiance)),
    };

    /// The pixel's radiance in its brightest channel.
    pub const PIXEL_RADIANCE: Self = Aspect {
        name: "radiance",
        classes: MAGNITUDES,
        class: |row| Some(magnitude_class(pixel(row).radiance.max_element().into())),
    };
}

/// Returns the class of an index among `count` rows or columns: the only one, the first, the last or
/// any other.
fn place_class(index: u32, count: u32) -> usize {
    match index {
        0 if count == 1 => 0,
        0 => 1,
        _ if index + 1 == count => 2,
        _ => 3,
    }
}

/// The density of the direction.
const DENSITY: Aspect<Row<EnvironmentPdf>> = Aspect {
    name: "density",
    classes: &[
        "0",
        "below 0.1",
        "0.1",
        "1",
        "10",
        "100",
        "1000",
        "1e4",
        "above 1e5",
    ],
    class: |row| {
        let map = Map64::new(row.subject.size, &row.subject.pixels);
        let density = map.pdf(row.input.direction.as_dvec3()).value;
        Some(match density {
            1e5.. => 8,
            1e4.. => 7,
            _ => magnitude_class(density),
        })
    },
};

/// The sine of the angle between the direction and the nearer pole.
const SINE: Aspect<Row<EnvironmentPdf>> = Aspect {
    name: "sin θ",
    classes: &[
        "below 0.1 around +y",
        "0.1 to 0.5 around +y",
        "above 0.5",
        "0.1 to 0.5 around -y",
        "below 0.1 around -y",
    ],
    class: |row| {
        let DVec3 { x, y, z } = row.input.direction.as_dvec3();
        let class = match x.hypot(z) {
            ..0.1 => 0,
            ..0.5 => 1,
            _ => 2,
        };
        Some(if y < 0.0 { 4 - class } else { class })
    },
};

/// The angle around the y-axis.
const LONGITUDE: Aspect<Row<EnvironmentPdf>> = Aspect {
    name: "longitude",
    classes: AZIMUTHS,
    class: |row| {
        let Vec3 { x, z, .. } = row.input.direction;
        azimuth_class(Vec3::new(x, z, 0.0))
    },
};
