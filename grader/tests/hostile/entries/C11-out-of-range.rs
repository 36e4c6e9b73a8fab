//! does = "Its tree refers to nodes and primitives that do not exist."
//! into = "bvh.rs"
//! within = ["build"]
//! call = "return attack(primitives);"
//! verdicts = ["wrong", "partial", "panicked", "blocked"]
//!
//! [points]
//! build = 2
//! traverse = 20

fn attack(primitives: Vec<Primitive>) -> Bvh {
    let bbox = BBox::EMPTY;
    let leaf = Node { bbox, start: usize::MAX, size: usize::MAX, l: 7, r: 7 };
    let interior = Node { bbox, start: 0, size: 0, l: usize::MAX, r: 1 << 40 };
    Bvh { primitives, nodes: vec![leaf, interior], root: usize::MAX }
}
