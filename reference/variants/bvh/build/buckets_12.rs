// Builds the tree with twelve buckets over the centres, as in Pharr, Jakob and Humphreys,
// "Physically Based Rendering" (4th edition), section 7.3.2.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            split_by_buckets(primitives, bounds_of_centers(primitives), 12)
        })
    }
}
