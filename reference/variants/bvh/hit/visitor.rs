// Separates the traversal from what happens in a leaf: the traversal calls a closure, which returns
// the new end of the ray. A counter of visited leaves, which nothing depends on, shows why.

use std::sync::atomic::{AtomicUsize, Ordering};

/// The number of leaves that all rays have visited.
static VISITED: AtomicUsize = AtomicUsize::new(0);

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        self.visit_leaves(ray, &mut |leaf, end| {
            VISITED.fetch_add(1, Ordering::Relaxed);
            let rest = ray.within(ray.range.min, end);
            for primitive in &self.primitives[leaf.start..leaf.start + leaf.size] {
                closest = Trace::nearer(closest, primitive.hit(&rest));
            }
            closest.map_or(end, |closest| closest.distance)
        });
        closest
    }

    /// Calls a function with each leaf that the ray enters before its end, and with the end. The
    /// function returns the new end.
    fn visit_leaves(&self, ray: &Ray, visit: &mut impl FnMut(&Node, f32) -> f32) {
        let mut end = ray.range.max;
        let mut open = Vec::new();
        if let Some(root) = self.nodes.get(self.root) {
            let inside = root.bbox.hit(ray, ray.range);
            open.extend(inside.map(|inside| (inside.min, root)));
        }
        while let Some((entry, node)) = open.pop() {
            if entry > end {
                continue;
            }
            if node.is_leaf() {
                end = visit(node, end);
                continue;
            }
            let children = [node.l, node.r].map(|index| &self.nodes[index]);
            let height = open.len();
            open.extend(children.into_iter().filter_map(|child| {
                let inside = child.bbox.hit(ray, ray.range)?;
                (inside.min <= end).then_some((inside.min, child))
            }));
            // The last one is popped first.
            open[height..].sort_by(|a, b| b.0.total_cmp(&a.0));
        }
    }
}
