// Uses helpers from this solution's bbox.rs: boxes can be added and summed, and a function returns
// the time when a ray enters a box.

use crate::bbox::entry_or_infinity;

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, split)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        self.closest_below(root, ray)
    }

    /// Returns the closest hit below `node`.
    fn closest_below(&self, node: &Node, ray: &Ray) -> Option<Trace> {
        if entry_or_infinity(&node.bbox, ray) == f32::INFINITY {
            return None;
        }
        if node.is_leaf() {
            let primitives = &self.primitives[node.start..node.start + node.size];
            let traces = primitives.iter().map(|primitive| primitive.hit(ray));
            return traces.fold(None, Trace::nearer);
        }
        let mut children = [node.l, node.r].map(|index| &self.nodes[index]);
        children.sort_by(|a, b| {
            let entry = |node: &Node| entry_or_infinity(&node.bbox, ray);
            entry(a).total_cmp(&entry(b))
        });
        let [first, second] = children;
        let closest = self.closest_below(first, ray);
        let limit = closest.map_or(ray.range.max, |closest| closest.distance);
        let rest = ray.within(ray.range.min, limit);
        Trace::nearer(closest, self.closest_below(second, &rest))
    }
}

/// Partitions the primitives in place by the cheapest split. Returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let centers = primitives.iter().map(|primitive| primitive.bbox().center());
    let over: BBox = centers.map(BBox::from).sum();
    split_by_buckets(primitives, over, 16)
}
