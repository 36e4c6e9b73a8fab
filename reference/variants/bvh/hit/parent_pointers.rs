// Traverses the tree without a stack, using the index of each node's parent (Hapala et al.,
// "Efficient Stack-less BVH Traversal for Ray Tracing", 2011).

#[derive(Clone, Debug)]
pub struct Bvh {
    pub primitives: Vec<Primitive>,
    pub nodes: Vec<Node>,
    pub root: usize,
    /// The parent of each node except the root.
    parents: Vec<Option<usize>>,
}

impl Bvh {
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let mut parents = vec![None; nodes.len()];
        for (index, node) in nodes.iter().enumerate().filter(|(_, node)| !node.is_leaf()) {
            parents[node.l] = Some(index);
            parents[node.r] = Some(index);
        }
        Bvh {
            primitives,
            nodes,
            root,
            parents,
        }
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        let mut rest = *ray;
        let (mut at, mut from) = (self.root, None);
        while let Some(node) = self.nodes.get(at) {
            let parent = self.parents[at];
            let next = if from == parent {
                // Arriving from the parent: visit the node only if the ray hits its box.
                if node.bbox.hit(&rest, rest.range).is_none() {
                    parent
                } else if node.is_leaf() {
                    self.test_leaf(node, &mut rest, &mut closest);
                    parent
                } else {
                    let [near, _] = self.in_order(node, ray);
                    near.map_or(parent, |(near, _)| Some(near))
                }
            } else {
                // Arriving from a child: the far child follows the near child, and the parent
                // follows the far child.
                match self.in_order(node, ray) {
                    [Some((near, _)), Some((far, _))] if from == Some(near) => Some(far),
                    _ => parent,
                }
            };
            from = Some(at);
            let Some(next) = next else { break };
            at = next;
        }
        closest
    }
}
