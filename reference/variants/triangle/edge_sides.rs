// Computes signed volumes: the sign of the scalar triple product of the ray's direction and two
// corners determines on which side of the edge between those corners the ray passes (Ericson,
// "Real-Time Collision Detection", section 5.3.4). Here, the edge itself is used instead of one of
// the corners, since rounding errors would otherwise be too large for small triangles.

use glam::Vec3;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let a = self.p0.position - ray.origin;
        let b = self.p1.position - ray.origin;
        let c = self.p2.position - ray.origin;
        // d · (to × from) = d · ((to − from) × from)
        let volume = |from: Vec3, to: Vec3| ray.dir.dot((to - from).cross(from));

        let (w, u, v) = (volume(b, c), volume(c, a), volume(a, b));
        let sum = u + v + w;
        if sum == 0.0 {
            return None;
        }
        let (w, u, v) = (w / sum, u / sum, v / sum);
        if w < 0.0 || u < 0.0 || v < 0.0 {
            return None;
        }

        // The weighted sum of the corners is on the ray, whose direction has length one.
        let t = (w * a + u * b + v * c).dot(ray.dir);
        ray.range.contains(t).then(|| self.trace_at(ray, t, u, v))
    }
}
