// Sorts the primitives along each axis once, before building. A sweep over the sorted centres (the
// events) finds the cheapest split of a node. The three lists are then divided without sorting them
// again. See Wald and Havran, "On building fast kd-Trees for Ray Tracing, and on doing that in O(N
// log N)", IEEE Symposium on Interactive Ray Tracing, 2006.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let boxes: Vec<BBox> = primitives.iter().map(Primitive::bbox).collect();
        let events = [0, 1, 2].map(|axis| {
            let mut sorted: Vec<usize> = (0..boxes.len()).collect();
            let center = |index: usize| boxes[index].center()[axis];
            sorted.sort_by(|&a, &b| center(a).total_cmp(&center(b)));
            sorted
        });
        let mut sweep = Sweep {
            is_left: vec![false; boxes.len()],
            boxes,
            max_leaf_size: max_leaf_size.max(1),
            nodes: Vec::new(),
            order: Vec::new(),
        };
        if !primitives.is_empty() {
            sweep.build_node(events);
        }
        let ordered = sweep.order.iter().map(|&index| primitives[index]);
        Bvh::from_nodes(ordered.collect(), sweep.nodes, 0)
    }
}

/// The state of a tree that is being built.
struct Sweep {
    boxes: Vec<BBox>,
    /// For each primitive, whether it is on the left side of the node that is being split.
    is_left: Vec<bool>,
    max_leaf_size: usize,
    nodes: Vec<Node>,
    /// The indices of the primitives in the order of the leaves.
    order: Vec<usize>,
}

impl Sweep {
    /// Builds the node over some primitives and returns its index. `events` contains the
    /// primitives' indices, sorted along each axis.
    fn build_node(&mut self, events: [Vec<usize>; 3]) -> usize {
        let bbox = self.bounds(&events[0]);
        let index = self.nodes.len();
        let (start, size) = (self.order.len(), events[0].len());
        self.nodes.push(Node::leaf(bbox, start, size));
        if size <= self.max_leaf_size {
            self.order.extend(&events[0]);
            return index;
        }

        let (axis, left_size) = self.cheapest_split(&events);
        for (position, &primitive) in events[axis].iter().enumerate() {
            self.is_left[primitive] = position < left_size;
        }
        let is_left = |primitive: &usize| self.is_left[*primitive];
        let sides = events.map(|sorted| sorted.into_iter().partition::<Vec<usize>, _>(is_left));
        let [x, y, z] = sides;
        let l = self.build_node([x.0, y.0, z.0]);
        let r = self.build_node([x.1, y.1, z.1]);
        self.nodes[index] = Node::interior(bbox, l, r);
        index
    }

    /// Returns the axis of the cheapest split and the size of its left side.
    fn cheapest_split(&self, events: &[Vec<usize>; 3]) -> (usize, usize) {
        let size = events[0].len();
        let (mut least, mut best) = (f32::INFINITY, (0, size / 2));
        for (axis, sorted) in events.iter().enumerate() {
            let mut right_areas = vec![0.0; size];
            let mut right = BBox::EMPTY;
            for position in (1..size).rev() {
                right.enclose(self.boxes[sorted[position]]);
                right_areas[position] = right.surface_area();
            }
            let mut left = BBox::EMPTY;
            for position in 1..size {
                left.enclose(self.boxes[sorted[position - 1]]);
                let cost = left.surface_area() * position as f32
                    + right_areas[position] * (size - position) as f32;
                if cost < least {
                    (least, best) = (cost, (axis, position));
                }
            }
        }
        best
    }

    fn bounds(&self, primitives: &[usize]) -> BBox {
        let mut all = BBox::EMPTY;
        for &index in primitives {
            all.enclose(self.boxes[index]);
        }
        all
    }
}
