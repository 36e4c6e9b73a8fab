// Builds the tree bottom-up: merges the two clusters with the smallest common box until only one
// cluster is left (Walter et al., "Fast Agglomerative Clustering for Rendering", 2008). The pairs
// are found by following chains of nearest neighbours.

impl Bvh {
    /// Builds the tree bottom-up.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_from_cluster(merge_all(primitives), max_leaf_size)
    }
}

fn merge_all(primitives: Vec<Primitive>) -> Option<Cluster> {
    let mut unmerged: Vec<Cluster> = primitives.into_iter().map(Cluster::one).collect();
    // A chain of clusters in which the distance from one cluster to the next decreases.
    let mut chain: Vec<Cluster> = Vec::new();
    while chain.len() + unmerged.len() > 1 {
        let Some(last) = chain.last() else {
            chain.extend(unmerged.pop());
            continue;
        };
        let distances = unmerged.iter().map(|other| last.distance(other));
        let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let back = chain
            .iter()
            .nth_back(1)
            .map(|previous| last.distance(previous));
        match nearest {
            // Extends the chain. If no cluster is nearer than the predecessor, merges the last two
            // clusters of the chain instead.
            Some((index, distance)) if back.is_none_or(|back| distance < back) => {
                chain.push(unmerged.swap_remove(index));
            }
            Some(_) | None => {
                let pair = chain.pop().zip(chain.pop());
                unmerged.extend(pair.map(|(a, b)| Cluster::two(a, b)));
            }
        }
    }
    unmerged.pop().or(chain.pop())
}
