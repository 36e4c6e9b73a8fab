//! Cameras in single precision: two right formulas, and wrong ones.

use glam::{Vec2, Vec2Swizzles, Vec3};
use protocol::{PinholeCamera, Ray, Sample};

pub type SampleRay = fn(&PinholeCamera, Sample) -> Ray;

fn through(camera: &PinholeCamera, place: Vec2) -> Ray {
    let height = 2.0 * (camera.vertical_fov.to_radians() / 2.0).tan();
    toward(place * Vec2::new(camera.aspect_ratio * height, height))
}

fn toward(on_sensor: Vec2) -> Ray {
    Ray::new(Vec3::ZERO, on_sensor.extend(-1.0))
}

/// From −1/2 to 1/2 across the film.
fn place(camera: &PinholeCamera, sample: Sample) -> Vec2 {
    (sample.pixel.as_vec2() + sample.offset) / camera.film.as_vec2() - 0.5
}

pub const CAMERAS: [(&str, SampleRay); 2] = [
    ("the slides'", |camera, sample| {
        through(camera, place(camera, sample))
    }),
    ("from the corner, by pixels", |camera, sample| {
        let half = (camera.vertical_fov * std::f32::consts::PI / 360.0).tan();
        let half = Vec2::new(half * camera.aspect_ratio, half);
        let pixel = 2.0 * half / camera.film.as_vec2();
        let place = sample.pixel.as_vec2() + sample.offset;
        toward(-half + pixel * place)
    }),
];

pub const WRONG_CAMERAS: [(&str, SampleRay); 15] = [
    ("straight ahead", |_, _| Ray::new(Vec3::ZERO, Vec3::NEG_Z)),
    ("half the height", |camera, sample| {
        through(camera, 0.5 * place(camera, sample))
    }),
    ("the full angle", |camera, sample| {
        let height = 2.0 * camera.vertical_fov.to_radians().tan();
        toward(place(camera, sample) * Vec2::new(camera.aspect_ratio * height, height))
    }),
    ("radians for degrees", |camera, sample| {
        let height = 2.0 * (camera.vertical_fov / 2.0).tan();
        toward(place(camera, sample) * Vec2::new(camera.aspect_ratio * height, height))
    }),
    ("no aspect", |camera, sample| {
        through(
            &PinholeCamera {
                aspect_ratio: 1.0,
                ..*camera
            },
            place(camera, sample),
        )
    }),
    ("the film's aspect", |camera, sample| {
        let aspect_ratio = camera.film.x as f32 / camera.film.y as f32;
        through(
            &PinholeCamera {
                aspect_ratio,
                ..*camera
            },
            place(camera, sample),
        )
    }),
    ("the inverse aspect", |camera, sample| {
        let aspect_ratio = 1.0 / camera.aspect_ratio;
        through(
            &PinholeCamera {
                aspect_ratio,
                ..*camera
            },
            place(camera, sample),
        )
    }),
    ("y down", |camera, sample| {
        through(camera, place(camera, sample) * Vec2::new(1.0, -1.0))
    }),
    ("no offset", |camera, sample| {
        through(
            camera,
            place(
                camera,
                Sample {
                    offset: Vec2::splat(0.5),
                    ..sample
                },
            ),
        )
    }),
    ("the corner of the pixel", |camera, sample| {
        through(
            camera,
            place(
                camera,
                Sample {
                    offset: Vec2::ZERO,
                    ..sample
                },
            ),
        )
    }),
    ("one offset for both", |camera, sample| {
        through(
            camera,
            place(
                camera,
                Sample {
                    offset: sample.offset.xx(),
                    ..sample
                },
            ),
        )
    }),
    ("the offset subtracted", |camera, sample| {
        through(
            camera,
            place(
                camera,
                Sample {
                    offset: -sample.offset,
                    ..sample
                },
            ),
        )
    }),
    ("not of length one", |camera, sample| {
        let ray = through(camera, place(camera, sample));
        Ray {
            dir: ray.dir / ray.dir.z.abs(),
            ..ray
        }
    }),
    ("from the sensor", |camera, sample| {
        let ray = through(camera, place(camera, sample));
        Ray {
            origin: ray.dir,
            ..ray
        }
    }),
    ("the film's height for both", |camera, sample| {
        let film = glam::UVec2::splat(camera.film.y);
        through(camera, place(&PinholeCamera { film, ..*camera }, sample))
    }),
];
