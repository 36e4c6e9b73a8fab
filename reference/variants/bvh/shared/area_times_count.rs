/// Returns a side's contribution to the cost of a split, without the constants.
fn area_times_count(side: &[Primitive]) -> f32 {
    bounds_of(side).surface_area() * side.len() as f32
}
