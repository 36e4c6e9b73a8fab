// During traversal, each node returns its closest hit, and a parent picks the nearer of its
// children's hits.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        self.nearest(root, ray)
    }

    /// Returns the closest hit below `node`.
    fn nearest(&self, node: &Node, ray: &Ray) -> Option<Trace> {
        if node.is_leaf() {
            let primitives = &self.primitives[node.start..node.start + node.size];
            let traces = primitives.iter().map(|primitive| primitive.hit(ray));
            return traces.fold(None, Trace::nearer);
        }

        let enter = |index: usize| {
            let child = &self.nodes[index];
            Some((child, child.bbox.hit(ray, ray.range)?.min))
        };
        let (first, second) = match (enter(node.l), enter(node.r)) {
            (Some(l), Some(r)) if l.1 <= r.1 => (l, Some(r)),
            (Some(l), Some(r)) => (r, Some(l)),
            (l, r) => (l.or(r)?, None),
        };
        let trace = self.nearest(first.0, ray);
        let limit = trace.map_or(ray.range.max, |trace| trace.distance);
        match second {
            Some((second, entry)) if entry <= limit => {
                let rest = ray.within(ray.range.min, limit);
                Trace::nearer(trace, self.nearest(second, &rest))
            }
            _ => trace,
        }
    }
}
