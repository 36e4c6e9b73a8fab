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
use crate::domains::fields::{class_below, class_up_to};
use crate::domains::{Aspect, FunctionDomain, not_asked};
use crate::oracle::light::environment::Map64;
use crate::oracle::light::luminance;

/// The domain of `uniform_sphere`.
pub static UNIFORM_SPHERE: FunctionDomain<Row<UniformSphere>> = FunctionDomain {
    aspects: &[Aspect::RANDOM],
    pairs: &[["random.x", "random.y"]],
    not_asked: &[
        not_asked(&["first call"]).because("The function has no subject."),
        not_asked(&["random.x", "random.y"])
            .classes(EXACT_NUMBERS)
            .columns(&["evenness"])
            .because("Evenly distributed numbers hardly ever have this exact value."),
    ],
    ..FunctionDomain::new("uniform_sphere", rows_of!(UniformSphere))
};

/// The domain of `Environment::sample`.
pub static MAP_SAMPLE: FunctionDomain<Row<EnvironmentSample>> = FunctionDomain {
    aspects: &[
        Aspect::OF_MAP,
        Aspect::OF_PIXEL,
        &[Aspect::CHOICE],
        Aspect::RANDOM,
    ],
    fields: &["choice", "random", "map"],
    not_asked: &[
        not_asked(&["share", "colour", "radiance"])
            .classes(&["0", "black"])
            .because("A black pixel is never picked."),
        not_asked(&["share"])
            .classes(NEVER_PICKED)
            .because("A pixel with so small a share is only picked by numbers close to a border."),
        not_asked(&["black pixels"])
            .classes(&["all"])
            .because("The contract excludes samples of a black map."),
    ],
    ..FunctionDomain::new("Environment::sample", rows_of!(EnvironmentSample))
};

/// The domain of `Environment::pdf`.
pub static MAP_PDF: FunctionDomain<Row<EnvironmentPdf>> = FunctionDomain {
    aspects: &[Aspect::OF_MAP, Aspect::OF_PIXEL, DIRECTION_ASPECTS],
    fields: &["direction", "map"],
    not_asked: &[not_asked(&["longitude"])
        .classes(SEAMS)
        .because("In every map, this is at the edge of a pixel, which the contract excludes.")],
    ..FunctionDomain::new("Environment::pdf", rows_of!(EnvironmentPdf))
};

/// The aspects of directions toward a map.
const DIRECTION_ASPECTS: &[Aspect<Row<EnvironmentPdf>>] = &[
    // The density of the direction.
    Aspect::new(
        "density",
        &[
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
        |row| {
            let map = Map64::new(row.subject.size, &row.subject.pixels);
            let density = map.pdf(row.input.direction.as_dvec3()).value;
            Some(match density {
                1e5.. => 8,
                1e4.. => 7,
                _ => magnitude_class(density),
            })
        },
    ),
    // The sine of the angle between the direction and the nearer pole.
    Aspect::new(
        "sin θ",
        &[
            "below 0.1 around +y",
            "0.1 to 0.5 around +y",
            "above 0.5",
            "0.1 to 0.5 around -y",
            "below 0.1 around -y",
        ],
        |row| {
            let DVec3 { x, y, z } = row.input.direction.as_dvec3();
            let class = class_below(&[0.1, 0.5], x.hypot(z));
            Some(if y < 0.0 { 4 - class } else { class })
        },
    ),
    // The angle around the y-axis.
    Aspect::new("longitude", AZIMUTHS, |row| {
        let Vec3 { x, z, .. } = row.input.direction;
        azimuth_class(Vec3::new(x, z, 0.0))
    }),
];

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

impl<F: Function<Subject = MapImage>> Aspect<Row<F>> {
    /// The aspects of a map.
    const OF_MAP: &'static [Self] = &[
        Aspect::new(
            "map",
            &["2 × 1", "4 × 2", "up to 16 × 8", "up to 64 × 32", "larger"],
            |row| Some(class_up_to(&[2, 4, 16, 64], row.subject.size.x)),
        ),
        Aspect::new(
            "black pixels",
            &["none", "some", "most", "all but one", "all"],
            |row| {
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
        ),
        Aspect::new(
            "brightest pixel over the mean",
            &["up to 10", "up to 1,000", "beyond"],
            |row| {
                let luminances = luminances(&row.subject);
                let sum: f64 = luminances.iter().sum();
                let brightest = luminances.iter().copied().fold(0.0, f64::max);
                let ratio = brightest * luminances.len() as f64 / sum;
                (sum > 0.0).then(|| class_up_to(&[10.0, 1e3], ratio))
            },
        ),
        Aspect::new(
            "sum of the luminances",
            &["below 1e-7", "below 1", "below 1,000", "more"],
            |row| {
                let sum: f64 = luminances(&row.subject).iter().sum();
                (sum > 0.0).then(|| class_below(&[1e-7, 1.0, 1e3], sum))
            },
        ),
    ];
}

#[expect(private_bounds, reason = "the aspects are as private as the trait")]
impl<F: Function<Subject = MapImage, Input: OnMap>> Aspect<Row<F>> {
    /// The aspects of a pixel.
    const OF_PIXEL: &'static [Self] = &[
        Aspect::new(
            "row",
            &["the only one", "the top one", "the bottom one", "any other"],
            |row| Some(place_class(pixel(row).position.y, row.subject.size.y)),
        ),
        Aspect::new("column", &["the first", "the last", "any other"], |row| {
            Some(place_class(pixel(row).position.x, row.subject.size.x) - 1)
        }),
        Aspect::new("share", SHARES, |row| Some(share_class(pixel(row).share))),
        Aspect::new("colour", COLORS, |row| {
            Some(color_class(pixel(row).radiance))
        }),
        // The radiance in the pixel's brightest channel.
        Aspect::new("radiance", MAGNITUDES, |row| {
            Some(magnitude_class(pixel(row).radiance.max_element().into()))
        }),
    ];
}

fn luminances(map: &MapImage) -> Vec<f64> {
    let pixels = map.pixels.iter();
    pixels.map(|it| luminance(it.as_dvec3())).collect()
}

/// Returns the class of an index among `count` rows or columns: the only one, the first, the last
/// or any other.
fn place_class(index: u32, count: u32) -> usize {
    match index {
        0 if count == 1 => 0,
        0 => 1,
        _ if index + 1 == count => 2,
        _ => 3,
    }
}
