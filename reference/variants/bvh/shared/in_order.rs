impl Bvh {
    /// Returns the children of an interior node whose boxes the ray hits, each with its entry
    /// distance. The nearer child comes first. `ray` must not be shortened by hits, so that the
    /// result stays the same for the whole traversal.
    fn in_order(&self, node: &Node, ray: &Ray) -> [Option<(usize, f32)>; 2] {
        let enter = |index: usize| Some((index, self.nodes[index].bbox.hit(ray, ray.range)?.min));
        match (enter(node.l), enter(node.r)) {
            (Some(l), Some(r)) if r.1 < l.1 => [Some(r), Some(l)],
            (None, r) => [r, None],
            (l, r) => [l, r],
        }
    }
}
