//! The SAH costs of the best trees for the scenes in the folder `scenes`.
//!
//! They are stored because the viewer contains no solution that could compute them. A test compares
//! them with the exact sweep that the exam's costs come from.

use judging::content_hash::ContentHash;
use judging::judge::tree::bounds::Bounds;
use protocol::Shape;

/// For each scene, the result of [`hash`] and the cost of the best tree.
pub const SWEEP_COSTS: [(&str, f64); 10] = [
    ("07c750980583539559dd251f10a58d5c", 4.3866),
    ("35065b7b13e221811717d5ad541e1bf0", 14.2900),
    ("44074dfe048326c860181abd043d2353", 2.9122),
    ("8253dbc354567e474e9b9a007da63496", 3.7271),
    ("92b3dc85d36a24a2230139e9e331ab6f", 11.2962),
    ("92e18a7f27233ba8e0c6024ff6bff922", 3.7067),
    ("96a5fe7aa9717710f9848e6da812db31", 7.7192),
    ("b855e0c426ea87ddf760918dfe458087", 13.0811),
    ("c6aa102a6c3c106ade28ea60f95aa6ad", 5.1119),
    ("d37f268ee54e0b60356001307ff7e70b", 2.5919),
];

/// Returns the SAH cost of the tree with the best split at every node, if it is known.
pub fn find(shapes: &[Shape], max_leaf_size: usize) -> Option<f64> {
    let hash = hash(shapes, max_leaf_size);
    let mut known = SWEEP_COSTS.iter();
    Some(known.find(|(known, _)| *known == hash)?.1)
}

/// Returns the hash of everything that the cost depends on.
pub fn hash(shapes: &[Shape], max_leaf_size: usize) -> String {
    let mut bytes = (max_leaf_size as u64).to_le_bytes().to_vec();
    for shape in shapes {
        let Bounds { min, max } = Bounds::of_shape(shape);
        let coordinates = min.to_array().into_iter().chain(max.to_array());
        bytes.extend(coordinates.flat_map(f64::to_le_bytes));
    }
    ContentHash::default().with(&bytes).hex()
}
