// Traversal shortens the ray and sorts pairs of an entry distance and an index.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        let mut shortened = *ray;
        let mut best = None;
        self.visit(self.root, &mut shortened, &mut best);
        best
    }

    /// Updates `best` with the hits below a node whose box the ray hits.
    fn visit(&self, index: usize, ray: &mut Ray, best: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.is_leaf() {
            for primitive in &self.primitives[node.start..node.start + node.size] {
                if let Some(trace) = primitive.hit(ray) {
                    ray.range.max = trace.distance;
                    *best = Some(trace);
                }
            }
            return;
        }
        let mut children = Vec::with_capacity(2);
        for child in [node.l, node.r] {
            if let Some(times) = self.nodes[child].bbox.hit(ray, ray.range) {
                children.push((times.min, child));
            }
        }
        children.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (enters, child) in children {
            if enters <= ray.range.max {
                self.visit(child, ray, best);
            }
        }
    }
}
