// Computes the point on the ray closest to the centre in world space and compares its distance from
// the centre with the radius.

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let middle = (self.center - ray.origin).dot(ray.dir);
        let distance = ray.at(middle).distance(self.center);
        if distance > self.radius {
            return None;
        }
        let half_chord = (self.radius * self.radius - distance * distance).sqrt();
        let roots = [middle - half_chord, middle + half_chord];
        let t = roots.into_iter().find(|t| ray.range.contains(*t))?;
        Some(self.trace_at(ray, t))
    }
}
