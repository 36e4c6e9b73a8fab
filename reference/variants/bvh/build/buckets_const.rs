// Builds the tree with a function that takes the number of buckets as a const parameter.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            // Even an empty bucket takes time to process, so use fewer buckets for a small node.
            if primitives.len() < 32 {
                split::<8>(primitives)
            } else {
                split::<24>(primitives)
            }
        })
    }
}

fn split<const COUNT: usize>(primitives: &mut [Primitive]) -> usize {
    split_by_buckets(primitives, bounds_of_centers(primitives), COUNT)
}
