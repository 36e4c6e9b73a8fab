// Traverses the tree without a stack. The trail has one bit for each level, which says whether the
// nearer child of the node on that level has been visited. After a leaf, the trail is counted up like
// a number, and the traversal starts again at the root. See Laine, "Restart Trail for Stackless BVH
// Traversal", High Performance Graphics 2010.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        let mut trail = Trail::default();
        while !trail.is_at_the_end() {
            self.follow(&mut trail, ray, &mut closest);
            trail.count_up();
        }
        closest
    }

    /// Goes from the root along the trail to its next leaf, or to a node that is not worth entering.
    fn follow(&self, trail: &mut Trail, ray: &Ray, closest: &mut Option<Trace>) {
        trail.level = Trail::END;
        let limit = closest.map_or(ray.range.max, |closest| closest.distance);
        // Boxes are tested with the whole range, so that the trail means the same each time.
        let entered = |index: usize| {
            let node = self.nodes.get(index)?;
            Some((node, node.bbox.hit(ray, ray.range)?.min))
        };
        let mut next = entered(self.root);
        while let Some((node, entry)) = next {
            if entry > limit {
                return;
            }
            if node.is_leaf() {
                let rest = ray.within(ray.range.min, limit);
                for primitive in &self.primitives[node.start..node.start + node.size] {
                    *closest = Trace::nearer(*closest, primitive.hit(&rest));
                }
                return;
            }
            trail.level >>= 1;
            let visited = trail.nearer_is_visited();
            next = match (entered(node.l), entered(node.r)) {
                (Some(l), Some(r)) if (l.1 <= r.1) != visited => Some(l),
                (Some(_), Some(r)) if !visited => Some(r),
                (Some(l), Some(r)) => Some(if l.1 <= r.1 { r } else { l }),
                (one, other) => {
                    // There is no second child to come back for.
                    trail.bits |= trail.level;
                    one.or(other)
                }
            };
        }
    }
}

/// The way from the root to the next node to visit.
#[derive(Default)]
struct Trail {
    /// The bits of the levels. The bit of the root's children is the second highest.
    bits: u64,
    /// The bit of the level of the current node.
    level: u64,
}

impl Trail {
    /// The bit that is set when all nodes have been visited.
    const END: u64 = 1 << 63;

    fn is_at_the_end(&self) -> bool {
        self.bits & Trail::END != 0
    }

    fn nearer_is_visited(&self) -> bool {
        self.bits & self.level != 0
    }

    /// Marks the current node as visited. Above a farther child, the carry marks the parent, too.
    fn count_up(&mut self) {
        self.bits = (self.bits & !(self.level - 1)) + self.level;
    }
}
