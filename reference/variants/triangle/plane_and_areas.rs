// Intersects the ray with the triangle's plane first. The weights are computed from the signed
// areas of the three triangles that the point forms with the edges. See Marschner and Shirley,
// "Fundamentals of Computer Graphics" (4th edition), section 2.7.2.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;

        let face = e1.cross(e2);
        let slope = face.dot(ray.dir);
        if slope == 0.0 {
            return None;
        }
        let t = face.dot(self.p0.position - ray.origin) / slope;
        if !ray.range.contains(t) {
            return None;
        }

        let point = ray.at(t);
        let part = |from: Vertex, to: Vertex| {
            let area = (to.position - from.position).cross(point - from.position);
            area.dot(face) / face.length_squared()
        };
        let (w, u, v) = (
            part(self.p1, self.p2),
            part(self.p2, self.p0),
            part(self.p0, self.p1),
        );
        (w >= 0.0 && u >= 0.0 && v >= 0.0).then(|| self.trace_at(ray, t, u, v))
    }
}
