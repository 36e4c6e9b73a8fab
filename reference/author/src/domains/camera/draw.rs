//! Generates random cameras and samples.

use glam::{UVec2, Vec2, uvec2};
use protocol::{PinholeCamera, Sample};

use super::aspects::{
    ALMOST, ANGLES, COMMON_FILMS, OLD, ROUND_ANGLES, SENSORS, SIDES, USUAL_RATIOS,
};
use crate::seed::Rng;

/// Picks a random number from a range of a domain.
pub fn drawn((from, to): (f64, f64), rng: &mut Rng) -> f64 {
    if from < to {
        rng.log_uniform(from, to)
    } else {
        from
    }
}

/// Picks a random offset along one axis, often close to an edge of the pixel.
pub fn offset(rng: &mut Rng) -> f32 {
    let offset = match rng.index(7) {
        0 => 0.0,
        6 => 0.5,
        1 => rng.log_uniform(1e-4, 0.01),
        2 => 1.0 - rng.log_uniform(1e-4, 0.01),
        _ => rng.uniform(0.02, 0.98),
    };
    offset as f32
}

/// Picks a random width or height of a film in this class.
pub fn side(rng: &mut Rng, class: usize) -> u32 {
    match class % SIDES.len() {
        0 => 1,
        1 => 2,
        2 => 3,
        3 => rng.integer(4, 10),
        4 => rng.integer(11, 255),
        5 => rng.integer(256, 4095),
        _ => 4096,
    }
}

/// Generates random cameras with all classes of angles of view, sensors and films. Most differ from
/// the previous camera in a single field and get the same samples, so that a method that keeps
/// state between calls fails.
pub fn cameras(rng: &mut Rng) -> Vec<(PinholeCamera, Vec<Sample>)> {
    let (classes, forms) = (
        rng.shuffled((0..SIDES.len()).collect()),
        rng.shuffled((0..SENSORS.len()).collect()),
    );
    let mut asked = [[0; SENSORS.len()]; ANGLES.len()];
    let mut cameras = Vec::new();
    for (pair, classes) in classes.chunks(2).enumerate() {
        let [first, second, third] = [0, 1, 2].map(|it| forms[(pair + it) % forms.len()]);
        // The first sensor comes both first and last, so that nothing but the film changes when the
        // film is rotated.
        let ends = [first, second, second, third, third, first];
        let film = uvec2(side(rng, classes[0]), side(rng, classes[classes.len() - 1]));
        let mut camera = PinholeCamera {
            vertical_fov: 0.0,
            aspect_ratio: 0.0,
            film,
        };
        let mut samples = samples_of_both(rng, film);
        let (mut last_angle, mut last_form) = (None, None);
        for turn in 0..classes.len() {
            for (step, &form) in ends.iter().enumerate() {
                let angle = if turn == 0 { step / 2 } else { 2 - step / 2 };
                let times = &mut asked[angle][form];
                if last_angle.replace(angle) != Some(angle) {
                    camera.vertical_fov = drawn(ANGLES[angle][*times % 3], rng) as f32;
                }
                if last_form.replace(form) != Some(form) {
                    let ratios = SENSORS[form];
                    camera.aspect_ratio = drawn(ratios[*times % ratios.len()], rng) as f32;
                }
                *times += 1;
                cameras.push((camera, samples.clone()));
                // The last sample for a camera is also the first sample for the next camera.
                samples.reverse();
            }
            camera.film = uvec2(film.y, film.x);
            samples.retain(|sample| sample.pixel.cmplt(camera.film).all());
        }
    }
    cameras
}

/// Generates random cameras that each differ from the previous one in a single field, most by less
/// than 1%. All of them get the same samples.
pub fn almost_equal_cameras(
    rng: &mut Rng,
    first: PinholeCamera,
) -> Vec<(PinholeCamera, Vec<Sample>)> {
    let almost = |rng: &mut Rng, ratio: f64| {
        let difference = rng.sign() * rng.uniform(0.4, 0.9) * ALMOST;
        (ratio * (1.0 + difference)) as f32
    };
    let mut cameras = vec![first];
    let mut add = |change: &dyn Fn(&mut PinholeCamera)| {
        let mut camera = cameras[cameras.len() - 1];
        change(&mut camera);
        cameras.push(camera);
    };
    let ratio = almost(rng, first.aspect_ratio.into());
    add(&|camera| camera.aspect_ratio = ratio);
    let angle = (rng.sign() * rng.uniform(0.2, 0.45)) as f32;
    add(&|camera| camera.vertical_fov += angle);
    let angle = (rng.sign() * rng.uniform(0.05, 0.09)) as f32;
    add(&|camera| camera.vertical_fov += angle);
    let few = (f64::from(first.film.x) * rng.uniform(0.955, 0.985)).round() as u32;
    add(&|camera| camera.film.x = few);
    let rows = (f64::from(first.film.y) * rng.uniform(0.5, 0.8)).round() as u32;
    add(&|camera| camera.film.y = rows);
    let ratio = almost(rng, OLD);
    add(&|camera| camera.aspect_ratio = ratio);
    let columns = (f64::from(rows) * OLD).round() as u32;
    add(&|camera| camera.film.x = columns);
    add(&|camera| camera.aspect_ratio = OLD as f32);
    // Use only pixels that exist on all of the films.
    let film = cameras.iter().map(|camera| camera.film);
    let film = film.reduce(UVec2::min).unwrap_or(first.film);
    let mut samples: Vec<Sample> = (0..8).map(|_| sample(rng, film)).collect();
    let ends = [UVec2::ZERO, film - 1];
    for (row, pixel) in [(0, ends[0]), (1, ends[1]), (6, ends[1]), (7, ends[0])] {
        samples[row].pixel = pixel;
    }
    let mut all = Vec::new();
    for camera in cameras {
        all.push((camera, samples.clone()));
        // The last sample for a camera is also the first sample for the next camera.
        samples.reverse();
    }
    all
}

/// Generates random cameras with films of common sizes. The sensor's aspect ratio differs from the
/// film's: it is that of the film with its sides swapped, or a random one.
pub fn common_films(rng: &mut Rng) -> Vec<(PinholeCamera, Vec<Sample>)> {
    let films = rng.shuffled(COMMON_FILMS.to_vec());
    let views = films.into_iter().enumerate().map(|(index, film)| {
        let film = UVec2::from(film);
        let exchanged = f64::from(film.y) / f64::from(film.x);
        let aspect_ratio = if index % 2 == 0 && film.x != film.y {
            exchanged
        } else {
            drawn(SENSORS[2 * (index / 2 % 2)][1], rng)
        };
        let camera = PinholeCamera {
            vertical_fov: rng.uniform(25.0, 100.0) as f32,
            aspect_ratio: aspect_ratio as f32,
            film,
        };
        let mut samples: Vec<Sample> = (0..6).map(|_| sample(rng, film)).collect();
        // Each axis is reversed once, so that this sample is a mirror image of the previous one.
        for axis in [0, 1] {
            let mut mirrored = samples[samples.len() - 1];
            mirrored.pixel[axis] = film[axis] - 1 - mirrored.pixel[axis];
            mirrored.offset[axis] = (1.0 - mirrored.offset[axis]).min(0.999);
            samples.push(mirrored);
        }
        (camera, samples)
    });
    views.collect()
}

/// Generates random cameras whose field of view is close to a round number of degrees and whose
/// aspect ratio is close to a common one. Some films are strips.
pub fn almost_usual_cameras(rng: &mut Rng) -> Vec<(PinholeCamera, Vec<Sample>)> {
    let almost = |rng: &mut Rng, number: f64, difference: f64| {
        (number + rng.sign() * rng.uniform(0.75, 0.98) * difference) as f32
    };
    let mut all = Vec::new();
    for (index, ratio) in USUAL_RATIOS.into_iter().enumerate() {
        let angle = ROUND_ANGLES[(index + 3) % ROUND_ANGLES.len()];
        let (few, many) = (rng.integer(2, 10), rng.integer(1000, 4096));
        let film = [(few, many), (many, few), (rng.integer(11, 255), many)][index % 3];
        let camera = PinholeCamera {
            vertical_fov: almost(rng, angle, 1.0),
            aspect_ratio: almost(rng, ratio, 0.5 * ALMOST * ratio),
            film: film.into(),
        };
        all.push((camera, (0..8).map(|_| sample(rng, camera.film)).collect()));
    }
    all
}

/// Generates random samples at the edges of narrow views on wide sensors, in the middle of a large
/// film with an ordinary view, and in a single pixel with a wide view.
pub fn extreme_views(rng: &mut Rng) -> Vec<(PinholeCamera, Vec<Sample>)> {
    let mut all = Vec::new();
    for (from, to, ratio) in [(3.5, 4.95, 7.0), (7.5, 9.9, 9.0), (10.0, 15.0, 7.0)] {
        let film = uvec2(rng.integer(11, 255), rng.integer(2, 255));
        let narrow = PinholeCamera {
            vertical_fov: rng.uniform(from, to) as f32,
            aspect_ratio: rng.uniform(ratio, 10.0) as f32,
            film,
        };
        let ends = (0..8).map(|index| Sample {
            pixel: uvec2([0, film.x - 1][index % 2], rng.integer(0, film.y - 1)),
            offset: Vec2::new(offset(rng), offset(rng)),
        });
        all.push((narrow, ends.collect()));
    }
    let large = PinholeCamera {
        vertical_fov: rng.uniform(60.0, 100.0) as f32,
        aspect_ratio: rng.uniform(7.0, 10.0) as f32,
        film: uvec2(rng.integer(1024, 1600), rng.integer(1024, 1600)),
    };
    let in_the_middle = (0..8).map(|_| Sample {
        pixel: large.film / 2,
        offset: Vec2::new(offset(rng), offset(rng)),
    });
    all.push((large, in_the_middle.collect()));
    let single = PinholeCamera {
        vertical_fov: rng.uniform(121.0, 175.0) as f32,
        aspect_ratio: rng.log_uniform(0.3, 3.0) as f32,
        film: UVec2::ONE,
    };
    let of_single = (0..8).map(|_| sample(rng, single.film)).collect();
    all.push((single, of_single));
    // In the middle of a pixel this wide, even the smallest differences matter.
    let widest = PinholeCamera {
        vertical_fov: rng.uniform(172.0, 175.0) as f32,
        aspect_ratio: rng.uniform(3.0, 10.0) as f32,
        film: UVec2::ONE,
    };
    let middle = rng.uniform(0.49, 0.51);
    let beside = [0.0, 2.5e-4, 0.0, 2e-4].map(|away| Sample {
        pixel: UVec2::ZERO,
        offset: Vec2::splat((middle + away) as f32),
    });
    all.push((widest, beside.to_vec()));
    all
}

/// Generates random ordinary views on films of a few pixels. Each sample has something in common
/// with the previous one: the column, the row, the pixel or the offset.
pub fn films_of_few_pixels(rng: &mut Rng) -> Vec<(PinholeCamera, Vec<Sample>)> {
    let films = [(2, 1), (1, 2), (2, 2), (3, 1), (1, 3), (3, 2), (2, 3)];
    let films = rng.shuffled(films.to_vec());
    let view = |(index, film): (usize, (u32, u32))| {
        let camera = PinholeCamera {
            vertical_fov: rng.uniform(35.0, 110.0) as f32,
            aspect_ratio: drawn(SENSORS[index % 3][index % SENSORS[index % 3].len()], rng) as f32,
            film: film.into(),
        };
        let mut samples = vec![sample(rng, camera.film)];
        for turn in 0..14 {
            let Sample { pixel, offset } = samples[samples.len() - 1];
            let other = sample(rng, camera.film);
            // All samples differ from the previous one, even on a film with a single row.
            let moved = (offset + rng.vector(0.3, 0.6).as_vec3().truncate()) % 1.0;
            let axis = turn % 2;
            let mut next = Sample { pixel, offset };
            match (turn + index) / 2 % 3 {
                0 => {
                    next.pixel[axis] = other.pixel[axis];
                    next.offset[axis] = moved[axis];
                }
                1 => next.offset = moved,
                _ => next.pixel = other.pixel,
            }
            samples.push(next);
        }
        (camera, samples)
    };
    films.into_iter().enumerate().map(view).collect()
}

/// Generates random samples on a film. The first and last few samples also exist on the rotated
/// film. One sample repeats the previous one with x and y swapped.
fn samples_of_both(rng: &mut Rng, film: UVec2) -> Vec<Sample> {
    let square = UVec2::splat(film.min_element());
    let films = [square, square, film, film, film, film, square, square];
    let mut samples = films.map(|film| sample(rng, film)).to_vec();
    let Sample { pixel, offset } = samples[1];
    let exchanged = Sample {
        pixel: uvec2(pixel.y, pixel.x),
        offset: Vec2::new(offset.y, offset.x),
    };
    samples.insert(2, exchanged);
    samples
}

/// Picks a random pixel of a film, often at an edge, and a random position in this pixel.
pub fn sample(rng: &mut Rng, film: UVec2) -> Sample {
    let mut position = |count: u32| match rng.index(5) {
        0 => 0,
        1 => count - 1,
        2 => count / 2,
        _ => rng.index(count as usize) as u32,
    };
    Sample {
        pixel: uvec2(position(film.x), position(film.y)),
        offset: Vec2::new(offset(rng), offset(rng)),
    }
}
