// Evaluates in double precision.

impl Lambertian {
    pub fn evaluate(&self, out: Vec3, incoming: Vec3) -> Vec3 {
        let factor = f64::from(incoming.z.max(0.0)) / std::f64::consts::PI;
        let factor = if out.z > 0.0 { factor } else { 0.0 };
        (self.albedo.as_dvec3() * factor).as_vec3()
    }

    pub fn pdf(&self, out: Vec3, incoming: Vec3) -> f32 {
        let cosine = f64::from(if out.z > 0.0 { incoming.z } else { 0.0 });
        (cosine.max(0.0) / std::f64::consts::PI) as f32
    }

    pub fn scatter(&self, _out: Vec3, random: Vec2) -> Scattered {
        let direction = sample_cosine_hemisphere(random);
        Scattered {
            direction,
            attenuation: self.albedo,
            pdf: Some(direction.z.max(0.0) * FRAC_1_PI),
        }
    }
}
