// Traverses the tree with an iterator over the leaves that the ray hits, from near to far, and
// takes leaves as long as the ray enters them before the closest hit.

use std::iter;

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        self.leaves(ray)
            .try_fold(None, |closest: Option<Trace>, (entry, leaf)| {
                if closest.is_some_and(|closest| closest.distance < entry) {
                    return Err(closest);
                }
                let primitives = &self.primitives[leaf.start..leaf.start + leaf.size];
                let traces = primitives.iter().map(|primitive| primitive.hit(ray));
                Ok(traces.fold(closest, Trace::nearer))
            })
            .unwrap_or_else(|closest| closest)
    }

    /// Returns the leaves whose boxes the ray hits, from near to far, with their entry distances.
    fn leaves<'a>(&'a self, ray: &'a Ray) -> impl Iterator<Item = (f32, &'a Node)> {
        let entered = |index: usize| {
            let node = self.nodes.get(index)?;
            Some((node.bbox.hit(ray, ray.range)?.min, node))
        };
        // Sorted so that the nearest node is last.
        let mut open = Vec::from_iter(entered(self.root));
        iter::from_fn(move || {
            loop {
                let (entry, node) = open.pop()?;
                if node.is_leaf() {
                    return Some((entry, node));
                }
                open.extend([node.l, node.r].into_iter().filter_map(entered));
                open.sort_by(|a, b| b.0.total_cmp(&a.0));
            }
        })
    }
}
