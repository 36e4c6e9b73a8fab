/// Sorts the primitives along the axis of the cheapest of all splits. Returns the size of the left
/// side.
fn split_by_sweep(primitives: &mut [Primitive]) -> usize {
    split_sorted(primitives, sweep_costs)
}
