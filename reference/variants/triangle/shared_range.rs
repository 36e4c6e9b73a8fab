// Tests the range with a function from this solution's sphere.rs.

use crate::sphere::first_in_range;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let [p0, p1, p2] = [self.p0, self.p1, self.p2].map(|corner| corner.position);
        let normal = (p1 - p0).cross(p2 - p0);
        let slope = normal.dot(ray.dir);
        if slope == 0.0 {
            return None;
        }
        let t = first_in_range(ray, [normal.dot(p0 - ray.origin) / slope])?;
        let point = ray.at(t) - p0;
        let u = point.cross(p2 - p0).dot(normal) / normal.length_squared();
        let v = (p1 - p0).cross(point).dot(normal) / normal.length_squared();
        let w = 1.0 - u - v;
        (u >= 0.0 && v >= 0.0 && w >= 0.0).then(|| self.trace_at(ray, t, u, v))
    }
}
