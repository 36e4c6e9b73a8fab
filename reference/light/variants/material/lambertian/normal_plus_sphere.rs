// Adds a point of the unit sphere to the normal. For these numbers, the sum points in exactly the
// direction that Malley's method returns: the cosine of its angle is the square root of 1 − x.

use framework::math::sin_cos;

impl Lambertian {
    pub fn evaluate(&self, out: Vec3, incoming: Vec3) -> Vec3 {
        Vec3::splat(self.pdf(out, incoming)) * self.albedo
    }

    pub fn pdf(&self, out: Vec3, incoming: Vec3) -> f32 {
        match (out.z > 0.0, incoming.z > 0.0) {
            (true, true) => FRAC_1_PI * incoming.dot(Vec3::Z),
            _ => 0.0,
        }
    }

    pub fn scatter(&self, out: Vec3, random: Vec2) -> Scattered {
        let direction = if random.x < 0.999 {
            let height = 1.0 - 2.0 * random.x;
            let radius = (1.0 - height * height).max(0.0).sqrt();
            let (sin, cos) = sin_cos(std::f32::consts::TAU * random.y);
            (Vec3::Z + Vec3::new(radius * cos, radius * sin, height)).normalize()
        } else {
            // The point is almost opposite to the normal, where rounding would decide.
            sample_cosine_hemisphere(random)
        };
        Scattered {
            direction,
            attenuation: self.albedo,
            pdf: Some(self.pdf(out, direction)),
        }
    }
}
