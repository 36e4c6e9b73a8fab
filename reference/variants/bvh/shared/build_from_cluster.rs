/// Builds the tree from the cluster of all primitives.
fn build_from_cluster(cluster: Option<Cluster>, max_leaf_size: usize) -> Bvh {
    let (mut nodes, mut ordered) = (Vec::new(), Vec::new());
    let mut root = 0;
    if let Some(cluster) = cluster {
        root = cluster.flatten(max_leaf_size.max(1), &mut nodes, &mut ordered);
    }
    Bvh::from_nodes(ordered, nodes, root)
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

    /// Appends the nodes and primitives of the cluster and returns the index of its root. A cluster
    /// that fits in a leaf becomes a leaf.
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
