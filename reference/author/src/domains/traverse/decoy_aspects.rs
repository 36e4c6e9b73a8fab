//! Aspects of the decoys in calls to `Bvh::hit`.

use super::call::TraverseCall;
use super::decoy::Decoy;
use crate::domains::Aspect;
use crate::domains::fields::class_up_to;

/// Why the decoy must not be tested.
pub(super) const REASON: Aspect<TraverseCall> = Aspect {
    name: "decoy",
    classes: &[
        "its box is missed",
        "its box and its sibling's box are missed",
        "its box begins beyond the hit",
        "the hit comes before its box, and its sibling's box is farther still",
        "the hit comes before its sibling's box, and its own box is farther still",
    ],
    class: |call| Some(call.decoy?.reason),
};

/// The kind of the decoy.
pub(super) const KIND: Aspect<TraverseCall> = Aspect {
    name: "decoy's kind",
    classes: &["triangle", "sphere"],
    class: |call| Some(usize::from(call.decoy?.is_sphere)),
};

/// The number of primitives in the decoy's leaf.
pub(super) const LEAF_SIZE: Aspect<TraverseCall> = Aspect {
    name: "decoy's leaf",
    classes: &["1", "2", "3", "4 to 16", "17 or more"],
    class: |call| Some(class_up_to(&[1, 2, 3, 16], call.decoy?.leaf_size)),
};

/// The number of primitives in the decoy's leaf, if there are many.
pub(super) const LARGE_LEAF: Aspect<TraverseCall> = Aspect {
    name: "decoy's large leaf",
    classes: &["17 to 32", "33 or more"],
    class: |call| match call.decoy?.leaf_size {
        17..=32 => Some(0),
        33.. => Some(1),
        _ => None,
    },
};

/// The index of the decoy in its leaf.
pub(super) const PLACE: Aspect<TraverseCall> = Aspect {
    name: "decoy's place",
    classes: &["alone", "first", "in the middle", "last"],
    class: |call| {
        let decoy = call.decoy?;
        Some(match decoy.place {
            _ if decoy.leaf_size == 1 => 0,
            0 => 1,
            place if place + 1 < decoy.leaf_size => 2,
            _ => 3,
        })
    },
};

/// The level of the decoy's leaf.
pub(super) const LEVEL: Aspect<TraverseCall> = Aspect {
    name: "decoy's level",
    classes: &["2 to 12", "13 to 24", "25 to 40", "41 to 60"],
    class: |call| Some(class_up_to(&[12, 24, 40], call.decoy?.level)),
};

/// Decoys whose leaf is a child of the root.
pub(super) const CHILD_OF_ROOT: Aspect<TraverseCall> = Aspect {
    name: "decoy in a child of the root",
    classes: &["its box is missed", "its box begins beyond the hit"],
    class: |call| match call.decoy? {
        Decoy {
            level: 2, reason, ..
        } => [0, 2].iter().position(|it| *it == reason),
        _ => None,
    },
};

/// The number of primitives in the decoy's tree.
pub(super) const TREE: Aspect<TraverseCall> = Aspect {
    name: "decoy's tree",
    classes: &["up to 10", "11 to 1,500", "more"],
    class: |call| {
        call.decoy?;
        let count = call.subject.tree.shapes.len();
        Some(class_up_to(&[10, 1500], count))
    },
};

/// Decoys in a box that begins beyond the closest hit, but not beyond a hit that is found earlier.
pub(super) const FARTHER_HIT: Aspect<TraverseCall> = Aspect {
    name: "decoy after a farther hit",
    classes: &["found before the closest hit"],
    class: |call| call.decoy?.is_after_a_farther_hit.then_some(0),
};

/// The box of the decoy's leaf.
pub(super) const BOX: Aspect<TraverseCall> = Aspect {
    name: "decoy's box",
    classes: &["thick", "flat", "a line or a point"],
    class: |call| Some(call.decoy?.flat_axes.min(2) as usize),
};

/// The sibling of the decoy's leaf.
pub(super) const SIBLING: Aspect<TraverseCall> = Aspect {
    name: "decoy's sibling",
    classes: &["any", "4 or more primitives, as in the decoy's leaf"],
    class: |call| Some(usize::from(call.decoy?.is_beside_a_large_leaf)),
};

/// The start of the ray toward the decoy.
pub(super) const START: Aspect<TraverseCall> = Aspect {
    name: "start before a decoy",
    classes: &["anywhere", "in the sibling's box, which contains the hit"],
    class: |call| Some(usize::from(call.decoy?.is_from_siblings_box)),
};

/// The call before the one with the decoy.
pub(super) const HISTORY: Aspect<TraverseCall> = Aspect {
    name: "decoy's history",
    classes: &[
        "any",
        "after a hit in the decoy's leaf",
        "after a parallel ray that enters the decoy's box before the sibling's box",
    ],
    class: |call| Some(call.decoy?.history),
};
