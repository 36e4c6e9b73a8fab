// Builds the tree with eight to 32 buckets over the centres: the more primitives, the more buckets.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            // One bucket for every four primitives, within limits.
            let count = (primitives.len() / 4).clamp(8, 32);
            split_by_buckets(primitives, bounds_of_centers(primitives), count)
        })
    }
}
