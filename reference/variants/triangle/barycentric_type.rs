// Defines a type for barycentric coordinates. Multiplying it by three values gives their weighted
// sum.

use std::ops::{Add, Mul};

use glam::Vec3;

/// The weights of p0, p1 and p2.
#[derive(Clone, Copy)]
struct Barycentric(f32, f32, f32);

impl Barycentric {
    fn is_inside(self) -> bool {
        let Barycentric(w, u, v) = self;
        w >= 0.0 && u >= 0.0 && v >= 0.0
    }
}

impl<T: Add<Output = T>> Mul<[T; 3]> for Barycentric
where
    f32: Mul<T, Output = T>,
{
    type Output = T;

    fn mul(self, [a, b, c]: [T; 3]) -> T {
        self.0 * a + self.1 * b + self.2 * c
    }
}

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let corners = [self.p0, self.p1, self.p2];
        let positions = corners.map(|corner| corner.position - ray.origin);
        let weights = weights(positions, ray.dir)?;
        // The weighted sum of the corners is on the ray, whose direction has length one.
        let t = (weights * positions).dot(ray.dir);
        (weights.is_inside() && ray.range.contains(t)).then(|| Trace {
            distance: t,
            position: ray.at(t),
            normal: (weights * corners.map(|corner| corner.normal)).normalize(),
            uv: weights * corners.map(|corner| corner.uv),
            origin: ray.origin,
            shape: self.shape,
        })
    }
}

/// Returns the weights of the point where a line through (0, 0, 0) hits the plane through the three
/// corners.
fn weights([a, b, c]: [Vec3; 3], dir: Vec3) -> Option<Barycentric> {
    let (e1, e2) = (b - a, c - a);
    let across = dir.cross(e2);
    let determinant = e1.dot(across);
    if determinant == 0.0 {
        return None;
    }
    let u = -a.dot(across) / determinant;
    let v = -dir.dot(a.cross(e1)) / determinant;
    Some(Barycentric(1.0 - u - v, u, v))
}
