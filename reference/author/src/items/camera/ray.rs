//! The place in the pixel, and the ray itself.

use glam::{UVec2, uvec2, vec2};
use grader::exam::{ExamQuestion, Item, RayCheck};
use protocol::{Sample, Samples};

use super::{MIDDLE, camera, camera_question, direction_question, item, random_below};
use crate::seed::{Rng, Seed};

fn random_offset(draw: &mut Rng) -> f32 {
    // Not at the very ends: 1 is none of the offsets.
    draw.uniform(0.02, 0.98) as f32
}

pub(super) fn offset(seed: Seed) -> Item {
    let mut draw = seed.rng("camera.offset");
    let mut question = |film: UVec2| {
        let samples = (0..24).map(|_| Sample {
            pixel: uvec2(random_below(&mut draw, film.x), 0),
            offset: vec2(random_offset(&mut draw), 0.5),
        });
        let aspect = f64::from(film.x);
        direction_question(camera(50.0, aspect, film), samples.collect())
    };
    item(
        "offset",
        2,
        [
            "the offset moves the ray within its pixel",
            "Pixel x covers [x, x + 1) of the film, so the place on the film is the pixel plus the \
             offset, in pixels. The offset is given: draw no numbers of your own.",
        ],
        vec![
            question(uvec2(1, 1)),
            question(uvec2(3, 1)),
            question(uvec2(4, 1)),
        ],
    )
}

pub(super) fn offset_axes(seed: Seed) -> Item {
    let mut draw = seed.rng("camera.offset_axes");
    let samples = (0..24).map(|i| {
        let (near, far) = (
            draw.uniform(0.05, 0.25) as f32,
            draw.uniform(0.6, 0.95) as f32,
        );
        Sample {
            pixel: uvec2(0, 0),
            offset: if i % 2 == 0 {
                vec2(near, far)
            } else {
                vec2(far, near)
            },
        }
    });
    let question = direction_question(camera(90.0, 1.0, uvec2(1, 1)), samples.collect());
    item(
        "offset_axes",
        1,
        [
            "the offset's x moves the ray to the right, its y moves it up",
            "The two components are independent: each belongs to its own axis.",
        ],
        vec![question],
    )
}

pub(super) fn large_film(seed: Seed) -> Item {
    let mut draw = seed.rng("camera.large_film");
    let film = uvec2(3840, 2160);
    let samples = (0..32).map(|_| Sample {
        pixel: uvec2(
            random_below(&mut draw, film.x),
            random_below(&mut draw, film.y),
        ),
        offset: vec2(random_offset(&mut draw), random_offset(&mut draw)),
    });
    let question = direction_question(camera(40.0, 16.0 / 9.0, film), samples.collect());
    item(
        "large_film",
        1,
        [
            "all of it together holds on a large film",
            "If this is the only item that fails, look for whole numbers where fractions are \
             needed: dividing integers drops what is behind the point.",
        ],
        vec![question],
    )
}

/// Directions that differ much, so that a direction of wrong length or another origin is told apart
/// from a constant answer.
fn spread_question(judged: &[RayCheck], draw: &mut Rng) -> ExamQuestion {
    let film = uvec2(7, 7);
    let samples = (0..16).map(|_| Sample {
        pixel: uvec2(random_below(draw, 7), random_below(draw, 7)),
        offset: MIDDLE,
    });
    let samples = Samples::List(samples.collect());
    camera_question(judged, camera(90.0, 1.0, film), samples)
}

pub(super) fn unit_length(seed: Seed) -> Item {
    let mut draw = seed.rng("camera.unit_length");
    item(
        "unit_length",
        1,
        [
            "the direction has length one",
            "Distances along a ray are measured in lengths of its direction. Ray::new brings it to \
             length one; filling in the fields does not.",
        ],
        vec![spread_question(
            &[RayCheck::Direction, RayCheck::UnitLength],
            &mut draw,
        )],
    )
}

pub(super) fn origin_and_range(seed: Seed) -> Item {
    let mut draw = seed.rng("camera.origin_and_range");
    let judged = [RayCheck::Direction, RayCheck::Origin, RayCheck::Range];
    item(
        "origin_and_range",
        1,
        [
            "the ray starts at the camera and reaches on without end",
            "The camera stands at (0, 0, 0), not on the sensor, and the ray counts from 0 to ∞.",
        ],
        vec![spread_question(&judged, &mut draw)],
    )
}

pub(super) fn picture(seed: Seed) -> Item {
    let mut draw = seed.rng("camera.picture");
    let camera = camera(draw.uniform(45.0, 75.0), 1.5, uvec2(64, 64));
    item(
        "picture",
        2,
        [
            "every pixel of a picture looks the right way",
            "Five places in each pixel are compared. If only some are wrong, see which: one edge, \
             one half, or all but the middles of pixels?",
        ],
        vec![camera_question(
            &[RayCheck::Direction],
            camera,
            Samples::EveryPixel,
        )],
    )
}
