/// Sorts the primitives along the axis of the cheapest split. Returns the size of the left side.
/// Given the sorted primitives, `costs` returns possible sizes of the left side with their costs.
fn split_sorted(
    primitives: &mut [Primitive],
    costs: impl Fn(&[Primitive]) -> Vec<(usize, f32)>,
) -> usize {
    let (mut least, mut best) = (f32::INFINITY, (0, primitives.len() / 2));
    for axis in 0..3 {
        sort_along(primitives, axis);
        for (first, cost) in costs(primitives) {
            if cost < least {
                (least, best) = (cost, (axis, first));
            }
        }
    }
    let (axis, first) = best;
    sort_along(primitives, axis);
    first
}
