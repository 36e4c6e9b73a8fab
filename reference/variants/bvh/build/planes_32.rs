// Builds the tree without buckets: for each of 32 planes perpendicular to each axis of the node's
// box, the primitives are partitioned and the boxes of both sides are computed.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            split_at_planes(primitives, 32)
        })
    }
}
