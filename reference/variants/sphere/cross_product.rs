// Computes the distance of the centre from the ray as the length of the cross product o × d, which
// is the area of a parallelogram whose base has length one.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let o = ray.origin - self.center;
        let distance_squared = o.cross(ray.dir).length_squared();
        let half_chord = (self.radius.powi(2) - distance_squared).sqrt();
        if half_chord.is_nan() {
            return None;
        }
        let middle = -o.dot(ray.dir);
        let (near, far) = (middle - half_chord, middle + half_chord);
        if ray.range.contains(near) {
            Some(self.trace_at(ray, near))
        } else {
            ray.range.contains(far).then(|| self.trace_at(ray, far))
        }
    }
}
