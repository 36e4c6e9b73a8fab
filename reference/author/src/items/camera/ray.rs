//! Items about the offset within the pixel and about the ray itself.

use glam::{UVec2, Vec2, uvec2};
use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::{Rows, Sample};

use super::{camera, camera_question, direction_question, middle_of, random_below};
use crate::domains::camera::{
    ASPECT_RATIOS, FIELDS_OF_VIEW, ROUND_ANGLES, almost_equal_cameras, almost_usual_cameras,
    cameras, common_films, drawn, extreme_views, films_of_few_pixels, offset, sample, side,
};
use crate::items::{Declaration, groups};
use crate::seed::Rng;

pub(super) const OFFSET: Declaration = Declaration {
    id: "camera.offset",
    points: 2,
    title: "the offset moves the ray within its pixel",
    look: "Pixel (x, y) with its offset is the point (x + offset.x, y + offset.y) on the film, \
           measured in pixels. Use each component unchanged, on its own axis.",
    section: "camera.md#the-offset-is-measured-in-pixels",
    tests: &["`offset` is the position…"],
    questions: |rng| {
        let mut question = |length: u32, along: [UVec2; 2], field_of_view: f64| {
            let [x, y] = along.map(|axis| axis.as_vec2());
            let samples = (0..24).flat_map(|index| {
                let first = Sample {
                    pixel: random_below(rng, length) * along[0],
                    offset: offset(rng) * x + 0.5 * y,
                };
                // Some samples are followed by an almost identical sample.
                let away = rng.uniform(0.015, 0.03) as f32;
                let away = if first.offset.dot(x) < 0.5 {
                    away
                } else {
                    -away
                };
                let second = Sample {
                    offset: first.offset + away * x,
                    ..first
                };
                std::iter::once(first).chain((index % 4 == 0).then_some(second))
            });
            let samples: Vec<Sample> = samples.collect();
            let film = length * along[0] + along[1];
            let aspect = f64::from(film.x) / f64::from(film.y);
            direction_question(camera(field_of_view, aspect, film), samples)
        };
        let angles = ROUND_ANGLES.into_iter().chain([50.0]);
        let lengths = [1, 3, 4].into_iter();
        let axes = [[UVec2::X, UVec2::Y], [UVec2::Y, UVec2::X]];
        let all = lengths.flat_map(|length| axes.map(|along| (length, along)));
        all.zip(angles)
            .map(|((length, along), angle)| question(length, along, angle))
            .collect()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const OFFSET_AXES: Declaration = Declaration {
    id: "camera.offset_axes",
    title: "the offset's x moves the ray to the right, and its y moves it up",
    look: "The two components are independent, and each belongs to its own axis.",
    section: "camera.md#the-offset-is-measured-in-pixels",
    tests: &["`offset` is the position…"],
    questions: |rng| {
        let samples = (0..24).map(|i| {
            let small = rng.uniform(0.05, 0.25) as f32;
            let large = rng.uniform(0.6, 0.95) as f32;
            let pairs = [
                [small, large],
                [large, small],
                [0.0, large],
                [small, 0.0],
                [0.0, 0.0],
            ];
            Sample {
                pixel: UVec2::ZERO,
                offset: pairs[i % pairs.len()].into(),
            }
        });
        let samples: Vec<Sample> = samples.collect();
        let aspect = drawn(ASPECT_RATIOS[[2, 4][rng.index(2)]], rng);
        let single = direction_question(camera(90.0, aspect, UVec2::ONE), samples);
        let films = [uvec2(1, rng.integer(2, 9)), uvec2(rng.integer(2, 9), 1)];
        let line = |film: UVec2| {
            let camera = camera(rng.uniform(60.0, 100.0), 1.0, film);
            direction_question(camera, rng.list(12, |rng| sample(rng, camera.film)))
        };
        [vec![single], films.map(line).to_vec()].concat()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const LARGE_FILM: Declaration = Declaration {
    id: "camera.large_film",
    title: "rays on a large film point in the right direction",
    look: "The film has 3840 columns and 2160 rows. Work out one position by hand: pixel + offset, \
           divided by these numbers in floating point, gives two fractions between 0 and 1.",
    section: "camera.md#integer-division-gives-zero",
    tests: &["Pixel (x, y) covers…", "`pixel` and `film`…"],
    questions: |rng| {
        let film = uvec2(3840, 2160);
        let usual = camera(rng.uniform(35.0, 50.0), 16.0 / 9.0, film);
        // With the widest view, even the pixels in the middle of a large film are large.
        let wide = [(2048, 3400), (3550, 4096)].map(|(least, most)| {
            let film = UVec2::from([(); 2].map(|()| rng.integer(least, most)));
            let wide = camera(rng.uniform(173.0, 175.0), rng.uniform(8.0, 10.0), film);
            let in_the_middle = rng.list(12, |rng| Sample {
                pixel: film / 2,
                offset: Vec2::new(offset(rng), offset(rng)),
            });
            (wide, in_the_middle)
        });
        let mut all = almost_equal_cameras(rng, usual);
        let more = rng.list(16, |rng| sample(rng, usual.film));
        all[0].1.splice(..0, more);
        all.extend(wide);
        all.extend(extreme_views(rng));
        all.extend(films_of_few_pixels(rng));
        all.extend(common_films(rng));
        all.extend(almost_usual_cameras(rng));
        all.extend(cameras(rng));
        let all = all.into_iter();
        all.map(|(camera, samples)| direction_question(camera, samples))
            .collect()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

/// Creates a question with very different directions, so that no constant answer passes an item
/// about lengths, origins or ranges.
fn spread_question(judged: &[&str], rng: &mut Rng) -> ExamQuestion {
    let film = UVec2::splat(rng.integer(7, 19));
    let samples = rng.list(16, |rng| {
        middle_of(random_below(rng, film.x), random_below(rng, film.y))
    });
    camera_question(judged, camera(90.0, 1.0, film), Rows::List(samples))
}

/// Creates questions about all kinds of cameras, for quantities that don't depend on the kind.
fn questions_about_all_cameras(judged: &[&str], rng: &mut Rng) -> Vec<ExamQuestion> {
    let parts = FIELDS_OF_VIEW.into_iter().enumerate();
    let question = |(index, part)| {
        // Narrow angles of view are combined with wide sensors, where directions are longest.
        let ratio = (2 * ASPECT_RATIOS.len() - 1 - index) % ASPECT_RATIOS.len();
        let aspect = drawn(ASPECT_RATIOS[ratio], rng);
        let film = uvec2(side(rng, index), side(rng, 3 * index + 4));
        let camera = camera(drawn(part, rng), aspect, film);
        let samples = rng.list(8, |rng| sample(rng, camera.film));
        camera_question(judged, camera, Rows::List(samples))
    };
    parts.map(question).collect()
}

pub(super) const UNIT_LENGTH: Declaration = Declaration {
    id: "camera.unit_length",
    title: "the direction has length one",
    look: "Distances along a ray are measured in multiples of its direction. Ray::new normalises the \
        direction, but if you fill in the fields yourself, nothing does.",
    look_fits: &[Symptom::of("length of the direction")],
    section: "camera.md#the-direction-has-length-one",
    tests: &["The ray's `dir` has…"],
    questions: |rng| {
        let spread = spread_question(&["direction", "unit_direction"], rng);
        let all = questions_about_all_cameras(&["unit_direction"], rng);
        [vec![spread], all].concat()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const ORIGIN_AND_RANGE: Declaration = Declaration {
    id: "camera.origin_and_range",
    title: "the ray starts at the camera and has no end",
    look: "The camera is at (0, 0, 0), not on the sensor, and the range of the ray is from 0 to ∞.",
    look_fits: &[Symptom::of("origin"), Symptom::of("range")],
    section: "camera.md#the-ray-starts-at-the-camera",
    tests: &["The ray's `dir` has…"],
    questions: |rng| {
        let spread = spread_question(&["direction", "origin", "range"], rng);
        let all = questions_about_all_cameras(&["origin", "range"], rng);
        [vec![spread], all].concat()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const PICTURE: Declaration = Declaration {
    id: "camera.picture",
    points: 2,
    title: "in a picture, every pixel's rays point in the right direction",
    look: "Five positions in each pixel are compared. Which of them are wrong: those along one \
           edge, those in one half, or all but the centre?",
    section: "grading.md#reading-a-wrong-picture",
    tests: &["Returns the ray that…"],
    questions: |rng| {
        let camera = camera(rng.uniform(45.0, 75.0), 1.5, uvec2(64, 64));
        let rows = Rows::Picture(camera.film);
        vec![camera_question(&["direction"], camera, rows)]
    },
    ..Declaration::ALONE
};
