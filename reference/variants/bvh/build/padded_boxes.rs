// Pads flat boxes by a small fraction of their diagonal, so that the box test doesn't need a
// special case for them.

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut tree = build_top_down(primitives, max_leaf_size, split_by_sweep);
        for node in &mut tree.nodes {
            node.bbox = padded(node.bbox);
        }
        tree
    }
}

/// The padding of a flat box as a fraction of its diagonal.
const PADDING: f32 = 1e-5;

fn padded(mut bbox: BBox) -> BBox {
    let size = bbox.max - bbox.min;
    for axis in 0..3 {
        if size[axis] == 0.0 {
            bbox.min[axis] -= PADDING * size.length();
            bbox.max[axis] += PADDING * size.length();
        }
    }
    bbox
}
