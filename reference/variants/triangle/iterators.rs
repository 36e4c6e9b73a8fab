// Computes everything with iterators over the three corners, without naming any of them.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let corners = [self.p0, self.p1, self.p2];
        let from_origin = corners.map(|corner| corner.position - ray.origin);
        // For each corner, the volume whose sign says on which side of the opposite edge the ray
        // passes.
        let opposite = from_origin.iter().cycle().skip(1);
        let opposite = opposite.zip(from_origin.iter().cycle().skip(2));
        let sides = opposite.map(|(from, to)| ray.dir.dot((to - from).cross(*from)));
        let sides: Vec<f32> = sides.take(3).collect();

        let sum: f32 = sides.iter().sum();
        let weights: Vec<f32> = sides.iter().map(|side| side / sum).collect();
        if sum == 0.0 || weights.iter().any(|weight| *weight < 0.0) {
            return None;
        }
        let along = from_origin.iter().map(|corner| corner.dot(ray.dir));
        let t = weights.iter().zip(along).map(|(w, along)| w * along).sum();
        ray.range.contains(t).then(|| {
            let weighted = || weights.iter().zip(corners);
            Trace {
                distance: t,
                position: ray.at(t),
                normal: weighted()
                    .map(|(weight, corner)| weight * corner.normal)
                    .sum::<glam::Vec3>()
                    .normalize(),
                uv: weighted().map(|(weight, corner)| weight * corner.uv).sum(),
                origin: ray.origin,
                shape: self.shape,
            }
        })
    }
}
