// Traversal tests the box of a node when it reaches the node. By then, the closest hit so far has
// shortened the ray.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        if self.root < self.nodes.len() {
            self.traverse(self.root, &mut ray.clone(), &mut closest);
        }
        closest
    }

    fn traverse(&self, index: usize, ray: &mut Ray, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.bbox.hit(ray, ray.range).is_none() {
            return;
        }
        if node.is_leaf() {
            return self.test_leaf(node, ray, closest);
        }

        // A missed box is treated as infinitely far away. Even if its node is visited first, the
        // box test there fails.
        let entry = |child: usize| {
            let inside = self.nodes[child].bbox.hit(ray, ray.range);
            inside.map_or(f32::INFINITY, |inside| inside.min)
        };
        let (first, second) = if entry(node.l) <= entry(node.r) {
            (node.l, node.r)
        } else {
            (node.r, node.l)
        };
        self.traverse(first, ray, closest);
        self.traverse(second, ray, closest);
    }
}
