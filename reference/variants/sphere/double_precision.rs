// Computes everything in double precision and rounds once at the end.

use glam::DVec3;

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let (origin, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
        let center = self.center.as_dvec3();
        let o = origin - center;
        let a = dir.length_squared();
        let half_b = o.dot(dir);
        let c = o.length_squared() - f64::from(self.radius).powi(2);
        let discriminant = half_b * half_b - a * c;
        if discriminant < 0.0 {
            return None;
        }

        let roots = [-discriminant.sqrt(), discriminant.sqrt()].map(|root| (root - half_b) / a);
        let t = roots.into_iter().find(|t| ray.range.contains(*t as f32))?;
        let position: DVec3 = origin + t * dir;
        let normal = (position - center).normalize().as_vec3();
        Some(Trace {
            distance: t as f32,
            position: position.as_vec3(),
            normal,
            uv: Sphere::uv(normal),
            origin: ray.origin,
            shape: self.shape,
        })
    }
}
