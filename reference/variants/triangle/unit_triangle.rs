// Transforms the ray with a matrix, computed once, that maps the triangle to (0,0), (1,0), (0,1)
// in the plane z = 0, where the test is trivial. The third column of the inverse matrix is the
// axis along which the face normal has its largest component. See Baldwin and Weber, "Fast
// Ray-Triangle Intersections by Coordinate Transformation", Journal of Computer Graphics
// Techniques 5(3), 2016.

use glam::{Mat3, Vec3};

#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    pub p0: Vertex,
    pub p1: Vertex,
    pub p2: Vertex,
    pub shape: u32,
    /// The matrix that maps e1 to the x-axis, e2 to the y-axis, and a coordinate axis to the
    /// z-axis.
    to_unit: Mat3,
}

impl Triangle {
    pub fn new(p0: Vertex, p1: Vertex, p2: Vertex, shape: u32) -> Self {
        let e1 = p1.position - p0.position;
        let e2 = p2.position - p0.position;
        let axis = Vec3::AXES[e1.cross(e2).abs().max_position()];
        let to_unit = Mat3::from_cols(e1, e2, axis).inverse();
        Triangle {
            p0,
            p1,
            p2,
            shape,
            to_unit,
        }
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let origin = self.to_unit * (ray.origin - self.p0.position);
        let dir = self.to_unit * ray.dir;

        // For a triangle without area, the matrix contains infinities or NaN, which fail all tests.
        let t = -origin.z / dir.z;
        let (u, v) = (origin.x + t * dir.x, origin.y + t * dir.y);
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (inside && ray.range.contains(t)).then(|| self.trace_at(ray, t, u, v))
    }
}
