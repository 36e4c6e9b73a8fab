// Builds the tree by dividing the primitives, sorted by centre, into up to 64 chunks with equal
// numbers of primitives, instead of into slices of equal width.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            let chunk = primitives.len().div_ceil(CHUNKS);
            split_sorted(primitives, |sorted| {
                let chunks: Vec<BBox> = sorted.chunks(chunk).map(bounds_of).collect();
                let cost = |i: usize| {
                    let first = i * chunk;
                    let second = sorted.len() - first;
                    let (left, right) = (area_around(&chunks[..i]), area_around(&chunks[i..]));
                    (first, left * first as f32 + right * second as f32)
                };
                (1..chunks.len()).map(cost).collect()
            })
        })
    }
}

/// The number of chunks along each axis.
const CHUNKS: usize = 64;
