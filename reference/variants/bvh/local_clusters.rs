// Builds the tree bottom-up: each cluster finds its nearest neighbour in a window along the
// Z-order curve, and two clusters that chose each other are merged. See Meister and Bittner,
// "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy Construction", IEEE TVCG
// 24(3), 2018. Traversal first lists all leaves that the ray hits, and then tests them from near
// to far.

use glam::Vec3;

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
        let mut leaves = Vec::new();
        if let Some(root) = self.nodes.get(self.root) {
            self.list_leaves(root, ray, &mut leaves);
        }
        leaves.sort_by(|a, b| a.0.total_cmp(&b.0));

        let mut closest: Option<Trace> = None;
        for (entry, leaf) in leaves {
            if closest.is_some_and(|closest| closest.distance < entry) {
                break;
            }
            for primitive in &self.primitives[leaf.start..leaf.start + leaf.size] {
                closest = Trace::nearer(closest, primitive.hit(ray));
            }
        }
        closest
    }

    /// Lists the leaves below `node` whose boxes the ray hits, with their entry distances.
    fn list_leaves<'a>(&'a self, node: &'a Node, ray: &Ray, leaves: &mut Vec<(f32, &'a Node)>) {
        let Some(inside) = node.bbox.hit(ray, ray.range) else {
            return;
        };
        if node.is_leaf() {
            leaves.push((inside.min, node));
        } else {
            self.list_leaves(&self.nodes[node.l], ray, leaves);
            self.list_leaves(&self.nodes[node.r], ray, leaves);
        }
    }
}

/// The number of neighbours on each side from which a cluster chooses the nearest.
const RADIUS: usize = 16;

fn merge_all(mut primitives: Vec<Primitive>) -> Option<Cluster> {
    let centers = bounds_of_centers(&primitives);
    primitives.sort_by_cached_key(|p| morton_code(p.bbox().center(), &centers));
    let mut clusters: Vec<Cluster> = primitives.into_iter().map(Cluster::one).collect();
    while clusters.len() > 1 {
        let nearest: Vec<usize> = (0..clusters.len()).map(|i| nearest(&clusters, i)).collect();
        let mut waiting: Vec<Option<Cluster>> = clusters.into_iter().map(Some).collect();
        clusters = Vec::new();
        for i in 0..waiting.len() {
            // Skips the second cluster of a pair: it has already been merged.
            let Some(cluster) = waiting[i].take() else {
                continue;
            };
            let is_mutual = nearest[nearest[i]] == i;
            let partner = is_mutual.then(|| waiting[nearest[i]].take()).flatten();
            clusters.push(match partner {
                Some(partner) => Cluster::two(cluster, partner),
                None => cluster,
            });
        }
    }
    clusters.pop()
}

/// Returns the index of the nearest cluster to the cluster at `i`, among those within the radius.
/// Ties go to the first pair in the list, so that there are always two clusters that choose each
/// other.
fn nearest(clusters: &[Cluster], i: usize) -> usize {
    let window = i.saturating_sub(RADIUS)..clusters.len().min(i + RADIUS + 1);
    let others = window.filter(|&other| other != i);
    let distance = |other: usize| clusters[i].distance(&clusters[other]);
    let nearest = others.min_by(|&a, &b| {
        let by_distance = distance(a).total_cmp(&distance(b));
        by_distance.then((a.min(i), a.max(i)).cmp(&(b.min(i), b.max(i))))
    });
    nearest.expect("there are at least two clusters, and RADIUS is not 0")
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

fn bounds_of_centers(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose_point(primitive.bbox().center());
    }
    all
}
