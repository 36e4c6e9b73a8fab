//! The items about environment maps.

use std::f64::consts::PI;
use std::ops::Range;

use glam::{DVec3, UVec2, Vec2, Vec3, uvec2};
use judging::exam::{ExamQuestion, Key};
use judging::symptom::{SPREAD, Symptom};
use protocol::Table;
use protocol::light::LightQuestion;
use protocol::light::environment::{MapImage, MapSample, RandomPair};

use super::groups::MAPS;
use super::{color, densities, directions, local, random_pair, single, table, with_changes};
use crate::domains::light::environment::{MAP_PDF, MAP_SAMPLE, UNIFORM_SPHERE, picked};
use crate::domains::light::fields::{self, BELOW_ONE};
use crate::items::{AuthoredTask, Declaration};
use crate::oracle::light::WithMargin;
use crate::oracle::light::environment::Map64;
use crate::seed::Rng;

/// The number of calls in each question.
const CALLS: usize = 16;
/// How far a random number is from the border between two pixels, as a fraction of the pixel's
/// share.
const BORDER: f64 = 0.2;
/// How far a random number is from the border between two pixels at least, because weights are
/// rounded.
const ROUNDING: f64 = 1e-6;
/// How far a direction is from a pixel's edge, as a fraction of the pixel.
const EDGE: f64 = 0.02;
/// The number of directions that must be spread evenly.
const UNIFORM_CALLS: usize = 8192;
/// The limit of χ² with 63 degrees of freedom that evenly distributed random numbers exceed with a
/// probability of 10⁻⁹.
const MAX_CHI_SQUARED: f64 = 155.07;

/// The task `environment`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        UNIFORM, PICK, POSITION, SINE, LUMINANCE, ENDS, BLACK, PDF, SIZES,
    ],
    domains: &[&UNIFORM_SPHERE, &MAP_SAMPLE, &MAP_PDF],
    ..AuthoredTask::NEW
};

const UNIFORM: Declaration = Declaration {
    id: "environment.uniform",
    points: 4,
    title: "uniform directions are spread evenly over the whole sphere",
    look: "If part of the sphere is empty, check the ranges of the height and of φ, and that each \
           uses a number of its own. Otherwise, which is uniform: the polar angle or the height?",
    look_fits: &[Symptom::of(SPREAD)],
    section: "light/environment.md#directions-spread-evenly",
    tests: &[
        "Samples a direction uniformly from all directions, with two random numbers in `[0, 1)`.",
        "See PBR, section A.5.1.",
        "Any formula will do, as long as evenly distributed numbers give evenly distributed \
         directions.",
        "The direction has length one.",
    ],
    questions: |rng| {
        let pairs = rng.list(UNIFORM_CALLS, |rng| RandomPair {
            random: random_pair(rng),
        });
        let question = LightQuestion::UniformSphere(Table::of_list((), pairs));
        let key = Key::SpreadEvenly {
            max_chi_squared: MAX_CHI_SQUARED,
        };
        let spread = ExamQuestion::new(question.into(), key);
        vec![spread, unit_at_the_ends(rng)]
    },
    ..Declaration::ALONE
};

const PICK: Declaration = Declaration {
    id: "environment.pick",
    points: 3,
    title: "pixels are picked in proportion to their weight, row by row from the top",
    look: "Pass the correct direction to `Environment::index`. If your search returns it, check \
           the row, the column and the two angles. Otherwise, which sum of weights (luminance × \
           sine in the middle of the row) is the first above `choice` × total?",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/environment.md#pick-a-pixel-by-cumulative-sums",
    tests: &[
        "Prepares a map for sampling.",
        "See PBR, section 12.5.2.",
        "Samples a direction where the map is bright, with random numbers in `[0, 1)`.",
        "`choice` picks the pixel: a pixel's share of `[0, 1)` is its share of the weights, row by \
         row from the top.",
        "Numbers at the border between two pixels are not tested.",
    ],
    questions: |rng| {
        // Most questions start with the call that the previous one ends with.
        let mut last = None;
        let maps = every_brightness(rng).into_iter();
        let questions = maps.flat_map(|map| [(map.clone(), CALLS), (rotated(map), 2)]);
        let questions = questions.map(|(map, count)| {
            let same = last.filter(|call| is_clear(&oracle(&map), call));
            let calls = sample_calls(rng, &map, count);
            last = calls.last().copied();
            sampled(map, [Vec::from_iter(same), calls].concat())
        });
        questions.collect()
    },
    ..Declaration::in_group(MAPS)
};

const POSITION: Declaration = Declaration {
    id: "environment.position",
    points: 2,
    title: "`random` is the position in the pixel, across and down",
    look: "Which corner of the pixel do the numbers (0, 0) lead to, and which corner do (1, 1) \
        lead to?",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/environment.md#anywhere-in-the-pixel",
    tests: &[
        "`random` is the position in the pixel, from its upper left corner: `random.x` across and \
         `random.y` down.",
        "The result is the direction at this position, as a unit vector.",
    ],
    questions: |rng| {
        // In maps with few pixels, the position matters most.
        let widths = [2, 2, 4];
        let questions = widths.map(|width| {
            let map = colorful(rng, width);
            samples(rng, map)
        });
        questions.into()
    },
    ..Declaration::in_group(MAPS)
};

const SINE: Declaration = Declaration {
    id: "environment.sine",
    points: 2,
    title: "a pixel's weight is multiplied by the sine of θ in the middle of its row",
    look: "Which angle do you take the sine of: the one at the row's edge, or the one in its \
        middle?",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/environment.md#the-sine-belongs-in-the-weight",
    tests: &["A pixel's weight is its luminance, times the sine of θ in the middle of its row."],
    questions: |rng| {
        let questions = [4, 6, 16].map(|width| {
            let grey = single(DVec3::splat(rng.log_uniform(0.02, 500.0)));
            let map = map_of(width, |_| grey.as_vec3());
            samples(rng, map)
        });
        questions.into()
    },
    ..Declaration::in_group(MAPS)
};

const LUMINANCE: Declaration = Declaration {
    id: "environment.luminance",
    title: "samples and densities weight a coloured pixel by its luminance",
    look: "Compare the weights of a pure green and a pure blue pixel in your code: the green one \
           has a much higher luminance.",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/environment.md#the-weight-of-a-pixel",
    tests: &["A pixel's weight is its luminance, …"],
    questions: |rng| {
        let pure = [Vec3::X, Vec3::Y, Vec3::Z];
        let map = map_of(4, |n| pure[n % 3] * rng.uniform(0.5, 2.0) as f32);
        samples_and_pdfs(rng, map)
    },
    ..Declaration::in_group(MAPS)
};

const ENDS: Declaration = Declaration {
    id: "environment.ends",
    points: 2,
    title: "every number picks a bright pixel, even the smallest and the largest",
    look: "What does your search return if `choice` is 0, or just below 1? In both cases, it must \
           be a pixel with a positive weight.",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/environment.md#black-pixels-are-never-picked",
    tests: &["`choice` picks the pixel: …"],
    questions: |rng| {
        let mut questions = Vec::new();
        // The first bright pixel and the last one aren't the first and the last, and can be in other
        // rows.
        for (width, black) in [(2, 0), (4, 1), (16, 17)] {
            let whole = colorful(rng, width);
            let mut with_borders = whole.clone();
            let last = with_borders.pixels.len() - black;
            with_borders.pixels[..black].fill(Vec3::ZERO);
            with_borders.pixels[last..].fill(Vec3::ZERO);
            for map in [whole, with_borders] {
                let choices = [0.0, 1e-6, BELOW_ONE - f32::EPSILON, BELOW_ONE];
                let calls = choices.map(|choice| MapSample {
                    choice,
                    random: fields::number_pair(rng),
                });
                let usual = sample_calls(rng, &map, 2);
                questions.push(sampled(map, [calls.into(), usual].concat()));
            }
        }
        questions
    },
    ..Declaration::in_group(MAPS)
};

const BLACK: Declaration = Declaration {
    id: "environment.black",
    points: 2,
    title: "only pixels that aren't black are picked, and only they have a density",
    look: "A black pixel has the same cumulative sum as the pixel before it. Which of the two does \
           your search return?",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/environment.md#black-pixels-are-never-picked",
    tests: &[
        "A map can be entirely black.",
        "In that case, [`Environment::sample`] is never called.",
        "The result is zero for a black pixel, and everywhere if all pixels are black.",
    ],
    questions: |rng| {
        let mut questions = Vec::new();
        // Most pixels are black, but in the largest map only some.
        for (width, share) in [(6, 0.6), (8, 0.6), (10, 0.15)] {
            let mut map = colorful(rng, width);
            for pixel in &mut map.pixels {
                if rng.uniform(0.0, 1.0) < share {
                    *pixel = Vec3::ZERO;
                }
            }
            // An entire row is black, and two pixels are certainly bright.
            map.pixels[width..2 * width].fill(Vec3::ZERO);
            map.pixels[1] = Vec3::ONE;
            map.pixels[2 * width] = Vec3::new(0.5, 0.25, 1.0);
            questions.extend(samples_and_both_pdfs(rng, map));
        }
        let mut black = map_of(4, |_| Vec3::ZERO);
        questions.push(pdfs(rng, black.clone(), |_| true));
        // A single pixel has all the weight.
        black.pixels[rng.index(8)] = color(rng).as_vec3();
        questions.extend(samples_and_both_pdfs(rng, black));
        questions
    },
    ..Declaration::in_group(MAPS)
};

const PDF: Declaration = Declaration {
    id: "environment.pdf",
    points: 3,
    title: "the density is the pixel's share divided by a pixel's solid angle at that height",
    look: "Work out each factor of the formula for the direction shown. Which sine do you use: \
        that of the row's middle, or that of the direction itself?",
    section: "light/environment.md#the-density-of-a-direction",
    tests: &[
        "Returns the probability density, per solid angle, with which [`Environment::sample`] \
         chooses a direction: share · width · height / (2π² · sin θ).",
        "Here, `share` is the pixel's share of the weights, and θ is the angle of the direction \
         itself, not that of the pixel's middle.",
        "The direction must be a unit vector.",
        "The given [`Environment::index`] finds the pixel.",
        "Directions close to a pole (sin θ < 0.03) and those at the edge of a pixel are not tested.",
    ],
    questions: |rng| {
        // Most questions start with the direction that the previous one ends with.
        let mut last = None;
        let maps = every_brightness(rng).into_iter();
        let questions = maps.flat_map(|map| [(map.clone(), CALLS), (rotated(map), 2)]);
        let questions = questions.map(|(map, count)| {
            let same = last.filter(|same| oracle(&map).pdf(*same).margin > EDGE);
            let mut calls = pdf_calls(rng, &map, |_| true);
            calls.truncate(count);
            last = calls.last().copied();
            densities_at(map, [Vec::from_iter(same), calls].concat())
        });
        questions.collect()
    },
    ..Declaration::in_group(MAPS)
};

const SIZES: Declaration = Declaration {
    id: "environment.sizes",
    title: "maps of any size are sampled, from two pixels to two hundred thousand",
    look: "Check whether you swap the width and the height anywhere. If only large maps or dim \
           pixels fail, check that all sums are in `f64` and that nothing is limited.",
    look_fits: &[
        Symptom::of("direction"),
        Symptom::reversed("direction"),
        Symptom::of("pdf"),
    ],
    section: "light/environment.md#three-components-and-two-angles",
    tests: &[
        "`choice` picks the pixel: …",
        "Here, `share` is the pixel's share of the weights, …",
    ],
    questions: |rng| {
        let mut questions = Vec::new();
        for width in [2, 24, 32] {
            let map = colorful(rng, width);
            questions.extend(samples_and_pdfs(rng, map));
        }
        // Next to the sun, all other shares are tiny.
        let mut map = map_of(4, |_| (color(rng) * rng.log_uniform(0.5, 5.0)).as_vec3());
        map.pixels[rng.index(8)] = Vec3::splat(1e8);
        questions.push(pdfs(rng, map, |_| true));
        let map = large(rng);
        questions.extend(samples_and_pdfs(rng, map));
        questions.extend(sunny(rng));
        questions
    },
    ..Declaration::in_group(MAPS)
};

/// Returns a question about the lengths of uniform directions at the ends of the random numbers.
fn unit_at_the_ends(rng: &mut Rng) -> ExamQuestion {
    let ends = [0.0, 1e-7, 0.25, 0.5, 0.75, 0.9999, BELOW_ONE];
    let corners = ends.into_iter().flat_map(|x| ends.map(|y| Vec2::new(x, y)));
    let others = rng.list(CALLS, fields::number_pair);
    let pairs = corners.chain(others).map(|random| RandomPair { random });
    let pairs: Vec<RandomPair> = pairs.collect();
    // Only the length is judged, so any direction will do.
    let rows = directions(pairs.iter().map(|_| DVec3::Y));
    let question = LightQuestion::UniformSphere(Table::of_list((), pairs));
    table(question, &["unit_direction"], rows)
}

/// Returns a map that is twice as wide as high. `pixel` returns the colour of the pixel with this
/// index.
fn map_of(width: usize, pixel: impl FnMut(usize) -> Vec3) -> MapImage {
    MapImage {
        size: uvec2(width as u32, width as u32 / 2),
        pixels: (0..width * width / 2).map(pixel).collect(),
    }
}

/// Returns a map whose pixels have random colours, some of which are very bright.
fn colorful(rng: &mut Rng, width: usize) -> MapImage {
    map_of(width, |_| pixel(rng))
}

/// Returns maps in a few sizes: two are dim everywhere, and in another, the sun is about as bright
/// as all the other pixels together.
fn every_brightness(rng: &mut Rng) -> Vec<MapImage> {
    let mut maps = [2, 4, 6, 10].map(|width| colorful(rng, width));
    for (map, dim) in [(1, 1e-12..1e-10), (2, 1e-6..1e-4)] {
        let dim = rng.log_uniform(dim.start, dim.end) as f32;
        for pixel in &mut maps[map].pixels {
            *pixel *= dim;
        }
    }
    let sunny = &mut maps[3].pixels;
    let sun = rng.index(sunny.len());
    sunny[sun] = Vec3::splat(rng.log_uniform(300.0, 3000.0) as f32);
    let brightness = rng.log_uniform(30.0, 1000.0) as f32;
    for pixel in sunny {
        *pixel *= brightness;
    }
    maps.into()
}

/// Moves all pixels by one column, so that the weights are the same but in a different order.
fn rotated(mut map: MapImage) -> MapImage {
    for row in map.pixels.chunks_mut(map.size.x as usize) {
        row.rotate_right(1);
    }
    map
}

/// Returns a random colour: white, grey, or with one, two or three channels.
fn pixel(rng: &mut Rng) -> Vec3 {
    let brightness = rng.log_uniform(0.01, 200.0);
    let mut color = color(rng);
    match rng.index(10) {
        0 => return Vec3::ONE,
        1 => color = DVec3::splat(color.x),
        2 => color *= DVec3::AXES[rng.index(3)],
        3 => color[rng.index(3)] = 0.0,
        _ => {}
    }
    (color * brightness).as_vec3()
}

/// Returns a map with so many pixels that their number doesn't fit into 16 bits, and that sums in
/// single precision aren't exact enough. Many neighbours have the same colour, so that the exam
/// stays small.
fn large(rng: &mut Rng) -> MapImage {
    striped(rng, uvec2(640, 320), 150..4500)
}

/// Returns a map whose pixels come in runs of one colour. `run` is the range of their lengths.
fn striped(rng: &mut Rng, size: UVec2, run: Range<u32>) -> MapImage {
    let mut pixels = Vec::new();
    while pixels.len() < size.element_product() as usize {
        let pixel = color(rng) * rng.log_uniform(0.5, 5.0);
        let count = rng.integer(run.start, run.end) as usize;
        pixels.resize(pixels.len() + count, pixel.as_vec3());
    }
    pixels.truncate(size.element_product() as usize);
    MapImage { size, pixels }
}

/// Returns questions about maps with a sun that is more than a thousand times as bright as the mean,
/// which includes the sun. In a medium-sized map, the other pixels are still picked.
fn sunny(rng: &mut Rng) -> Vec<ExamQuestion> {
    let mut medium = striped(rng, uvec2(64, 32), 20..100);
    add_sun(rng, &mut medium, 2.0..10.0);
    let mut bright = large(rng);
    add_sun(rng, &mut bright, 1.0..20.0);
    let polar = with_polar_suns(rng);
    let mut questions = vec![samples(rng, medium.clone())];
    questions.extend([medium, bright, polar].map(|map| {
        let calls = [toward_the_sun(rng, &map), pdf_calls(rng, &map, |_| true)].concat();
        densities_at(map, rng.shuffled(calls))
    }));
    questions
}

/// Makes a pixel that isn't close to a pole as bright as all the other pixels together, times a
/// factor in this range.
fn add_sun(rng: &mut Rng, map: &mut MapImage, factor: Range<f64>) {
    let count = map.pixels.len();
    let sum: Vec3 = map.pixels.iter().sum();
    let sun = count / 4 + rng.index(count / 2);
    let factor = rng.log_uniform(factor.start, factor.end) as f32;
    map.pixels[sun] = factor * sum.max_element() * color(rng).lerp(DVec3::ONE, 0.8).as_vec3();
}

/// Returns a large map with two suns of about the same weight, one of them very close to the upper
/// pole, where densities are the highest.
fn with_polar_suns(rng: &mut Rng) -> MapImage {
    let mut map = large(rng);
    let sum = map.pixels.iter().sum::<Vec3>().max_element();
    for row in [4, 20] {
        let column = rng.index(map.size.x as usize);
        let theta = PI * (f64::from(row) + 0.5) / f64::from(map.size.y);
        let brightness = 10.0 * sum / libm::sin(theta) as f32;
        map.pixels[row as usize * map.size.x as usize + column] = Vec3::splat(brightness);
    }
    map
}

/// Returns directions to different points in the pixels that most samples pick.
fn toward_the_sun(rng: &mut Rng, map: &MapImage) -> Vec<DVec3> {
    let map64 = oracle(map);
    rng.retry_list(CALLS, |rng| {
        let sample = map64.sample(rng.uniform(0.0, 1.0), random_pair(rng).as_dvec2());
        let direction = single(sample.value?);
        let index = map64.index(direction);
        let is_sun = map64.shares()[index.value] > 0.4;
        (is_sun && index.margin > EDGE).then_some(direction)
    })
}

fn oracle(map: &MapImage) -> Map64 {
    Map64::new(map.size, &map.pixels)
}

/// Returns a question about samples.
fn samples(rng: &mut Rng, map: MapImage) -> ExamQuestion {
    let calls = sample_calls(rng, &map, CALLS);
    sampled(map, calls)
}

/// Returns a question about samples of a map, and one about densities.
fn samples_and_pdfs(rng: &mut Rng, map: MapImage) -> Vec<ExamQuestion> {
    vec![samples(rng, map.clone()), pdfs(rng, map, |_| true)]
}

/// Returns a question about samples of a map, one about directions to black pixels, and one about
/// directions to bright pixels.
fn samples_and_both_pdfs(rng: &mut Rng, map: MapImage) -> [ExamQuestion; 3] {
    [
        samples(rng, map.clone()),
        pdfs(rng, map.clone(), |pdf| pdf == 0.0),
        pdfs(rng, map, |pdf| pdf > 0.0),
    ]
}

/// Returns random calls that aren't close to the border between two pixels.
fn sample_calls(rng: &mut Rng, map: &MapImage, count: usize) -> Vec<MapSample> {
    let map64 = oracle(map);
    rng.retry_list(count, |rng| {
        let call = MapSample {
            choice: fields::number(rng),
            random: fields::number_pair(rng),
        };
        is_clear(&map64, &call).then_some(call)
    })
}

/// Returns whether a call isn't close to the border between two pixels.
fn is_clear(map: &Map64, call: &MapSample) -> bool {
    let share = map.shares()[picked(map, call.choice)];
    sample(map, call).margin > (BORDER * share).max(ROUNDING)
}

fn sample(map: &Map64, call: &MapSample) -> WithMargin<Option<DVec3>> {
    map.sample(call.choice.into(), call.random.as_dvec2())
}

fn sampled(map: MapImage, calls: Vec<MapSample>) -> ExamQuestion {
    let map64 = oracle(&map);
    let direction = |call: &MapSample| sample(&map64, call).value.expect("the map isn't black");
    let ask = |calls: Vec<MapSample>| {
        let rows = directions(calls.iter().map(direction));
        let question = LightQuestion::EnvironmentSample(Table::of_list(map.clone(), calls));
        table(question, &["direction", "unit_direction"], rows)
    };
    with_changes(calls, ask, |call| is_clear(&map64, call))
}

/// Returns a random direction. Some are close to a pole, and some between two axes.
fn direction(rng: &mut Rng) -> DVec3 {
    let mut direction = rng.direction();
    if rng.index(8) == 0 {
        direction.x = 0.0;
    }
    if rng.index(4) == 0 {
        let flat = DVec3::new(direction.x, 0.0, direction.z).normalize();
        let sine = rng.log_uniform(0.032, 0.2);
        direction = sine * flat + rng.sign() * (1.0 - sine * sine).sqrt() * DVec3::Y;
    }
    single(direction.normalize())
}

/// Returns a question about the densities of directions that fulfil a condition.
fn pdfs(rng: &mut Rng, map: MapImage, condition: fn(f64) -> bool) -> ExamQuestion {
    let calls = pdf_calls(rng, &map, condition);
    densities_at(map, calls)
}

fn pdf_calls(rng: &mut Rng, map: &MapImage, condition: fn(f64) -> bool) -> Vec<DVec3> {
    let map64 = oracle(map);
    rng.retry_list(CALLS, |rng| {
        let direction = direction(rng);
        let pdf = map64.pdf(direction);
        (pdf.margin > EDGE && condition(pdf.value)).then_some(direction)
    })
}

fn densities_at(map: MapImage, calls: Vec<DVec3>) -> ExamQuestion {
    let map64 = oracle(&map);
    let rows = densities(calls.iter().map(|direction| map64.pdf(*direction).value));
    let calls = calls.into_iter().map(local).collect();
    let question = LightQuestion::EnvironmentPdf(Table::of_list(map, calls));
    table(question, &["pdf"], rows)
}
