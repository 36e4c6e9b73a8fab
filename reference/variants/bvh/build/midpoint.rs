// Splits the box of the centres in the middle of its longest axis. The distribution of the
// primitives and their areas are ignored.

impl Bvh {
    /// Builds the tree by splitting at midpoints.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            let centers = bounds_of_centers(primitives);
            let axis = (centers.max - centers.min).max_position();
            let is_right =
                |primitive: &Primitive| primitive.bbox().center()[axis] >= centers.center()[axis];
            primitives.sort_by_key(is_right);
            match primitives.partition_point(|primitive| !is_right(primitive)) {
                0 => primitives.len() / 2, // All centres coincide.
                middle => middle,
            }
        })
    }
}
