// Inserts one primitive after the other, each where it increases the areas of the boxes the least.
// See Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", IEEE
// Computer Graphics and Applications 7(5), 1987. Traverses the tree best first: a heap of the
// nodes still to be visited returns the node whose box the ray enters first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

impl Bvh {
    /// Builds the tree by inserting one primitive after the other.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let (mut nodes, mut ordered) = (Vec::new(), Vec::new());
        let mut root = 0;
        if let Some(cluster) = insert_all(primitives) {
            root = cluster.flatten(max_leaf_size.max(1), &mut nodes, &mut ordered);
        }
        Bvh::from_nodes(ordered, nodes, root)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        let mut ray = *ray;
        let mut closest = None;
        let mut open = BinaryHeap::from_iter(OpenNode::new(root, &ray));
        while let Some(OpenNode { node, entry }) = open.pop() {
            // The ray enters the boxes of all other open nodes at this distance or farther away.
            if entry > ray.range.max {
                break;
            }
            if node.is_leaf() {
                self.test_leaf(node, &mut ray, &mut closest);
            } else {
                let children = [node.l, node.r].map(|index| &self.nodes[index]);
                open.extend(
                    children
                        .into_iter()
                        .filter_map(|child| OpenNode::new(child, &ray)),
                );
            }
        }
        closest
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

/// A node that is still to be visited. In comparisons, the node whose box the ray enters first is
/// the greatest, because a `BinaryHeap` returns the greatest element first.
struct OpenNode<'a> {
    node: &'a Node,
    entry: f32,
}

impl<'a> OpenNode<'a> {
    /// Creates the heap's entry for a node, or returns `None` if the ray misses the node's box.
    fn new(node: &'a Node, ray: &Ray) -> Option<Self> {
        let entry = node.bbox.hit(ray, ray.range)?.min;
        Some(OpenNode { node, entry })
    }
}

impl Ord for OpenNode<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.entry.total_cmp(&self.entry)
    }
}

impl PartialOrd for OpenNode<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for OpenNode<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for OpenNode<'_> {}

fn insert_all(primitives: Vec<Primitive>) -> Option<Cluster> {
    let clusters = primitives.into_iter().map(Cluster::one);
    clusters.reduce(|tree, next| tree.with(next))
}

/// A subtree, before its nodes are created.
struct Cluster {
    bbox: BBox,
    size: usize,
    parts: Parts,
}

enum Parts {
    One(Primitive),
    Two(Box<Cluster>, Box<Cluster>),
}

impl Cluster {
    fn one(primitive: Primitive) -> Self {
        Cluster {
            bbox: primitive.bbox(),
            size: 1,
            parts: Parts::One(primitive),
        }
    }

    fn two(a: Cluster, b: Cluster) -> Self {
        let mut bbox = a.bbox;
        bbox.enclose(b.bbox);
        Cluster {
            bbox,
            size: a.size + b.size,
            parts: Parts::Two(Box::new(a), Box::new(b)),
        }
    }

    /// Returns the area of the box around both clusters, which is the cost of merging them.
    fn distance(&self, other: &Cluster) -> f32 {
        let mut both = self.bbox;
        both.enclose(other.bbox);
        both.surface_area()
    }

    /// Returns the cluster after inserting one more primitive.
    fn with(self, new: Cluster) -> Cluster {
        // The costs of making `new` a sibling of this node, or of inserting it below a child: the
        // area of the new common box, plus the growth of the boxes above it.
        let beside = self.distance(&new);
        let growth = beside - self.bbox.surface_area();
        let Parts::Two(a, b) = self.parts else {
            return Cluster::two(self, new);
        };
        let below = |child: &Cluster| match child.parts {
            Parts::One(_) => growth + child.distance(&new),
            Parts::Two(..) => growth + child.distance(&new) - child.bbox.surface_area(),
        };
        let (into_a, into_b) = (below(&a), below(&b));
        if beside < into_a.min(into_b) {
            Cluster::two(Cluster::two(*a, *b), new)
        } else if into_a <= into_b {
            Cluster::two(a.with(new), *b)
        } else {
            Cluster::two(*a, b.with(new))
        }
    }

    /// Appends the cluster's primitives to `primitives`.
    fn unpack(self, primitives: &mut Vec<Primitive>) {
        match self.parts {
            Parts::One(primitive) => primitives.push(primitive),
            Parts::Two(a, b) => {
                a.unpack(primitives);
                b.unpack(primitives);
            }
        }
    }

    /// Appends the nodes and primitives of the cluster, and returns the index of its root. A
    /// cluster that fits in a leaf becomes a leaf.
    fn flatten(
        self,
        max_leaf_size: usize,
        nodes: &mut Vec<Node>,
        primitives: &mut Vec<Primitive>,
    ) -> usize {
        let (bbox, size) = (self.bbox, self.size);
        let node = match self.parts {
            Parts::Two(a, b) if size > max_leaf_size => {
                let l = a.flatten(max_leaf_size, nodes, primitives);
                let r = b.flatten(max_leaf_size, nodes, primitives);
                Node::interior(bbox, l, r)
            }
            Parts::One(_) | Parts::Two(..) => {
                let start = primitives.len();
                self.unpack(primitives);
                Node::leaf(bbox, start, size)
            }
        };
        nodes.push(node);
        nodes.len() - 1
    }
}
