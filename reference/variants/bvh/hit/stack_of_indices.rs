// Traverses the tree with a stack of indices and tests a box when its node is popped.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest: Option<Trace> = None;
        let mut open = Vec::from_iter((self.root < self.nodes.len()).then_some(self.root));
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            // The ray, shortened to the closest hit so far. Used for boxes and for primitives.
            let mut rest = *ray;
            rest.range.max = closest.map_or(ray.range.max, |closest| closest.distance);
            let entry = |node: &Node| Some(node.bbox.hit(ray, rest.range)?.min);
            if entry(node).is_none() {
                continue;
            }
            if node.is_leaf() {
                let primitives = &self.primitives[node.start..node.start + node.size];
                let traces = primitives.iter().map(|primitive| primitive.hit(&rest));
                closest = traces.fold(closest, Trace::nearer);
                continue;
            }
            // `None` is less than any number, so a missed child is pushed last. When it is popped,
            // its box test fails.
            if entry(&self.nodes[node.l]) < entry(&self.nodes[node.r]) {
                open.extend([node.r, node.l]);
            } else {
                open.extend([node.l, node.r]);
            }
        }
        closest
    }
}
