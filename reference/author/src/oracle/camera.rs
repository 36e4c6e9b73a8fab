//! Computes the directions of camera rays by interpolating between the four corners of the sensor.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, dvec3};
use protocol::{PinholeCamera, Sample};

/// Returns the direction of the ray through a position on the film, as a unit vector.
pub fn direction(camera: &PinholeCamera, sample: Sample) -> DVec3 {
    // Half of the sensor's height, from a right triangle whose base has length 1.
    let top = libm::tan(f64::from(camera.vertical_fov) * PI / 360.0);
    let right = top * f64::from(camera.aspect_ratio);

    let film: DVec2 = camera.film.as_dvec2();
    let position = (sample.pixel.as_dvec2() + sample.offset.as_dvec2()) / film;
    let row = |y: f64| {
        let (from, to) = (dvec3(-right, y, -1.0), dvec3(right, y, -1.0));
        from.lerp(to, position.x)
    };
    row(-top).lerp(row(top), position.y).normalize()
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, uvec2, vec2};

    use super::*;

    #[test]
    fn corner_and_middle_directions_match_hand_computed_values() {
        // tan 45° = 1, so the sensor is 2 high and 4 wide.
        let camera = PinholeCamera {
            vertical_fov: 90.0,
            aspect_ratio: 2.0,
            film: uvec2(8, 4),
        };
        let toward = |x, y| dvec3(x, y, -1.0).normalize();
        let cases = [
            (uvec2(0, 0), Vec2::ZERO, toward(-2.0, -1.0)),
            (uvec2(4, 2), Vec2::ZERO, toward(0.0, 0.0)),
            (uvec2(7, 3), vec2(0.5, 0.5), toward(1.75, 0.75)),
        ];
        for (pixel, offset, expected) in cases {
            let found = direction(&camera, Sample { pixel, offset });
            assert!(found.abs_diff_eq(expected, 1e-15), "{pixel} {found}");
        }
    }
}
