// Measures in pixels, as is usual in computer vision: the focal length is the distance of the film
// from the pinhole. See Hartley and Zisserman, "Multiple View Geometry in Computer Vision" (2nd
// edition), section 6.1. Converts degrees with a rounded constant and multiplies by reciprocals.

use protocol::Interval;

/// One degree in radians.
const DEGREE: f32 = 0.0174533;

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let film = self.film.as_vec2();
        let focal_length = 0.5 * film.y * (0.5 * DEGREE * self.vertical_fov).tan().recip();
        // The ratio of a pixel's width to its height on the sensor.
        let pixel_aspect = self.aspect_ratio * film.y * film.x.recip();
        let from_middle = pixel.as_vec2() - 0.5 * film + offset;
        let dir = Vec3::new(pixel_aspect * from_middle.x, from_middle.y, -focal_length);
        Ray {
            origin: Vec3::ZERO,
            dir: dir * (1.0 / dir.dot(dir).sqrt()),
            range: Interval::AHEAD,
        }
    }
}
