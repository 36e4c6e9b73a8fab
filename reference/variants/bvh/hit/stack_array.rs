// Traverses the tree with a stack of fixed size in an array. The size is a const parameter of the
// stack's type.

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // Each level needs one entry: the farther child, while the nearer one is being visited.
        let mut open = Stack::<(usize, f32), 64>::new((0, 0.0));
        let mut closest: Option<Trace> = None;
        let root = self.nodes.get(self.root)?;
        open.push((self.root, root.bbox.hit(ray, ray.range)?.min));
        while let Some((index, entry)) = open.pop() {
            let limit = closest.map_or(ray.range.max, |closest| closest.distance);
            if entry > limit {
                continue;
            }
            let rest = ray.within(ray.range.min, limit);
            let node = &self.nodes[index];
            if node.is_leaf() {
                for primitive in &self.primitives[node.start..node.start + node.size] {
                    closest = Trace::nearer(closest, primitive.hit(&rest));
                }
                continue;
            }
            let enter = |child: usize| {
                let inside = self.nodes[child].bbox.hit(&rest, rest.range);
                inside.map(|inside| (child, inside.min))
            };
            let mut children = [enter(node.l), enter(node.r)];
            if let [Some(l), Some(r)] = children
                && l.1 < r.1
            {
                children.reverse();
            }
            for child in children.into_iter().flatten() {
                open.push(child);
            }
        }
        closest
    }
}

/// A stack of at most N elements.
struct Stack<T, const N: usize> {
    elements: [T; N],
    size: usize,
}

impl<T: Copy, const N: usize> Stack<T, N> {
    fn new(unused: T) -> Self {
        Stack {
            elements: [unused; N],
            size: 0,
        }
    }

    fn push(&mut self, element: T) {
        self.elements[self.size] = element;
        self.size += 1;
    }

    fn pop(&mut self) -> Option<T> {
        self.size = self.size.checked_sub(1)?;
        Some(self.elements[self.size])
    }
}
