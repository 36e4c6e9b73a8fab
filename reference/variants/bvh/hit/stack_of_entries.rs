// Traverses the tree with a stack of nodes, each with the distance at which the ray enters its box.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        let mut ray = *ray;
        let mut closest = None;
        let mut open = vec![(root, root.bbox.hit(&ray, ray.range)?.min)];
        while let Some((node, entry)) = open.pop() {
            // A closer hit may have been found after the node was pushed.
            if entry > ray.range.max {
                continue;
            }
            if node.is_leaf() {
                self.test_leaf(node, &mut ray, &mut closest);
                continue;
            }
            let entered = |index: usize| {
                let child = &self.nodes[index];
                Some((child, child.bbox.hit(&ray, ray.range)?.min))
            };
            match (entered(node.l), entered(node.r)) {
                // The nearer child is pushed last, so that it is popped first.
                (Some(l), Some(r)) if l.1 <= r.1 => open.extend([r, l]),
                (Some(l), Some(r)) => open.extend([l, r]),
                (l, r) => open.extend(l.or(r)),
            }
        }
        closest
    }
}
