//! Boxes and cameras in single precision: several right formulas, and wrong ones.

use glam::{Vec2, Vec2Swizzles, Vec3};
use protocol::{Interval, PinholeCamera, Ray, Sample};

pub type BoxHit = fn(&Ray, Interval, Vec3, Vec3) -> Option<Interval>;
pub type SampleRay = fn(&PinholeCamera, Sample) -> Ray;

/// When the ray is in all three slabs, whenever that is; may be empty.
fn slabs(ray: &Ray, min: Vec3, max: Vec3) -> Interval {
    let inverse = 1.0 / ray.dir;
    let (a, b) = ((min - ray.origin) * inverse, (max - ray.origin) * inverse);
    Interval::new(a.min(b).max_element(), a.max(b).min_element())
}

fn clipped(inside: Interval, times: Interval) -> Option<Interval> {
    let both = Interval::new(inside.min.max(times.min), inside.max.min(times.max));
    (both.min <= both.max).then_some(both)
}

/// Axis by axis, with a case for a direction of 0, dividing instead of multiplying.
fn by_axes(ray: &Ray, times: Interval, min: Vec3, max: Vec3) -> Option<Interval> {
    let mut left = times;
    for axis in 0..3 {
        let (o, d) = (ray.origin[axis], ray.dir[axis]);
        if d == 0.0 {
            if o < min[axis] || o > max[axis] {
                return None;
            }
            continue;
        }
        let (mut enter, mut leave) = ((min[axis] - o) / d, (max[axis] - o) / d);
        if enter > leave {
            std::mem::swap(&mut enter, &mut leave);
        }
        left = clipped(Interval::new(enter, leave), left)?;
    }
    Some(left)
}

pub const BOXES: [(&str, BoxHit); 2] = [
    ("slabs", |ray, times, min, max| {
        clipped(slabs(ray, min, max), times)
    }),
    ("axis by axis", by_axes),
];

pub const WRONG_BOXES: [(&str, BoxHit); 13] = [
    ("never", |_, _, _, _| None),
    ("always", |_, times, _, _| Some(times)),
    ("ignores times", |ray, _, min, max| {
        clipped(slabs(ray, min, max), Interval::AHEAD)
    }),
    ("whole line", |ray, _, min, max| {
        let inside = slabs(ray, min, max);
        (inside.min <= inside.max).then_some(inside)
    }),
    ("the ray's range", |ray, _, min, max| {
        clipped(slabs(ray, min, max), ray.range)
    }),
    ("both ends must be in times", |ray, times, min, max| {
        let inside = slabs(ray, min, max);
        let both = times.contains(inside.min) && times.contains(inside.max);
        (both && inside.min <= inside.max).then_some(inside)
    }),
    ("one end must be in times", |ray, times, min, max| {
        let inside = slabs(ray, min, max);
        let one = times.contains(inside.min) || times.contains(inside.max);
        clipped(inside, times).filter(|_| one)
    }),
    ("not clipped", |ray, times, min, max| {
        let inside = slabs(ray, min, max);
        clipped(inside, times).map(|_| inside)
    }),
    ("only clipped at the start", |ray, times, min, max| {
        let inside = slabs(ray, min, max);
        clipped(inside, times).map(|cut| Interval::new(cut.min, inside.max))
    }),
    ("slabs not compared", |ray, times, min, max| {
        let inverse = 1.0 / ray.dir;
        let (a, b) = ((min - ray.origin) * inverse, (max - ray.origin) * inverse);
        let (enter, leave) = (a.min(b), a.max(b));
        let each = (0..3).all(|i| clipped(Interval::new(enter[i], leave[i]), times).is_some());
        each.then(|| {
            Interval::new(
                enter.max_element().max(times.min),
                leave.min_element().min(times.max),
            )
        })
    }),
    ("no swap for negative directions", |ray, times, min, max| {
        let inverse = 1.0 / ray.dir;
        let (a, b) = ((min - ray.origin) * inverse, (max - ray.origin) * inverse);
        clipped(Interval::new(a.max_element(), b.min_element()), times)
    }),
    ("strictly", |ray, times, min, max| {
        clipped(slabs(ray, min, max), times).filter(|cut| cut.min < cut.max)
    }),
    ("parallel rays miss", |ray, times, min, max| {
        let zero = (0..3).any(|i| ray.dir[i] == 0.0);
        clipped(slabs(ray, min, max), times).filter(|_| !zero)
    }),
];

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
