//! Counts the intersection tests of a traversal that is ordered and pruned like the reference's.
//! The reference itself doesn't count anything, since students read its files.

use protocol::{Ray, Trace};
use reference::bvh::{Bvh, Node};

/// The numbers of intersection tests.
#[derive(Default)]
pub struct Count {
    pub boxes: u64,
    pub primitives: u64,
}

/// Traces rays and counts the intersection tests performed. Panics if a hit differs from the
/// reference's.
pub fn count_tests(bvh: &Bvh, rays: &[Ray]) -> Count {
    let mut count = Count::default();
    for ray in rays {
        let mut search = Search {
            bvh,
            ray: *ray,
            closest: None,
            count: &mut count,
        };
        let root = &bvh.nodes[bvh.root];
        if search.entry(root).is_some() {
            search.traverse(root);
        }
        let distance = |trace: Option<Trace>| trace.map(|trace| trace.distance);
        assert_eq!(distance(search.closest), distance(bvh.hit(ray)), "{ray:?}");
    }
    count
}

/// The state of one ray's traversal.
struct Search<'a> {
    bvh: &'a Bvh,
    /// The ray, whose range ends at the closest hit so far.
    ray: Ray,
    closest: Option<Trace>,
    count: &'a mut Count,
}

impl Search<'_> {
    /// Tests the box of a node. Returns the distance at which the ray enters the box.
    fn entry(&mut self, node: &Node) -> Option<f32> {
        self.count.boxes += 1;
        Some(node.bbox.hit(&self.ray, self.ray.range)?.min)
    }

    fn traverse(&mut self, node: &Node) {
        if node.is_leaf() {
            for primitive in &self.bvh.primitives[node.start..node.start + node.size] {
                self.count.primitives += 1;
                if let Some(trace) = primitive.hit(&self.ray) {
                    self.ray.range.max = trace.distance;
                    self.closest = Some(trace);
                }
            }
            return;
        }
        let mut children: Vec<(f32, &Node)> = [node.l, node.r]
            .map(|index| &self.bvh.nodes[index])
            .into_iter()
            .filter_map(|child| Some((self.entry(child)?, child)))
            .collect();
        children.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (entry, child) in children {
            if entry <= self.ray.range.max {
                self.traverse(child);
            }
        }
    }
}
