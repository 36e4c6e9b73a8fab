// Intersects the ray with the triangle's plane first, then drops the axis along which the face
// normal has its largest component and computes the weights in two dimensions. See Badouel, "An
// Efficient Ray-Polygon Intersection", Graphics Gems, 1990.

use glam::{Vec2, Vec3};

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;

        let face = e1.cross(e2);
        let slope = face.dot(ray.dir);
        if slope == 0.0 {
            return None;
        }
        let t = face.dot(self.p0.position - ray.origin) / slope;
        if !ray.range.contains(t) {
            return None;
        }

        let dropped = face.abs().max_position();
        let flat = |v: Vec3| Vec2::new(v[(dropped + 1) % 3], v[(dropped + 2) % 3]);
        let (e1, e2) = (flat(e1), flat(e2));
        let point = flat(ray.at(t) - self.p0.position);
        let area = e1.perp_dot(e2);
        let u = point.perp_dot(e2) / area;
        let v = e1.perp_dot(point) / area;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| self.trace_at(ray, t, u, v))
    }
}
