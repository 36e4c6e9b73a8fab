// Splits the list of a node's primitives into two new lists, using twelve buckets over the centres.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut bvh = Bvh::from_nodes(Vec::new(), Vec::new(), 0);
        if !primitives.is_empty() {
            bvh.root = bvh.grow(primitives, max_leaf_size);
        }
        bvh
    }

    /// Adds a node over these primitives and everything below that node. Returns the node's index.
    fn grow(&mut self, primitives: Vec<Primitive>, max_leaf_size: usize) -> usize {
        let mut bbox = BBox::EMPTY;
        for primitive in &primitives {
            bbox.enclose(primitive.bbox());
        }
        if primitives.len() <= max_leaf_size {
            let start = self.primitives.len();
            self.nodes.push(Node::leaf(bbox, start, primitives.len()));
            self.primitives.extend(primitives);
        } else {
            let (left, right) = split(primitives);
            let l = self.grow(left, max_leaf_size);
            let r = self.grow(right, max_leaf_size);
            self.nodes.push(Node::interior(bbox, l, r));
        }
        self.nodes.len() - 1
    }
}

/// Splits primitives into two sides by the surface area heuristic with bins.
fn split(primitives: Vec<Primitive>) -> (Vec<Primitive>, Vec<Primitive>) {
    split_into(primitives, 12)
}

/// Splits primitives like [`split`], with this many bins along each axis.
fn split_into(mut primitives: Vec<Primitive>, bins: usize) -> (Vec<Primitive>, Vec<Primitive>) {
    let mut centers = BBox::EMPTY;
    for primitive in &primitives {
        centers.enclose_point(primitive.bbox().center());
    }
    let bin = |primitive: &Primitive, axis: usize| {
        let extent = centers.max[axis] - centers.min[axis];
        let offset = primitive.bbox().center()[axis] - centers.min[axis];
        ((offset / extent * bins as f32) as usize).min(bins - 1)
    };

    let mut best = None;
    let mut best_cost = f32::INFINITY;
    for axis in 0..3 {
        if !is_tried(&centers, axis, primitives.len()) {
            continue;
        }
        let mut boxes = vec![BBox::EMPTY; bins];
        let mut counts = vec![0; bins];
        for primitive in &primitives {
            let i = bin(primitive, axis);
            boxes[i].enclose(primitive.bbox());
            counts[i] += 1;
        }
        for plane in 1..bins {
            let side = |range: std::ops::Range<usize>| {
                let (mut bbox, mut count) = (BBox::EMPTY, 0);
                for i in range {
                    bbox.enclose(boxes[i]);
                    count += counts[i];
                }
                (bbox.surface_area() * count as f32, count)
            };
            let ((left, n_left), (right, n_right)) = (side(0..plane), side(plane..bins));
            if n_left > 0 && n_right > 0 && left + right < best_cost {
                best_cost = left + right;
                best = Some((axis, plane));
            }
        }
    }
    match best {
        Some((axis, plane)) => primitives
            .into_iter()
            .partition(|primitive| bin(primitive, axis) < plane),
        None => {
            let right = primitives.split_off(primitives.len() / 2);
            (primitives, right)
        }
    }
}

/// Returns whether to try an axis, i.e. whether a plane can separate the centres.
fn is_tried(centers: &BBox, axis: usize, _count: usize) -> bool {
    centers.min[axis] < centers.max[axis]
}
