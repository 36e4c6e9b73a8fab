// Builds the tree with numbers of buckets that are parameters of a function.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            // A bucket takes time, whether it is empty or not.
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
