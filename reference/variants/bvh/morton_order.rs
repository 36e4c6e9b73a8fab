// Sorts the primitives along the Z-order curve and splits where the highest bit of their codes
// changes, without considering areas (Lauterbach et al., "Fast BVH Construction on GPUs", Computer
// Graphics Forum 28(2), 2009). Traversal visits up to four children at once; the build determines
// these children (Wald, Benthin and Boulos, "Getting Rid of Packets", 2008).

use glam::Vec3;

#[derive(Clone, Debug)]
pub struct Bvh {
    pub primitives: Vec<Primitive>,
    pub nodes: Vec<Node>,
    pub root: usize,
    /// For each interior node, up to four descendants that replace its children.
    wide: Vec<Vec<usize>>,
}

impl Bvh {
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let wide = nodes.iter().map(|node| up_to_four(&nodes, node)).collect();
        Bvh {
            primitives,
            nodes,
            root,
            wide,
        }
    }

    /// Builds the tree along the Z-order curve.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let centers = bounds_of_centers(&primitives);
        let code = |primitive: &Primitive| morton_code(primitive.bbox().center(), &centers);
        primitives.sort_by_cached_key(code);
        let codes: Vec<u64> = primitives.iter().map(code).collect();

        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&primitives, &codes, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        let mut closest = None;
        self.traverse(self.root, &mut ray.clone(), &mut closest);
        closest
    }

    /// Looks for a closer hit below the node at `index`, whose box the ray is known to hit.
    fn traverse(&self, index: usize, ray: &mut Ray, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.is_leaf() {
            return self.test_leaf(node, ray, closest);
        }
        let hit = self.wide[index]
            .iter()
            .filter_map(|&child| Some((self.nodes[child].bbox.hit(ray, ray.range)?.min, child)));
        let mut ahead: Vec<(f32, usize)> = hit.collect();
        ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (entry, child) in ahead {
            if entry <= ray.range.max {
                self.traverse(child, ray, closest);
            }
        }
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

/// Returns up to four descendants of a node: as long as there are fewer, the interior node with the
/// largest box is replaced with its children.
fn up_to_four(nodes: &[Node], node: &Node) -> Vec<usize> {
    if node.is_leaf() {
        return Vec::new();
    }
    let mut children = vec![node.l, node.r];
    while children.len() < 4 {
        let area = |index: &usize| nodes[*index].bbox.surface_area();
        let interior = (0..children.len()).filter(|&i| !nodes[children[i]].is_leaf());
        let largest = interior.max_by(|&a, &b| area(&children[a]).total_cmp(&area(&children[b])));
        let Some(i) = largest else { break };
        let opened = &nodes[children.swap_remove(i)];
        children.extend([opened.l, opened.r]);
    }
    children
}

/// Builds the subtree over `primitives`, the first of which has index `start` in the tree's list.
/// Returns the index of the subtree's root.
fn build_node(
    primitives: &[Primitive],
    codes: &[u64],
    start: usize,
    max_leaf_size: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let bbox = bounds_of(primitives);
    let index = nodes.len();
    nodes.push(Node::leaf(bbox, start, primitives.len()));
    if primitives.len() > max_leaf_size {
        let middle = split(codes);
        let l = build_node(
            &primitives[..middle],
            &codes[..middle],
            start,
            max_leaf_size,
            nodes,
        );
        let (primitives, codes) = (&primitives[middle..], &codes[middle..]);
        let r = build_node(primitives, codes, start + middle, max_leaf_size, nodes);
        nodes[index] = Node::interior(bbox, l, r);
    }
    index
}

/// Returns the number of codes that have a zero at the highest bit in which the codes differ. The
/// codes must be sorted.
fn split(codes: &[u64]) -> usize {
    let differ = codes[0] ^ codes[codes.len() - 1];
    match differ.checked_ilog2() {
        Some(bit) => codes.partition_point(|code| code >> bit & 1 == 0),
        None => codes.len() / 2, // All are in the same cell.
    }
}

/// Returns the position of a point in the box along the Z-order curve: 16 bits for each axis,
/// interleaved.
fn morton_code(point: Vec3, bbox: &BBox) -> u64 {
    let size = (bbox.max - bbox.min).max(Vec3::splat(f32::MIN_POSITIVE));
    let cell = ((point - bbox.min) / size * 65535.0).as_uvec3();
    (0..16).fold(0, |code, bit| {
        let [x, y, z] = cell
            .to_array()
            .map(|component| u64::from(component >> bit & 1));
        code | (x << 2 | y << 1 | z) << (3 * bit)
    })
}

fn bounds_of(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose(primitive.bbox());
    }
    all
}

fn bounds_of_centers(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose_point(primitive.bbox().center());
    }
    all
}
