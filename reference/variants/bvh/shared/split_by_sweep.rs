/// Finds the cheapest split and sorts the primitives along its axis. Returns the size of the left
/// side.
fn split_by_sweep(primitives: &mut [Primitive]) -> usize {
    split_sorted(primitives, sweep_costs)
}
