/// Returns a side's contribution to the cost of a split, without the constants.
fn side_cost(side: Bucket) -> f32 {
    side.bbox.surface_area() * side.size as f32
}
