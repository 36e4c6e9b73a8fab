// Clips the ray against six planes, each given by a normal and a point. This works for any convex
// polyhedron. See Cyrus and Beck, "Generalized two- and three-dimensional clipping", Computers and
// Graphics 3(1), 1978.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let mut inside = times;
        for (outward, point) in self.planes() {
            let height = outward.dot(ray.origin - point);
            let climb = outward.dot(ray.dir);
            if climb > 0.0 {
                inside.max = inside.max.min(-height / climb);
            } else if climb < 0.0 {
                inside.min = inside.min.max(-height / climb);
            } else if height > 0.0 {
                return None;
            }
        }
        (!inside.is_empty()).then_some(inside)
    }

    /// Returns the outward normal of each face, and a point on the face.
    fn planes(&self) -> [(Vec3, Vec3); 6] {
        [
            (Vec3::NEG_X, self.min),
            (Vec3::NEG_Y, self.min),
            (Vec3::NEG_Z, self.min),
            (Vec3::X, self.max),
            (Vec3::Y, self.max),
            (Vec3::Z, self.max),
        ]
    }
}
