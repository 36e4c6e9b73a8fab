// Builds the tree with sorted copies of the primitives, which it divides.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut tree = Bvh::from_nodes(Vec::new(), Vec::new(), 0);
        if !primitives.is_empty() {
            tree.root = tree.add_node(primitives, max_leaf_size.max(1));
        }
        tree
    }

    /// Adds the node over some primitives, and everything below it. Returns its index.
    fn add_node(&mut self, primitives: Vec<Primitive>, max_leaf_size: usize) -> usize {
        let bbox = bounds_of(&primitives);
        let node = if primitives.len() <= max_leaf_size {
            let (start, size) = (self.primitives.len(), primitives.len());
            self.primitives.extend(primitives);
            Node::leaf(bbox, start, size)
        } else {
            let (left, right) = cheapest_halves(primitives);
            let l = self.add_node(left, max_leaf_size);
            let r = self.add_node(right, max_leaf_size);
            Node::interior(bbox, l, r)
        };
        self.nodes.push(node);
        self.nodes.len() - 1
    }
}

fn cheapest_halves(primitives: Vec<Primitive>) -> (Vec<Primitive>, Vec<Primitive>) {
    let splits = (0..3).flat_map(|axis| {
        let costs = sweep_costs(&sorted(&primitives, axis)).into_iter();
        costs.map(move |(size, cost)| (cost, axis, size))
    });
    let cheapest = splits.min_by(|a, b| a.0.total_cmp(&b.0));
    let (axis, size) = cheapest.map_or((0, 1), |(_, axis, size)| (axis, size));
    let mut left = sorted(&primitives, axis);
    let right = left.split_off(size);
    (left, right)
}

fn sorted(primitives: &[Primitive], axis: usize) -> Vec<Primitive> {
    let mut sorted = primitives.to_vec();
    sort_along(&mut sorted, axis);
    sorted
}
