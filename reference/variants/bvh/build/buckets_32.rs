// Builds the tree with 32 buckets over the centres.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            split_by_buckets(primitives, bounds_of_centers(primitives), 32)
        })
    }
}
