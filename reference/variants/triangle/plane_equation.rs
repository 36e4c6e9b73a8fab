// Uses the equation of the triangle's plane, n · x + k = 0, in world space, with a normal of length
// one. Each weight is the area of the triangle that the point on the plane forms with two of the
// corners.

use glam::Vec3;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let [a, b, c] = [self.p0, self.p1, self.p2].map(|corner| corner.position);
        let face = (b - a).cross(c - a);
        let inverse_area = 1.0 / face.length();
        // For a triangle without area, n and t are NaN.
        let n = face * inverse_area;
        let k = -n.dot(a);
        let slope = n.dot(ray.dir);
        if slope == 0.0 {
            return None;
        }
        let t = -(n.dot(ray.origin) + k) / slope;
        let point = ray.at(t);
        let area = |from: Vec3, to: Vec3| n.dot((from - point).cross(to - point)) * inverse_area;
        let (w, u, v) = (area(b, c), area(c, a), area(a, b));
        let inside = w >= 0.0 && u >= 0.0 && v >= 0.0;
        (inside && ray.range.contains(t)).then(|| self.trace_at(ray, t, u, v))
    }
}
