/// Returns a function that assigns a primitive to one of `count` equally large buckets, which
/// divide the box `over` along an axis.
fn bucket_in(over: BBox, count: usize) -> impl Fn(&Primitive, usize) -> usize {
    move |primitive, axis| {
        let offset = primitive.bbox().center()[axis] - over.min[axis];
        // If the box is flat, this is 0 / 0, which is NaN and becomes bucket 0.
        let part = offset / (over.max[axis] - over.min[axis]);
        ((part * count as f32) as usize).min(count - 1)
    }
}
