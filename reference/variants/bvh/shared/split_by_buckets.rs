/// Partitions the primitives in place by the cheapest split between `count` buckets, which divide
/// the box `over` along each axis. Returns the size of the left side.
fn split_by_buckets(primitives: &mut [Primitive], over: BBox, count: usize) -> usize {
    let cost = |left: Bucket, right: Bucket| side_cost(left) + side_cost(right);
    split_by_bucket_costs(primitives, count, bucket_in(over, count), cost)
}
