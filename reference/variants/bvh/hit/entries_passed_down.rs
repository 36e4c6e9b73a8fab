// During traversal, a parent tests the boxes of both children and passes the entry distances down.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        if let Some(root) = self.nodes.get(self.root) {
            let entry = root.bbox.hit(ray, ray.range).map(|inside| inside.min);
            self.traverse(root, entry, ray, &mut closest);
        }
        closest
    }

    /// Looks for a closer hit below `node`. `entry` is the distance at which the ray enters the
    /// node's box, or `None` if the ray misses it.
    fn traverse(&self, node: &Node, entry: Option<f32>, ray: &Ray, closest: &mut Option<Trace>) {
        let limit = closest.map_or(f32::INFINITY, |closest| closest.distance);
        if entry.is_none_or(|entry| entry >= limit) {
            return;
        }
        if node.is_leaf() {
            for primitive in &self.primitives[node.start..node.start + node.size] {
                *closest = Trace::nearer(primitive.hit(ray), *closest);
            }
            return;
        }

        let mut children = [node.l, node.r].map(|index| {
            let child = &self.nodes[index];
            let inside = child.bbox.hit(ray, ray.range);
            (child, inside.map(|inside| inside.min))
        });
        if let [(_, Some(l)), (_, Some(r))] = children
            && r < l
        {
            children.swap(0, 1);
        }
        for (child, entry) in children {
            self.traverse(child, entry, ray, closest);
        }
    }
}
