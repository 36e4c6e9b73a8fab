// Computes dot and cross products with fused multiply-adds. The cross product of two parallel
// vectors is then not exactly 0 if the products of their components are rounded.

use glam::Vec3;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let trace = self.cramer(ray, |a, b, c| dot(a, cross(b, c)))?;
        let t = Vec3::splat(trace.distance);
        Some(Trace {
            position: ray.dir.mul_add(t, ray.origin),
            ..trace
        })
    }
}

fn dot(a: Vec3, b: Vec3) -> f32 {
    a.x.mul_add(b.x, a.y.mul_add(b.y, a.z * b.z))
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    let component = |i: usize, j: usize| a[i].mul_add(b[j], -(a[j] * b[i]));
    Vec3::new(component(1, 2), component(2, 0), component(0, 1))
}
