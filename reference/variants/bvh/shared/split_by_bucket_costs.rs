/// Partitions the primitives in place by the split between buckets that has the lowest `cost`. For
/// a primitive and an axis, `bucket` returns the index of a bucket, which must be less than
/// `count`. Returns the size of the left side.
fn split_by_bucket_costs(
    primitives: &mut [Primitive],
    count: usize,
    bucket: impl Fn(&Primitive, usize) -> usize,
    cost: impl Fn(Bucket, Bucket) -> f32,
) -> usize {
    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in 0..3 {
        let mut buckets = vec![Bucket::EMPTY; count];
        for primitive in primitives.iter() {
            let bucket = &mut buckets[bucket(primitive, axis)];
            bucket.bbox.enclose(primitive.bbox());
            bucket.size += 1;
        }
        for plane in 1..count {
            let (left, right) = (side(&buckets[..plane]), side(&buckets[plane..]));
            let cost = cost(left, right);
            if left.size > 0 && right.size > 0 && cost < least {
                (least, best) = (cost, Some((axis, plane)));
            }
        }
    }

    let Some((axis, plane)) = best else {
        return primitives.len() / 2; // No plane separates them.
    };
    primitives.sort_by_key(|primitive| bucket(primitive, axis));
    primitives.partition_point(|primitive| bucket(primitive, axis) < plane)
}

#[derive(Clone, Copy)]
struct Bucket {
    bbox: BBox,
    size: usize,
}

impl Bucket {
    const EMPTY: Bucket = Bucket {
        bbox: BBox::EMPTY,
        size: 0,
    };
}

/// Merges several buckets into one.
fn side(buckets: &[Bucket]) -> Bucket {
    buckets.iter().fold(Bucket::EMPTY, |mut all, bucket| {
        all.bbox.enclose(bucket.bbox);
        all.size += bucket.size;
        all
    })
}
