//! The clues for the assignment `rays`.
//!
//! A clue for a symptom is shown if the item's own advice is about another symptom. The clue must
//! be true of any code with the symptom, so it says which quantities determine the answer and how
//! to find the one that is wrong.

use super::super::{SymptomClue, TaskClues};
use crate::symptom::Symptom;

/// The clue for the position that a shape's `hit` returns.
const POSITION: &str = "The position is the point on the ray at the distance that you return. Work \
                        it out by hand for the ray shown, in world space.";
/// The clue for the origin that a shape's `hit` returns.
const ORIGIN: &str = "The origin in the trace is the origin of the given ray, not the position of \
                      the hit.";
/// The clue for the shape that a shape's `hit` returns.
const SHAPE: &str = "The shape in the trace is the number in `self.shape`: copy it.";

/// The clues for cameras.
pub(super) const CAMERA: TaskClues = TaskClues {
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::of("direction"), Symptom::reversed("direction")],
            clue: "Work out by hand where the ray shown crosses the sensor, and compare x, y and z with the \
                values in your code: which of them differ, and are they shifted, scaled or swapped?",
            section: "camera.md#from-pixel-to-sensor",
        },
        SymptomClue {
            symptoms: &[Symptom::of("length of the direction")],
            clue: "The direction must have length one, because distances are measured in multiples of it. \
                `Ray::new` normalises it for you, but if you fill in the fields yourself, you must \
                normalise it first.",
            section: "camera.md#the-direction-has-length-one",
        },
        SymptomClue {
            symptoms: &[Symptom::of("origin")],
            clue: "The camera is at (0, 0, 0), and every ray starts there, not on the sensor.",
            section: "camera.md#the-ray-starts-at-the-camera",
        },
        SymptomClue {
            symptoms: &[Symptom::of("range")],
            clue: "The range of a camera ray goes from 0 to ∞.",
            section: "camera.md#the-ray-starts-at-the-camera",
        },
    ],
    ..TaskClues::NONE
};

/// The clues for triangles.
pub(super) const TRIANGLE: TaskClues = TaskClues {
    if_nothing_is_hit: Some(
        "Work out u, v, 1 − u − v and t by hand for the ray shown, and compare them with the values in your \
         code. If several have the wrong sign, check s, the operands of each cross product, and the formula's two \
         minus signs.",
    ),
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::MISS],
            clue: "The ray hits the triangle: the determinant isn't zero, u, v and w = 1 − u − v are at least \
                0, and t is in ray.range. Which line of your code returns `None` here? Work out by hand \
                the number that it tests, and compare.",
            section: "triangle.md#the-contract",
        },
        SymptomClue {
            symptoms: &[Symptom::HIT],
            clue: "The ray misses the triangle, but your code returns a hit: the determinant is zero, one \
                of u, v and w = 1 − u − v is negative, or t is outside ray.range. Which of these cases does \
                your code fail to reject?",
            section: "triangle.md#the-contract",
        },
        SymptomClue {
            symptoms: &[Symptom::of("distance")],
            clue: "The distance is t. Work it out by hand for the ray shown, and compare each factor with \
                its value in your code.",
            section: "triangle.md#three-equations-for-three-unknowns",
        },
        SymptomClue {
            symptoms: &[Symptom::of("depth")],
            clue: "The depth is the distance t. Replay a position where yours is wrong, and work out t \
                there by hand.",
            section: "triangle.md#three-equations-for-three-unknowns",
        },
        SymptomClue {
            symptoms: &[Symptom::of("position")],
            clue: POSITION,
            section: "triangle.md#what-to-return",
        },
        SymptomClue {
            symptoms: &[Symptom::of("normal")],
            clue: "The normal is w · n0 + u · n1 + v · n2, with the normals given at the corners: w = 1 \
                − u − v is 1 at p0, u is 1 at p1 and v is 1 at p2. Is this true of your three weights?",
            section: "triangle.md#each-weight-belongs-to-its-corner",
        },
        SymptomClue {
            symptoms: &[Symptom::reversed("normal")],
            clue: "Your normal is the opposite of the correct one. It belongs to the surface, so it stays \
                the same whichever side the ray comes from: where does your code change its sign?",
            section: "triangle.md#do-not-flip-the-normal",
        },
        SymptomClue {
            symptoms: &[Symptom::of("uv")],
            clue: "The uv is w · uv0 + u · uv1 + v · uv2: w = 1 − u − v is 1 at p0, u is 1 at p1 and v is 1 \
                at p2. Is this true of your three weights?",
            section: "triangle.md#each-weight-belongs-to-its-corner",
        },
        SymptomClue {
            symptoms: &[Symptom::of("origin")],
            clue: ORIGIN,
            section: "triangle.md#what-to-return",
        },
        SymptomClue {
            symptoms: &[Symptom::of("shape")],
            clue: SHAPE,
            section: "triangle.md#what-to-return",
        },
    ],
    ..TaskClues::NONE
};

/// The clues for spheres.
pub(super) const SPHERE: TaskClues = TaskClues {
    if_nothing_is_hit: Some(
        "Work out b, c, the discriminant and both roots by hand for the ray shown, and compare them with the \
         values in your code. Then see which comparison rejects both roots.",
    ),
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::MISS],
            clue: "The ray hits the sphere, but your code returns a miss. Work out the discriminant and \
                both roots by hand for the ray shown: the discriminant is at least 0, and at least one root is \
                in ray.range. Which line of your code returns `None` here?",
            section: "sphere.md#the-quadratic-equation",
        },
        SymptomClue {
            symptoms: &[Symptom::HIT],
            clue: "The ray misses the sphere, but your code returns a hit: there are no real roots, \
                or neither root is in ray.range. Work out the discriminant and the roots for the ray shown: \
                which comparison should have rejected the hit?",
            section: "sphere.md#check-each-root-separately",
        },
        SymptomClue {
            symptoms: &[Symptom::less("distance")],
            clue: "The distance is the smallest root in ray.range. Work out both roots for the \
                     ray shown: is your distance one of them, and is it in the range?",
            section: "sphere.md#check-each-root-separately",
        },
        SymptomClue {
            symptoms: &[Symptom::of("distance")],
            clue: "The distance is the smallest root in ray.range. Work out both roots for the ray \
                     shown: is your distance one of them, and is the other root smaller and also \
                     in the range?",
            section: "sphere.md#check-each-root-separately",
        },
        SymptomClue {
            symptoms: &[Symptom::of("length of the normal")],
            clue: "The normal must have length one: divide the vector from the centre to the \
                     hit by its length.",
            section: "sphere.md#the-normal-points-away-from-the-centre",
        },
        SymptomClue {
            symptoms: &[Symptom::of("position")],
            clue: POSITION,
            section: "sphere.md#what-to-return",
        },
        SymptomClue {
            symptoms: &[Symptom::of("normal"), Symptom::reversed("normal")],
            clue: "The normal points from the centre to the hit and has length one, even if the ray comes \
                from inside.",
            section: "sphere.md#the-normal-points-away-from-the-centre",
        },
        SymptomClue {
            symptoms: &[Symptom::of("uv")],
            clue: "The given Sphere::uv expects the unit-length direction from the centre to the \
                hit. Are you passing that, and is the given method unchanged?",
            section: "sphere.md#the-uv-function-needs-a-unit-direction",
        },
        SymptomClue {
            symptoms: &[Symptom::of("origin")],
            clue: ORIGIN,
            section: "sphere.md#what-to-return",
        },
        SymptomClue {
            symptoms: &[Symptom::of("shape")],
            clue: SHAPE,
            section: "sphere.md#what-to-return",
        },
    ],
    ..TaskClues::NONE
};

/// The clues for boxes.
pub(super) const BBOX: TaskClues = TaskClues {
    if_nothing_is_hit: Some(
        "Work out by hand when the ray shown enters and leaves the slab of each axis. Which of these times are different in \
         your code, and which comparison rejects them?",
    ),
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::MISS],
            clue: "For part of the interval `times`, the ray is in the box, but your code returns None. \
                Work out by hand when the ray shown enters and leaves each slab: which comparison rejects \
                these times?",
            section: "boxes.md#from-the-last-entry-to-the-first-exit",
        },
        SymptomClue {
            symptoms: &[Symptom::HIT],
            clue: "The ray is never in the box during the interval `times`, but your code returns an \
                interval. Work out by hand when the ray shown is in each slab: these three intervals and \
                `times` have no point in common.",
            section: "boxes.md#the-slab-intervals-must-overlap",
        },
        SymptomClue {
            symptoms: &[Symptom::of("interval inside the box")],
            clue: "The interval starts at the latest of the three entries and times.min, and \
                     ends at the earliest of the three exits and times.max. Work out all eight times for \
                     the ray shown: which of them did your code choose?",
            section: "boxes.md#from-the-last-entry-to-the-first-exit",
        },
    ],
    ..TaskClues::NONE
};

/// The clues for building a tree.
pub(super) const BUILD: TaskClues = TaskClues {
    if_stack_overflows: Some(
        "Is there a call in bvh.rs that receives as many primitives as its caller? If so, that \
         node should have become a leaf, or one side of its split is empty, or the two sides \
         overlap. Do you use the same rule to count the two sides as to move the primitives? \
         `--replay` leaves out primitives as long as the stack still overflows, and shows how \
         many are left.",
    ),
    section_if_stack_overflows: Some("building.md#a-side-without-primitives"),
    sections_on_crashes: &["building.md#when-all-centres-coincide"],
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::of("nodes")],
            clue: "Starting from nodes[root], l and r lead to every other node of the tree, and there is \
                only one path to each. Print the nodes for this question, and draw the tree.",
            section: "building.md#a-leaf-is-a-slice-of-the-list",
        },
        SymptomClue {
            symptoms: &[Symptom::of("root")],
            clue: "The root is an index into the list of nodes that you return: was the node \
                     added to that list, and did its index change afterwards?",
            section: "building.md#child-indices-are-node-indices",
        },
        SymptomClue {
            symptoms: &[Symptom::of("l"), Symptom::of("r")],
            clue: "l and r are indices into the list of nodes that you return, not into the \
                     primitives.",
            section: "building.md#child-indices-are-node-indices",
        },
        SymptomClue {
            symptoms: &[Symptom::less("leaves")],
            clue: "Follow the primitive shown through your splits: each split puts every \
                     primitive on one of its two sides, and a leaf holds the primitives \
                     start..start + size of the list that you return.",
            section: "building.md#a-leaf-is-a-slice-of-the-list",
        },
        SymptomClue {
            symptoms: &[Symptom::of("leaves")],
            clue: "Each leaf holds the primitives start..start + size of the list that you return, and \
                no two leaves share a primitive. Print the start and size of each leaf for this question.",
            section: "building.md#a-leaf-is-a-slice-of-the-list",
        },
        SymptomClue {
            symptoms: &[Symptom::of("box too small")],
            clue: "The box of the node shown does not enclose the boxes of all the primitives \
                below it. Compare it with each of these boxes: did you enclose the box of every \
                primitive, rather than just its centre?",
            section: "building.md#start-each-box-empty",
        },
        SymptomClue {
            symptoms: &[Symptom::of("box too large")],
            clue: "The box of the node shown is larger than the union of the boxes of its \
                     primitives. What else did you enclose in it, and did it start as \
                     BBox::EMPTY?",
            section: "building.md#start-each-box-empty",
        },
        SymptomClue {
            symptoms: &[Symptom::less("splits")],
            clue: "The leaf shown holds at least half of all the primitives, and more than \
                     max_leaf_size. Why didn't your code split it: did it try no partitions, or \
                     did it reject them all?",
            section: "building.md#when-a-node-becomes-a-leaf",
        },
        SymptomClue {
            symptoms: &[Symptom::of("splits")],
            clue: "The node shown has at most max_leaf_size primitives, so it must be a leaf, \
                regardless of the costs.",
            section: "building.md#when-a-node-becomes-a-leaf",
        },
        SymptomClue {
            symptoms: &[Symptom::of("leaf size")],
            clue: "The leaf shown holds more than max_leaf_size primitives. Why did your code stop \
                     splitting there?",
            section: "building.md#when-a-node-becomes-a-leaf",
        },
        SymptomClue {
            symptoms: &[Symptom::of("SAH cost")],
            clue: "Print the partition that your code chooses at the root, and work out the cost \
                of a different one by hand: which of the two is cheaper?",
            section: "building.md#which-partitions-to-try",
        },
    ],
    ..TaskClues::NONE
};

/// The clues for traversing a tree.
pub(super) const TRAVERSE: TaskClues = TaskClues {
    if_nothing_is_hit: Some(
        "Follow the ray shown from the root. Does your code enter the boxes that the ray hits and test \
         all primitives in the leaves? If it finds a hit, is that hit compared the right way \
         round, kept, and returned?",
    ),
    section_if_stack_overflows: Some("traversal.md#the-algorithm"),
    sections_on_crashes: &["traversal.md#deep-trees"],
    section_on_kept_state: Some("traversal.md#keep-nothing-between-two-rays"),
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::MISS],
            clue: "The ray hits a primitive in a leaf that it reaches, but your code returns None. Follow \
                the ray shown from the root: which box on the way does your \
                     code not enter, or where does it lose the hit?",
            section: "traversal.md#the-algorithm",
        },
        SymptomClue {
            symptoms: &[Symptom::HIT],
            clue: "Your code returns a hit where no correct traversal finds one. If the ray does hit a \
                primitive there, it is in no leaf, in a leaf that you mustn't enter, or outside \
                ray.range. If it doesn't, why doesn't your code return None?",
            section: "traversal.md#the-algorithm",
        },
        SymptomClue {
            symptoms: &[Symptom::less("distance")],
            clue: "Your distance is less than the correct one. Does the ray hit a primitive there? If so, \
                it is in no leaf, in a leaf that you mustn't enter, or nearer than ray.range.min. If \
                not, why isn't your distance that of a primitive's hit?",
            section: "traversal.md#the-algorithm",
        },
        SymptomClue {
            symptoms: &[Symptom::of("distance")],
            clue: "There is a nearer hit than yours, in a leaf that the ray reaches. Follow the ray \
                     shown from the root: which box on the way does your code not enter, or \
                     where does it lose the nearer hit?",
            section: "traversal.md#the-first-hit-need-not-be-the-closest",
        },
        SymptomClue {
            symptoms: &[Symptom::less("depth")],
            clue: "Your depth is less than the correct one. If a primitive is hit there, it is in \
                no leaf, or in a leaf that must not be entered: why was it tested?",
            section: "traversal.md#test-exactly-the-primitives-of-the-leaf",
        },
        SymptomClue {
            symptoms: &[
                Symptom::of("position"),
                Symptom::of("normal"),
                Symptom::reversed("normal"),
                Symptom::of("uv"),
                Symptom::of("shape"),
            ],
            clue: "Primitive::hit returns a complete trace, with position, normal, uv and shape: return the \
                trace of the closest hit unchanged.",
            section: "traversal.md#the-algorithm",
        },
        SymptomClue {
            symptoms: &[Symptom::of("origin")],
            clue: "The origin in the trace is the origin of the given ray: call Primitive::hit with a ray \
                that starts there.",
            section: "traversal.md#the-algorithm",
        },
    ],
    ..TaskClues::NONE
};
