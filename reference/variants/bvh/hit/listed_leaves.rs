// Traversal first lists all leaves that the ray hits and then tests them from near to far.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut leaves = Vec::new();
        if let Some(root) = self.nodes.get(self.root) {
            self.list_leaves(root, ray, &mut leaves);
        }
        leaves.sort_by(|a, b| a.0.total_cmp(&b.0));

        let mut closest: Option<Trace> = None;
        for (entry, leaf) in leaves {
            if closest.is_some_and(|closest| closest.distance < entry) {
                break;
            }
            for primitive in &self.primitives[leaf.start..leaf.start + leaf.size] {
                closest = Trace::nearer(closest, primitive.hit(ray));
            }
        }
        closest
    }

    /// Lists the leaves below `node` whose boxes the ray hits, with their entry distances.
    fn list_leaves<'a>(&'a self, node: &'a Node, ray: &Ray, leaves: &mut Vec<(f32, &'a Node)>) {
        let Some(inside) = node.bbox.hit(ray, ray.range) else {
            return;
        };
        if node.is_leaf() {
            leaves.push((inside.min, node));
        } else {
            self.list_leaves(&self.nodes[node.l], ray, leaves);
            self.list_leaves(&self.nodes[node.r], ray, leaves);
        }
    }
}
