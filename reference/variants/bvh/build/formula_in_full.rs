// Computes the full formula, C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect,
// although parts of the formula are the same for all partitions of a node.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            let bucket = bucket_in(bounds_of_centers(primitives), 16);
            // If all primitives are points on a line, the area is 0. Any positive divisor will do
            // in that case.
            let node_area = bounds_of(primitives).surface_area().max(f32::MIN_POSITIVE);
            split_by_bucket_costs(primitives, 16, bucket, |left, right| {
                C_TRAV + (side_cost(left) + side_cost(right)) * C_ISECT / node_area
            })
        })
    }
}

/// The cost of traversing a node.
const C_TRAV: f32 = 1.0;

/// The cost of testing a primitive.
const C_ISECT: f32 = 2.0;
