// Traversal puts the children that the ray hits in a sorted list and never shortens the ray itself.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        self.nearest(root, ray, None)
    }

    /// Returns the nearer of `closest` and the closest hit below `node`.
    fn nearest(&self, node: &Node, ray: &Ray, mut closest: Option<Trace>) -> Option<Trace> {
        if node.is_leaf() {
            let primitives = &self.primitives[node.start..node.start + node.size];
            let traces = primitives.iter().map(|primitive| primitive.hit(ray));
            return traces.fold(closest, Trace::nearer);
        }

        let children = [node.l, node.r].map(|index| &self.nodes[index]);
        let hit = children
            .into_iter()
            .filter_map(|child| Some((child.bbox.hit(ray, ray.range)?.min, child)));
        let mut ahead: Vec<(f32, &Node)> = hit.collect();
        ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (entry, child) in ahead {
            if closest.is_none_or(|closest| entry < closest.distance) {
                closest = self.nearest(child, ray, closest);
            }
        }
        closest
    }
}
