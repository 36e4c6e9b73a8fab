// Keeps the memory of the traversal's stack from one call to the next, so that rays don't allocate.
// The stack is emptied at the beginning of each call, and only its capacity is kept.

use std::cell::RefCell;

thread_local! {
    static STACK: RefCell<Vec<usize>> = const { RefCell::new(Vec::new()) };
}

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        STACK.with_borrow_mut(|open| {
            open.clear();
            open.extend((self.root < self.nodes.len()).then_some(self.root));
            self.closest_hit(*ray, open)
        })
    }

    /// Returns the closest hit below the nodes on the stack.
    fn closest_hit(&self, mut ray: Ray, open: &mut Vec<usize>) -> Option<Trace> {
        let mut closest = None;
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            if node.bbox.hit(&ray, ray.range).is_none() {
                continue;
            }
            if node.is_leaf() {
                self.test_leaf(node, &mut ray, &mut closest);
                continue;
            }
            let entry = |child: usize| Some(self.nodes[child].bbox.hit(&ray, ray.range)?.min);
            match (entry(node.l), entry(node.r)) {
                (Some(in_l), Some(in_r)) if in_l < in_r => open.extend([node.r, node.l]),
                (Some(_), Some(_)) => open.extend([node.l, node.r]),
                (Some(_), None) => open.push(node.l),
                (None, Some(_)) => open.push(node.r),
                (None, None) => {}
            }
        }
        closest
    }
}
