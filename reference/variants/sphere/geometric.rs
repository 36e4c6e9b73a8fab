// Solves the problem geometrically: finds the point on the ray closest to the centre and goes half
// the length of the chord in either direction. See Haines, "Essential Ray Tracing Algorithms", in
// Glassner (editor), "An Introduction to Ray Tracing", 1989.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let to_center = self.center - ray.origin;
        let closest_approach = to_center.dot(ray.dir);
        let distance_squared = to_center.length_squared() - closest_approach.powi(2);
        let half_chord_squared = self.radius.powi(2) - distance_squared;
        if half_chord_squared < 0.0 {
            return None;
        }

        let half_chord = half_chord_squared.sqrt();
        let near = closest_approach - half_chord;
        let far = closest_approach + half_chord;

        let t = [near, far].into_iter().find(|t| ray.range.contains(*t))?;
        Some(self.trace_at(ray, t))
    }
}
