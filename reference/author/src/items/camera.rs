//! Task 1: cameras.
//!
//! A mistake in one quantity shall not spoil the others' items. So most of them look along the
//! middle row of the film, where only x counts, and at the middles of pixels; and film and sensor
//! have the same shape, but where that is the idea.

use glam::{UVec2, Vec2, uvec2, vec2};
use grader::exam::{Asked, Item, Key, RayPart, Task};
use protocol::{PinholeCamera, Question, Sample, Samples};

use crate::oracle;
use crate::seed::{Draw, Seed};

const MIDDLE: Vec2 = Vec2::splat(0.5);

/// The items of the task `camera`.
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 12] = [
        corners,
        field_of_view,
        aspect_ratio,
        other_aspect,
        film,
        bottom_left,
        offset,
        offset_axes,
        large_film,
        unit_length,
        origin_and_range,
        picture,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

fn item(name: &str, points: u32, text: [&str; 2], questions: Vec<Asked>) -> Item {
    super::item(Task::Camera, name, points, text, questions)
}

fn asked(judged: &[RayPart], camera: PinholeCamera, samples: Samples) -> Asked {
    let truth = |sample| oracle::camera::direction(&camera, sample).as_vec3();
    let directions = samples.on(camera.film).into_iter().map(truth).collect();
    Asked {
        question: Question::Camera { camera, samples },
        key: Key::Rays {
            judged: judged.to_vec(),
            directions,
        },
    }
}

fn directions(camera: PinholeCamera, samples: Vec<Sample>) -> Asked {
    asked(&[RayPart::Direction], camera, Samples::List(samples))
}

fn camera(vertical_fov: f64, aspect_ratio: f64, film: UVec2) -> PinholeCamera {
    PinholeCamera {
        vertical_fov: vertical_fov as f32,
        aspect_ratio: aspect_ratio as f32,
        film,
    }
}

/// The middles of all pixels of the middle row of a film with an odd number of rows.
fn middle_row(film: UVec2) -> Vec<Sample> {
    let pixels = (0..film.x).map(|x| uvec2(x, film.y / 2));
    pixels
        .map(|pixel| Sample {
            pixel,
            offset: MIDDLE,
        })
        .collect()
}

fn place(draw: &mut Draw) -> f32 {
    // Not at the very ends: 1 is none of the offsets.
    draw.uniform(0.02, 0.98) as f32
}

fn below(draw: &mut Draw, n: u32) -> u32 {
    draw.index(n as usize) as u32
}

fn corners(_: Seed) -> Item {
    // tan 45° = 1: a sensor 2 × 2, whatever is made of degrees.
    let question = |n: u32| {
        let film = UVec2::splat(n);
        let corners = [
            (0, 0),
            (n - 1, 0),
            (0, n - 1),
            (n - 1, n - 1),
            (n / 2, n / 2),
        ];
        let sample = |(x, y)| Sample {
            pixel: uvec2(x, y),
            offset: MIDDLE,
        };
        directions(camera(90.0, 1.0, film), corners.map(sample).to_vec())
    };
    item(
        "corners",
        1,
        [
            "the film's corners are the sensor's corners, and its middle is straight ahead",
            "The whole film maps to the whole sensor: at 90 degrees the sensor reaches from −1 to 1, \
             so half of its height is tan(45°), and the middle of the film is (0, 0, −1).",
        ],
        [3, 5, 64].map(question).to_vec(),
    )
}

fn field_of_view(seed: Seed) -> Item {
    let mut draw = seed.draw("camera.field_of_view");
    let film = UVec2::splat(9);
    let question = |(from, to): (f64, f64)| {
        directions(camera(draw.uniform(from, to), 1.0, film), middle_row(film))
    };
    item(
        "field_of_view",
        2,
        [
            "the sensor grows with the field of view as 2·tan(fov/2)",
            "vertical_fov is the full angle, in degrees. Draw the triangle from the camera to the \
             sensor's middle and its upper edge: which angle is at the camera?",
        ],
        [(15.0, 25.0), (30.0, 50.0), (55.0, 80.0), (100.0, 125.0)]
            .map(question)
            .to_vec(),
    )
}

fn aspect_ratio(_: Seed) -> Item {
    let question = |film: UVec2| {
        let aspect = f64::from(film.x) / f64::from(film.y);
        directions(camera(60.0, aspect, film), middle_row(film))
    };
    item(
        "aspect_ratio",
        1,
        [
            "the sensor's width is the aspect ratio times its height",
            "The field of view is vertical: it gives the height. Only then does the aspect ratio \
             give the width.",
        ],
        [uvec2(15, 9), uvec2(9, 15), uvec2(21, 7)]
            .map(question)
            .to_vec(),
    )
}

fn other_aspect(seed: Seed) -> Item {
    let mut draw = seed.draw("camera.other_aspect");
    let question =
        |(film, from, to)| directions(camera(70.0, draw.uniform(from, to), film), middle_row(film));
    item(
        "other_aspect",
        1,
        [
            "the sensor's shape comes from aspect_ratio, not from the film",
            "Pixels need not be square: the film only says into how many parts the sensor is \
             divided.",
        ],
        [
            (uvec2(9, 9), 1.6, 2.4),
            (uvec2(16, 5), 0.5, 0.8),
            (uvec2(5, 9), 1.2, 1.8),
        ]
        .map(question)
        .to_vec(),
    )
}

fn film(_: Seed) -> Item {
    let question = |film: UVec2| {
        let columns = (0..film.y).map(|y| Sample {
            pixel: uvec2(film.x / 2, y),
            offset: MIDDLE,
        });
        let samples = middle_row(film).into_iter().chain(columns).collect();
        let aspect = f64::from(film.x) / f64::from(film.y);
        directions(camera(90.0, aspect, film), samples)
    };
    item(
        "film",
        1,
        [
            "x is divided by the film's width, y by its height",
            "On a film that is not square the two must not be mixed up, nor one used for both.",
        ],
        [uvec2(17, 5), uvec2(5, 17)].map(question).to_vec(),
    )
}

fn bottom_left(_: Seed) -> Item {
    let question = |n: u32| {
        let film = UVec2::splat(n);
        let samples = (0..n).map(|i| Sample {
            pixel: uvec2(i, i / 2),
            offset: MIDDLE,
        });
        directions(camera(90.0, 1.0, film), samples.collect())
    };
    item(
        "bottom_left",
        1,
        [
            "pixel (0, 0) is at the bottom left",
            "y is up in the film as it is in space: small y looks down, and small x looks left.",
        ],
        [8, 11].map(question).to_vec(),
    )
}

fn offset(seed: Seed) -> Item {
    let mut draw = seed.draw("camera.offset");
    let mut question = |film: UVec2| {
        let samples = (0..24).map(|_| Sample {
            pixel: uvec2(below(&mut draw, film.x), 0),
            offset: vec2(place(&mut draw), 0.5),
        });
        let aspect = f64::from(film.x);
        directions(camera(50.0, aspect, film), samples.collect())
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

fn offset_axes(seed: Seed) -> Item {
    let mut draw = seed.draw("camera.offset_axes");
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
    let question = directions(camera(90.0, 1.0, uvec2(1, 1)), samples.collect());
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

fn large_film(seed: Seed) -> Item {
    let mut draw = seed.draw("camera.large_film");
    let film = uvec2(3840, 2160);
    let samples = (0..32).map(|_| Sample {
        pixel: uvec2(below(&mut draw, film.x), below(&mut draw, film.y)),
        offset: vec2(place(&mut draw), place(&mut draw)),
    });
    let question = directions(camera(40.0, 16.0 / 9.0, film), samples.collect());
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
fn spread(judged: &[RayPart], draw: &mut Draw) -> Asked {
    let film = uvec2(7, 7);
    let samples = (0..16).map(|_| Sample {
        pixel: uvec2(below(draw, 7), below(draw, 7)),
        offset: MIDDLE,
    });
    let samples = Samples::List(samples.collect());
    asked(judged, camera(90.0, 1.0, film), samples)
}

fn unit_length(seed: Seed) -> Item {
    let mut draw = seed.draw("camera.unit_length");
    item(
        "unit_length",
        1,
        [
            "the direction has length one",
            "Distances along a ray are measured in lengths of its direction. Ray::new brings it to \
             length one; filling in the fields does not.",
        ],
        vec![spread(
            &[RayPart::Direction, RayPart::UnitLength],
            &mut draw,
        )],
    )
}

fn origin_and_range(seed: Seed) -> Item {
    let mut draw = seed.draw("camera.origin_and_range");
    let judged = [RayPart::Direction, RayPart::Origin, RayPart::Range];
    item(
        "origin_and_range",
        1,
        [
            "the ray starts at the camera and reaches on without end",
            "The camera stands at (0, 0, 0), not on the sensor, and the ray counts from 0 to ∞.",
        ],
        vec![spread(&judged, &mut draw)],
    )
}

fn picture(seed: Seed) -> Item {
    let mut draw = seed.draw("camera.picture");
    let camera = camera(draw.uniform(45.0, 75.0), 1.5, uvec2(64, 64));
    item(
        "picture",
        2,
        [
            "every pixel of a picture looks the right way",
            "Five places in each pixel are compared. If only some are wrong, see which: one edge, \
             one half, or all but the middles of pixels?",
        ],
        vec![asked(&[RayPart::Direction], camera, Samples::EveryPixel)],
    )
}
