// Clamps both cosines instead of branching.

impl Lambertian {
    pub fn evaluate(&self, out: Vec3, incoming: Vec3) -> Vec3 {
        let is_above = f32::from(u8::from(out.z > 0.0));
        self.albedo * is_above * incoming.z.max(0.0) * FRAC_1_PI
    }

    pub fn pdf(&self, out: Vec3, incoming: Vec3) -> f32 {
        Lambertian { albedo: Vec3::ONE }.evaluate(out, incoming).x
    }

    pub fn scatter(&self, out: Vec3, random: Vec2) -> Scattered {
        let mut scattered = Scattered {
            direction: sample_cosine_hemisphere(random),
            attenuation: self.albedo,
            pdf: None,
        };
        scattered.pdf = Some(self.pdf(out, scattered.direction));
        scattered
    }
}
