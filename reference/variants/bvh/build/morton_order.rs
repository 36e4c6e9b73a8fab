// Sorts the primitives along the Z-order curve and splits where the highest bit of their codes
// changes, without considering areas (Lauterbach et al., "Fast BVH Construction on GPUs", Computer
// Graphics Forum 28(2), 2009).

impl Bvh {
    /// Builds the tree along the Z-order curve.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let centers = bounds_of_centers(&primitives);
        let code = |primitive: &Primitive| morton_code(primitive.bbox().center(), &centers);
        primitives.sort_by_cached_key(code);
        build_top_down(primitives, max_leaf_size, |primitives| {
            let differ = code(&primitives[0]) ^ code(&primitives[primitives.len() - 1]);
            match differ.checked_ilog2() {
                Some(bit) => primitives.partition_point(|p| code(p) >> bit & 1 == 0),
                None => primitives.len() / 2, // All are in the same cell.
            }
        })
    }
}
