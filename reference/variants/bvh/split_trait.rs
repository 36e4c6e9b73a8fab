// Finds the split with trait objects: one for each axis, and one that splits by count, for
// primitives whose centres coincide. Compares costs in double precision.

/// A way to split a node in two.
trait Split {
    /// Orders the primitives, and returns the size and the cost of the best left side. `None` if this
    /// split cannot divide them.
    fn apply(&self, primitives: &mut [Primitive]) -> Option<(usize, f64)>;
}

/// Splits at one of several planes across an axis.
struct AcrossAxis {
    axis: usize,
    planes: usize,
}

/// Splits by count.
struct InHalves;

impl Split for AcrossAxis {
    fn apply(&self, primitives: &mut [Primitive]) -> Option<(usize, f64)> {
        let center = |primitive: &Primitive| primitive.bbox().center()[self.axis];
        primitives.sort_by(|a, b| center(a).total_cmp(&center(b)));
        let (first, last) = (center(primitives.first()?), center(primitives.last()?));
        let sizes = (1..=self.planes).map(|plane| {
            let part = plane as f32 / (self.planes + 1) as f32;
            let coordinate = first + part * (last - first);
            primitives.partition_point(|primitive| center(primitive) < coordinate)
        });
        let sizes = sizes.filter(|&size| size > 0 && size < primitives.len());
        let costs = sizes.map(|size| {
            let (left, right) = primitives.split_at(size);
            (size, cost(left) + cost(right))
        });
        costs.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Split for InHalves {
    fn apply(&self, primitives: &mut [Primitive]) -> Option<(usize, f64)> {
        Some((primitives.len() / 2, f64::INFINITY))
    }
}

fn cost(side: &[Primitive]) -> f64 {
    f64::from(bounds_of(side).surface_area()) * side.len() as f64
}

/// Partitions the primitives in place by the cheapest split; returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let across = |axis| Box::new(AcrossAxis { axis, planes: 20 }) as Box<dyn Split>;
    let splits = [across(0), across(1), across(2), Box::new(InHalves)];
    let mut cost_of = |split: &dyn Split| {
        let applied = split.apply(primitives);
        applied.map_or(f64::INFINITY, |(_, cost)| cost)
    };
    let costs = splits.each_ref().map(|split| cost_of(&**split));
    let [.., in_halves] = &splits;
    let cheapest = (0..3).min_by(|&a, &b| costs[a].total_cmp(&costs[b]));
    let cheapest = cheapest.filter(|&axis| costs[axis].is_finite());
    let split = cheapest.map_or(in_halves, |axis| &splits[axis]);
    split.apply(primitives).map_or(1, |(size, _)| size)
}

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        if self.root < self.nodes.len() {
            self.traverse(self.root, &mut ray.clone(), &mut closest);
        }
        closest
    }

    fn traverse(&self, index: usize, ray: &mut Ray, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.bbox.hit(ray, ray.range).is_none() {
            return;
        }
        if node.is_leaf() {
            return self.test_leaf(node, ray, closest);
        }

        // A missed box counts as infinitely far away. Even if its node is visited first, the box
        // test there fails.
        let entry = |child: usize| {
            let inside = self.nodes[child].bbox.hit(ray, ray.range);
            inside.map_or(f32::INFINITY, |inside| inside.min)
        };
        let (first, second) = if entry(node.l) <= entry(node.r) {
            (node.l, node.r)
        } else {
            (node.r, node.l)
        };
        self.traverse(first, ray, closest);
        self.traverse(second, ray, closest);
    }

    /// Tests the primitives of a leaf. A hit shortens the ray, so later hits must be closer.
    fn test_leaf(&self, leaf: &Node, ray: &mut Ray, closest: &mut Option<Trace>) {
        for primitive in &self.primitives[leaf.start..leaf.start + leaf.size] {
            if let Some(trace) = primitive.hit(ray) {
                ray.range.max = trace.distance;
                *closest = Some(trace);
            }
        }
    }
}

/// Builds the subtree over `primitives`, the first of which has index `start` in the tree's list.
/// Returns the index of the subtree's root.
fn build_node(
    primitives: &mut [Primitive],
    start: usize,
    max_leaf_size: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let bbox = bounds_of(primitives);
    let index = nodes.len();
    nodes.push(Node::leaf(bbox, start, primitives.len()));
    if primitives.len() > max_leaf_size {
        let middle = split(primitives);
        let (left, right) = primitives.split_at_mut(middle);
        let l = build_node(left, start, max_leaf_size, nodes);
        let r = build_node(right, start + middle, max_leaf_size, nodes);
        nodes[index] = Node::interior(bbox, l, r);
    }
    index
}

fn bounds_of(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose(primitive.bbox());
    }
    all
}
