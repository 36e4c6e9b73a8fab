// Interpolates normals and texture coordinates with one generic method of a trait, which everything
// has that can be added and scaled.

use std::ops::{Add, Mul};

use glam::Vec3;

trait Interpolate: Copy + Add<Output = Self> + Mul<f32, Output = Self> {
    /// Returns the weighted sum of three values.
    fn interpolate(values: [Self; 3], weights: Vec3) -> Self {
        let [a, b, c] = values;
        a * weights.x + b * weights.y + c * weights.z
    }
}

impl<T: Copy + Add<Output = T> + Mul<f32, Output = T>> Interpolate for T {}

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let corners = [self.p0, self.p1, self.p2];
        let (weights, t) = self.solve(ray)?;
        if weights.cmplt(Vec3::ZERO).any() || !ray.range.contains(t) {
            return None;
        }
        Some(Trace {
            distance: t,
            position: ray.at(t),
            normal: Interpolate::interpolate(corners.map(|corner| corner.normal), weights)
                .normalize(),
            uv: Interpolate::interpolate(corners.map(|corner| corner.uv), weights),
            origin: ray.origin,
            shape: self.shape,
        })
    }

    /// Returns the weights of the corners, and t, where the ray's line hits the triangle's plane.
    fn solve(&self, ray: &Ray) -> Option<(Vec3, f32)> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;
        let p = ray.dir.cross(e2);
        let determinant = e1.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let s = ray.origin - self.p0.position;
        let q = s.cross(e1);
        let (u, v) = (s.dot(p) / determinant, ray.dir.dot(q) / determinant);
        Some((Vec3::new(1.0 - u - v, u, v), e2.dot(q) / determinant))
    }
}
