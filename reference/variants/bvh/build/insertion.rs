// Inserts the primitives one by one, each where it increases the areas of the boxes the least. See
// Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", IEEE Computer
// Graphics and Applications 7(5), 1987.

impl Bvh {
    /// Builds the tree by inserting the primitives one by one.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let clusters = primitives.into_iter().map(Cluster::one);
        build_from_cluster(clusters.reduce(Cluster::with), max_leaf_size)
    }
}

impl Cluster {
    /// Returns the cluster with another primitive inserted.
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
}
