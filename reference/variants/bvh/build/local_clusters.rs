// Builds the tree bottom-up: each cluster finds its nearest neighbour in a window along the
// Z-order curve, and two clusters that chose each other are merged. See Meister and Bittner,
// "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy Construction", IEEE TVCG
// 24(3), 2018.

impl Bvh {
    /// Builds the tree bottom-up.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_from_cluster(merge_all(primitives), max_leaf_size)
    }
}

/// The number of clusters on each side that a cluster considers when choosing the nearest.
const RADIUS: usize = 16;

fn merge_all(mut primitives: Vec<Primitive>) -> Option<Cluster> {
    let centers = bounds_of_centers(&primitives);
    primitives.sort_by_cached_key(|p| morton_code(p.bbox().center(), &centers));
    let mut clusters: Vec<Cluster> = primitives.into_iter().map(Cluster::one).collect();
    while clusters.len() > 1 {
        let nearest: Vec<usize> = (0..clusters.len()).map(|i| nearest(&clusters, i)).collect();
        let mut waiting: Vec<Option<Cluster>> = clusters.into_iter().map(Some).collect();
        clusters = Vec::new();
        for i in 0..waiting.len() {
            // Skips the second cluster of a pair: it has already been merged.
            let Some(cluster) = waiting[i].take() else {
                continue;
            };
            let is_mutual = nearest[nearest[i]] == i;
            let partner = is_mutual.then(|| waiting[nearest[i]].take()).flatten();
            clusters.push(match partner {
                Some(partner) => Cluster::two(cluster, partner),
                None => cluster,
            });
        }
    }
    clusters.pop()
}

/// Returns the index of the cluster nearest to cluster `i`, among the clusters that are at most
/// `RADIUS` positions away from it in the list. Ties go to the first pair in the list, so that
/// there are always two clusters that choose each other.
fn nearest(clusters: &[Cluster], i: usize) -> usize {
    let window = i.saturating_sub(RADIUS)..clusters.len().min(i + RADIUS + 1);
    let others = window.filter(|&other| other != i);
    let distance = |other: usize| clusters[i].distance(&clusters[other]);
    let nearest = others.min_by(|&a, &b| {
        let by_distance = distance(a).total_cmp(&distance(b));
        by_distance.then((a.min(i), a.max(i)).cmp(&(b.min(i), b.max(i))))
    });
    nearest.expect("there are at least two clusters, and RADIUS is not 0")
}
