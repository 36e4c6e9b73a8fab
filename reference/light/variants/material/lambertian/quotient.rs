// Divides `evaluate` by `pdf` for the attenuation. The given sampling never returns a direction at
// the horizon, so the density is never zero.

impl Lambertian {
    pub fn evaluate(&self, out: Vec3, incoming: Vec3) -> Vec3 {
        if out.z <= 0.0 || incoming.z <= 0.0 {
            return Vec3::ZERO;
        }
        let fraction = self.albedo * FRAC_1_PI;
        fraction * incoming.z
    }

    pub fn pdf(&self, out: Vec3, incoming: Vec3) -> f32 {
        if out.z <= 0.0 || incoming.z <= 0.0 {
            return 0.0;
        }
        incoming.z / std::f32::consts::PI
    }

    pub fn scatter(&self, out: Vec3, random: Vec2) -> Scattered {
        let direction = sample_cosine_hemisphere(random);
        let pdf = self.pdf(out, direction);
        Scattered {
            direction,
            attenuation: self.evaluate(out, direction) / pdf,
            pdf: Some(pdf),
        }
    }
}
