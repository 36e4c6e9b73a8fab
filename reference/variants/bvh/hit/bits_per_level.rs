// Traverses the tree without a stack, restarting from the root along a trail of bits (Laine,
// "Restart Trail for Stackless BVH Traversal", 2010).

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        let mut closest = None;
        let mut rest = *ray;

        // One bit for each level, with the root's bit at the top. A bit is 1 if the child being
        // traversed on that level is the last one to visit.
        let mut trail = 0_u64;
        while trail < DONE {
            let mut node = root;
            let mut parent_bit = DONE;
            while !node.is_leaf() {
                let bit = parent_bit >> 1;
                let [near, far] = self.in_order(node, ray);
                if far.is_none() {
                    trail |= bit;
                }
                let next = if trail & bit == 0 { near } else { far.or(near) };
                parent_bit = bit;
                match next.filter(|(_, entry)| *entry <= rest.range.max) {
                    Some((child, _)) => node = &self.nodes[child],
                    None => break,
                }
            }
            if node.is_leaf() {
                self.test_leaf(node, &mut rest, &mut closest);
            }

            // Move to the next child: adding 1 at the parent's bit carries up past all finished
            // levels.
            trail = (trail & !(parent_bit - 1)) + parent_bit;
        }
        closest
    }
}

/// The bit above the root's bit. The bits below it are enough for trees of 62 levels.
const DONE: u64 = 1 << 63;
