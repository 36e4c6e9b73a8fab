// Writes the formula for a coordinate once, as a macro that is expanded for x and y.

use framework::math::tan;

/// The position along an axis, which runs from −1 to 1 across the film.
macro_rules! across_film {
    ($camera:expr, $pixel:expr, $offset:expr, $axis:ident) => {
        2.0 * ($pixel.$axis as f32 + $offset.$axis) / $camera.film.$axis as f32 - 1.0
    };
}

impl Camera {
    pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let half_height = tan(self.vertical_fov.to_radians() / 2.0);
        let x = across_film!(self, pixel, offset, x) * half_height * self.aspect_ratio;
        let y = across_film!(self, pixel, offset, y) * half_height;
        Ray::new(Vec3::ZERO, Vec3::new(x, y, -1.0))
    }
}
