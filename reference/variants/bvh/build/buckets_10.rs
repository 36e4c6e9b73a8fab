// Builds the tree with ten buckets over the node's box.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            split_by_buckets(primitives, bounds_of(primitives), 10)
        })
    }
}
