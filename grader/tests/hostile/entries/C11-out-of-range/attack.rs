
fn attack(primitives: Vec<Primitive>) -> Bvh {
    let bbox = BBox::EMPTY;
    let leaf = Node { bbox, start: usize::MAX, size: usize::MAX, l: 7, r: 7 };
    let interior = Node { bbox, start: 0, size: 0, l: usize::MAX, r: 1 << 40 };
    Bvh { primitives, nodes: vec![leaf, interior], root: usize::MAX }
}
