// Compares every partition of the sorted centres, axis by axis, using areas accumulated from both
// ends. This is the full sweep of Wald, Boulos and Shirley, "Ray Tracing Deformable Scenes Using
// Dynamic Bounding Volume Hierarchies", ACM Transactions on Graphics 26(1), 2007.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, split_by_sweep)
    }
}
