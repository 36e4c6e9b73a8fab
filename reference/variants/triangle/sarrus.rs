// Applies Cramer's rule, computing each determinant by the rule of Sarrus: the sum of three
// products of three numbers each, minus the sum of three other such products.

use glam::Vec3;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        self.cramer(ray, sarrus)
    }
}

fn sarrus(a: Vec3, b: Vec3, c: Vec3) -> f32 {
    let down = a.x * b.y * c.z + b.x * c.y * a.z + c.x * a.y * b.z;
    let up = a.z * b.y * c.x + b.z * c.y * a.x + c.z * a.y * b.x;
    down - up
}
