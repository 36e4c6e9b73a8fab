// Builds the tree bottom-up: merges the two clusters with the smallest common box, until only one
// is left (Walter et al., "Fast Agglomerative Clustering for Rendering", 2008). The pairs are
// found by following chains of nearest neighbours. Traverses the tree with a stack of nodes, each
// with the distance at which the ray enters it.

impl Bvh {
    /// Builds the tree bottom-up.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let (mut nodes, mut ordered) = (Vec::new(), Vec::new());
        let mut root = 0;
        if let Some(cluster) = merge_all(primitives) {
            root = cluster.flatten(max_leaf_size.max(1), &mut nodes, &mut ordered);
        }
        Bvh::from_nodes(ordered, nodes, root)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        let mut ray = *ray;
        let mut closest = None;
        let mut open = vec![(root, root.bbox.hit(&ray, ray.range)?.min)];
        while let Some((node, entry)) = open.pop() {
            // A closer hit may have been found after the node was pushed.
            if entry > ray.range.max {
                continue;
            }
            if node.is_leaf() {
                self.test_leaf(node, &mut ray, &mut closest);
                continue;
            }
            let entered = |index: usize| {
                let child = &self.nodes[index];
                Some((child, child.bbox.hit(&ray, ray.range)?.min))
            };
            match (entered(node.l), entered(node.r)) {
                // The nearer child is pushed last, so that it is popped first.
                (Some(l), Some(r)) if l.1 <= r.1 => open.extend([r, l]),
                (Some(l), Some(r)) => open.extend([l, r]),
                (l, r) => open.extend(l.or(r)),
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

fn merge_all(primitives: Vec<Primitive>) -> Option<Cluster> {
    let mut unmerged: Vec<Cluster> = primitives.into_iter().map(Cluster::one).collect();
    // A chain of clusters in which the distance from one cluster to the next decreases.
    let mut chain: Vec<Cluster> = Vec::new();
    while chain.len() + unmerged.len() > 1 {
        let Some(last) = chain.last() else {
            chain.extend(unmerged.pop());
            continue;
        };
        let distances = unmerged.iter().map(|other| last.distance(other));
        let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let back = chain
            .iter()
            .nth_back(1)
            .map(|previous| last.distance(previous));
        match nearest {
            // Extends the chain. If no cluster is nearer than the predecessor, merges the last two
            // clusters of the chain instead.
            Some((index, distance)) if back.is_none_or(|back| distance < back) => {
                chain.push(unmerged.swap_remove(index));
            }
            Some(_) | None => {
                let pair = chain.pop().zip(chain.pop());
                unmerged.extend(pair.map(|(a, b)| Cluster::two(a, b)));
            }
        }
    }
    unmerged.pop().or(chain.pop())
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
