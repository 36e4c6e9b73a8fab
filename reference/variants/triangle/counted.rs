// Counts how often a triangle is tested and hit, in counters that all threads share. No answer
// depends on them.

use std::sync::atomic::{AtomicU64, Ordering};

static TESTED: AtomicU64 = AtomicU64::new(0);
static HIT: AtomicU64 = AtomicU64::new(0);

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        TESTED.fetch_add(1, Ordering::Relaxed);
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;
        let normal = e1.cross(e2);
        let determinant = -ray.dir.dot(normal);
        if determinant == 0.0 {
            return None;
        }
        let s = ray.origin - self.p0.position;
        let s_x_d = s.cross(ray.dir);
        let u = e2.dot(s_x_d) / determinant;
        let v = -e1.dot(s_x_d) / determinant;
        let t = s.dot(normal) / determinant;
        if u < 0.0 || v < 0.0 || u + v > 1.0 || !ray.range.contains(t) {
            return None;
        }
        HIT.fetch_add(1, Ordering::Relaxed);
        Some(self.trace_at(ray, t, u, v))
    }
}
