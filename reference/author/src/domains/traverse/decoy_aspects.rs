//! Aspects of the decoys in calls to `Bvh::hit`.

use super::call::TraverseCall;
use super::decoy::Decoy;
use crate::domains::Aspect;
use crate::domains::fields::class_up_to;

/// The aspects of decoys.
pub(super) const DECOY_ASPECTS: &[Aspect<TraverseCall>] = &[
    // Why the decoy must not be tested.
    Aspect::new(
        "decoy",
        &[
            "its box is missed",
            "its box and its sibling's box are missed",
            "its box begins beyond the hit",
            "the hit comes before its box, and its sibling's box is farther still",
            "the hit comes before its sibling's box, and its own box is farther still",
        ],
        |call| Some(call.decoy?.reason),
    ),
    // The kind of the decoy.
    Aspect::new("decoy's kind", &["triangle", "sphere"], |call| {
        Some(usize::from(call.decoy?.is_sphere))
    }),
    // The number of primitives in the decoy's leaf.
    Aspect::new(
        "decoy's leaf",
        &["1", "2", "3", "4 to 16", "17 or more"],
        |call| Some(class_up_to(&[1, 2, 3, 16], call.decoy?.leaf_size)),
    ),
    // The number of primitives in the decoy's leaf, if there are many.
    Aspect::new(
        "decoy's large leaf",
        &["17 to 32", "33 or more"],
        |call| match call.decoy?.leaf_size {
            17..=32 => Some(0),
            33.. => Some(1),
            _ => None,
        },
    ),
    // The index of the decoy in its leaf.
    Aspect::new(
        "decoy's place",
        &["alone", "first", "in the middle", "last"],
        |call| {
            let decoy = call.decoy?;
            Some(match decoy.place {
                _ if decoy.leaf_size == 1 => 0,
                0 => 1,
                place if place + 1 < decoy.leaf_size => 2,
                _ => 3,
            })
        },
    ),
    // The level of the decoy's leaf.
    Aspect::new(
        "decoy's level",
        &["2 to 12", "13 to 24", "25 to 40", "41 to 60"],
        |call| Some(class_up_to(&[12, 24, 40], call.decoy?.level)),
    ),
    // Decoys whose leaf is a child of the root.
    Aspect::new(
        "decoy in a child of the root",
        &["its box is missed", "its box begins beyond the hit"],
        |call| match call.decoy? {
            Decoy {
                level: 2, reason, ..
            } => [0, 2].iter().position(|it| *it == reason),
            _ => None,
        },
    ),
    // The number of primitives in the decoy's tree.
    Aspect::new(
        "decoy's tree",
        &["up to 10", "11 to 1,500", "more"],
        |call| {
            call.decoy?;
            let count = call.subject.tree.shapes.len();
            Some(class_up_to(&[10, 1500], count))
        },
    ),
    // Decoys in a box that begins beyond the closest hit, but not beyond a hit that is found
    // earlier.
    Aspect::new(
        "decoy after a farther hit",
        &["found before the closest hit"],
        |call| call.decoy?.is_after_a_farther_hit.then_some(0),
    ),
    // The box of the decoy's leaf.
    Aspect::new(
        "decoy's box",
        &["thick", "flat", "a line or a point"],
        |call| Some(call.decoy?.flat_axes.min(2) as usize),
    ),
    // The sibling of the decoy's leaf.
    Aspect::new(
        "decoy's sibling",
        &["any", "4 or more primitives, as in the decoy's leaf"],
        |call| Some(usize::from(call.decoy?.is_beside_a_large_leaf)),
    ),
    // The start of the ray toward the decoy.
    Aspect::new(
        "start before a decoy",
        &["anywhere", "in the sibling's box, which contains the hit"],
        |call| Some(usize::from(call.decoy?.is_from_siblings_box)),
    ),
    // The call before the one with the decoy.
    Aspect::new(
        "decoy's history",
        &[
            "any",
            "after a hit in the decoy's leaf",
            "after a parallel ray that enters the decoy's box before the sibling's box",
        ],
        |call| Some(call.decoy?.history),
    ),
];
