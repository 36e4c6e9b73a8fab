// Computes the roots from their mean, which is the distance of the closest approach, and their
// product, which is the power of the origin with respect to the sphere: mean ± √(mean² − product).

impl Sphere {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // The power of a point is the product near · far, which is the same for all lines through
        // the point.
        let from_center = ray.origin.distance(self.center);
        let product = (from_center - self.radius) * (from_center + self.radius);
        let middle = (self.center - ray.origin)
            .project_onto_normalized(ray.dir)
            .dot(ray.dir);
        if middle * middle < product {
            return None;
        }

        let half_chord = (middle * middle - product).sqrt();
        let t = Some(middle - half_chord)
            .filter(|near| ray.range.contains(*near))
            .or(Some(middle + half_chord))
            .filter(|t| ray.range.contains(*t))?;
        Some(self.trace_at(ray, t))
    }
}
