// Compares every partition of the sorted centres, axis by axis, and computes the boxes of both
// sides from scratch for each partition. This takes quadratic time, but is as simple as possible.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            split_sorted(primitives, |sorted| {
                let boxes: Vec<BBox> = sorted.iter().map(Primitive::bbox).collect();
                let cost = |first: usize| cost(&boxes[..first]) + cost(&boxes[first..]);
                (1..boxes.len()).map(|first| (first, cost(first))).collect()
            })
        })
    }
}

fn cost(side: &[BBox]) -> f32 {
    area_around(side) * side.len() as f32
}
