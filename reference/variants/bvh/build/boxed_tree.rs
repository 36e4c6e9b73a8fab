// Builds a temporary tree of `Box`es and vectors and then creates the nodes from that tree.
// Primitives are partitioned into new vectors instead of in place.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let (mut nodes, mut ordered) = (Vec::new(), Vec::new());
        let mut root = 0;
        if !primitives.is_empty() {
            let tree = grow(primitives, max_leaf_size.max(1));
            root = flatten(tree, &mut nodes, &mut ordered);
        }
        Bvh::from_nodes(ordered, nodes, root)
    }
}

/// The temporary tree that the nodes are created from.
enum Tree {
    Leaf(BBox, Vec<Primitive>),
    Interior(BBox, Box<Tree>, Box<Tree>),
}

/// Appends the nodes and primitives of a tree and returns the index of its root.
fn flatten(tree: Tree, nodes: &mut Vec<Node>, primitives: &mut Vec<Primitive>) -> usize {
    let node = match tree {
        Tree::Leaf(bbox, contents) => {
            let start = primitives.len();
            primitives.extend(contents);
            Node::leaf(bbox, start, primitives.len() - start)
        }
        Tree::Interior(bbox, left, right) => {
            let l = flatten(*left, nodes, primitives);
            let r = flatten(*right, nodes, primitives);
            Node::interior(bbox, l, r)
        }
    };
    nodes.push(node);
    nodes.len() - 1
}

fn grow(primitives: Vec<Primitive>, max_leaf_size: usize) -> Tree {
    let bbox = bounds_of(&primitives);
    if primitives.len() <= max_leaf_size {
        return Tree::Leaf(bbox, primitives);
    }
    let centers = bounds_of_centers(&primitives);
    let candidates = (0..3).flat_map(|axis| (1..SLICES).map(move |slice| (axis, slice)));
    let halves = candidates.filter_map(|(axis, slice)| {
        let part = slice as f32 / SLICES as f32;
        let plane = centers.min[axis] + part * (centers.max[axis] - centers.min[axis]);
        let is_left = |p: &&Primitive| p.bbox().center()[axis] < plane;
        let (left, right): (Vec<_>, Vec<_>) = primitives.iter().partition(is_left);
        (!left.is_empty() && !right.is_empty()).then_some((left, right))
    });
    let cheapest = halves.min_by(|a, b| {
        let cost = |(left, right): &(Vec<Primitive>, Vec<Primitive>)| {
            area_times_count(left) + area_times_count(right)
        };
        cost(a).total_cmp(&cost(b))
    });
    let (left, right) = cheapest.unwrap_or_else(|| {
        let (left, right) = primitives.split_at(primitives.len() / 2);
        (left.to_vec(), right.to_vec())
    });
    Tree::Interior(
        bbox,
        Box::new(grow(left, max_leaf_size)),
        Box::new(grow(right, max_leaf_size)),
    )
}

/// The number of slices along each axis.
const SLICES: usize = 16;
