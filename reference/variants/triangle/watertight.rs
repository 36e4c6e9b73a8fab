// Shears space so that the ray becomes the z-axis, and tests the edges in two dimensions. See
// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", Journal of Computer Graphics
// Techniques 2(1), 2013.

use glam::Vec3;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // z is the axis along which the direction has its largest component. x and y are the other
        // two axes, in the order that preserves the winding.
        let z = ray.dir.abs().max_position();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if ray.dir[z] < 0.0 {
            (x, y) = (y, x);
        }
        let shear = Vec3::new(ray.dir[x], ray.dir[y], 1.0) / ray.dir[z];

        let sheared = |corner: Vertex| {
            let from_origin = corner.position - ray.origin;
            Vec3::new(
                from_origin[x] - shear.x * from_origin[z],
                from_origin[y] - shear.y * from_origin[z],
                shear.z * from_origin[z],
            )
        };
        let (a, b, c) = (sheared(self.p0), sheared(self.p1), sheared(self.p2));

        let (of_a, of_b, of_c) = (edge(c, b), edge(a, c), edge(b, a));
        let least = of_a.min(of_b).min(of_c);
        let most = of_a.max(of_b).max(of_c);
        let determinant = of_a + of_b + of_c;
        if least < 0.0 && most > 0.0 || determinant == 0.0 {
            return None;
        }

        let t = (of_a * a.z + of_b * b.z + of_c * c.z) / determinant;
        ray.range
            .contains(t)
            .then(|| self.trace_at(ray, t, of_b / determinant, of_c / determinant))
    }
}

/// Returns a number whose sign indicates on which side of the edge from `a` to `b` the ray passes.
/// It is computed in double precision if single precision gives zero.
fn edge(a: Vec3, b: Vec3) -> f32 {
    let side = a.x * b.y - a.y * b.x;
    if side != 0.0 {
        return side;
    }
    let exactly = |a: f32, b: f32| f64::from(a) * f64::from(b);
    (exactly(a.x, b.y) - exactly(a.y, b.x)) as f32
}
