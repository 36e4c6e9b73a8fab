/// Partitions the primitives in place at the best plane. The candidates are `count` planes
/// perpendicular to each axis of the node's box. Returns the size of the left side.
fn split_at_planes(primitives: &mut [Primitive], count: usize) -> usize {
    let bbox = bounds_of(primitives);
    let plane = |axis: usize, i: usize| {
        let part = (i + 1) as f32 / (count + 1) as f32;
        bbox.min[axis] + part * (bbox.max[axis] - bbox.min[axis])
    };

    let (mut least, mut best) = (f32::INFINITY, None);
    for axis in 0..3 {
        for i in 0..count {
            let middle = partition(primitives, axis, plane(axis, i));
            let (left, right) = primitives.split_at(middle);
            if left.is_empty() || right.is_empty() {
                continue;
            }
            let cost = area_times_count(left) + area_times_count(right);
            if cost < least {
                (least, best) = (cost, Some((axis, plane(axis, i))));
            }
        }
    }
    // If all centres are on the same side of every plane, split the primitives in half.
    best.map_or(primitives.len() / 2, |(axis, plane)| {
        partition(primitives, axis, plane)
    })
}

/// Moves the primitives before the plane to the front, like C++'s `std::partition`, and returns how
/// many there are.
fn partition(primitives: &mut [Primitive], axis: usize, plane: f32) -> usize {
    let mut first = 0;
    for i in 0..primitives.len() {
        if primitives[i].bbox().center()[axis] < plane {
            primitives.swap(first, i);
            first += 1;
        }
    }
    first
}
