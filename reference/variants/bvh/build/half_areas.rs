// Builds the tree with sixteen bins over the centres. Uses half areas, and scales by slightly less
// than the number of bins so that no bin index is too large. See Wald, "On fast Construction of
// SAH-based Bounding Volume Hierarchies", IEEE Symposium on Interactive Ray Tracing, 2007. Fused
// multiply-adds compute the costs.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, |primitives| {
            let over = bounds_of_centers(primitives);
            let factor = BINS as f32 * (1.0 - 1e-6) / (over.max - over.min);
            // If all centres coincide along the axis, this is 0 · ∞: a NaN, which becomes bin 0.
            let bin = |primitive: &Primitive, axis: usize| {
                ((primitive.bbox().center() - over.min) * factor)[axis] as usize
            };
            split_by_bucket_costs(primitives, BINS, bin, |left, right| {
                let left_cost = left.size as f32 * half_area(left.bbox);
                half_area(right.bbox).mul_add(right.size as f32, left_cost)
            })
        })
    }
}

/// The number of bins along each axis.
const BINS: usize = 16;

fn half_area(bbox: BBox) -> f32 {
    let size = bbox.max - bbox.min;
    size.z.mul_add(size.x + size.y, size.x * size.y)
}
