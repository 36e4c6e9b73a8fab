// Splits at the median of the primitives' centres along the longest axis, so that each side gets
// half of the primitives. Areas are ignored.

impl Bvh {
    /// Builds the tree by splitting at the median.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            let centers = bounds_of_centers(primitives);
            let axis = (centers.max - centers.min).max_position();
            let center = |primitive: &Primitive| primitive.bbox().center()[axis];
            let middle = primitives.len() / 2;
            primitives.select_nth_unstable_by(middle, |a, b| center(a).total_cmp(&center(b)));
            middle
        })
    }
}
