// Projects the triangle along the ray, onto two axes perpendicular to the ray. In this plane the
// ray is a point, and the weights are ratios of areas.

use glam::Vec2;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let (right, up) = ray.dir.any_orthonormal_pair();
        let seen = |corner: Vertex| {
            let s = corner.position - ray.origin;
            (Vec2::new(s.dot(right), s.dot(up)), s.dot(ray.dir))
        };
        let [(a, depth_a), (b, depth_b), (c, depth_c)] =
            [seen(self.p0), seen(self.p1), seen(self.p2)];

        // The ray is projected to the point (0, 0).
        let (w, u, v) = (b.perp_dot(c), c.perp_dot(a), a.perp_dot(b));
        let area = w + u + v;
        if area == 0.0 {
            return None;
        }
        let (w, u, v) = (w / area, u / area, v / area);
        if w.min(u).min(v) < 0.0 {
            return None;
        }
        let t = w * depth_a + u * depth_b + v * depth_c;
        ray.range.contains(t).then(|| self.trace_at(ray, t, u, v))
    }
}
