/// For each way to split the sorted primitives, returns the size of the left side and the cost.
fn sweep_costs(sorted: &[Primitive]) -> Vec<(usize, f32)> {
    let left = areas(sorted.iter());
    let mut right = areas(sorted.iter().rev());
    right.reverse();
    let cost = |first: usize| {
        let second = sorted.len() - first;
        left[first] * first as f32 + right[first] * second as f32
    };
    let sizes = 1..sorted.len();
    sizes.map(|first| (first, cost(first))).collect()
}

/// Returns the area of the box around the first n primitives for each n, starting at n = 0.
fn areas<'a>(primitives: impl Iterator<Item = &'a Primitive>) -> Vec<f32> {
    let mut bbox = BBox::EMPTY;
    let boxes = primitives.map(|primitive| {
        bbox.enclose(primitive.bbox());
        bbox.surface_area()
    });
    std::iter::once(0.0).chain(boxes).collect()
}
