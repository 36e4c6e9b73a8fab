//! Newell's table of patches, with x toward the spout and z up.

use glam::{DVec3, dvec3};

/// A Bézier patch of the table.
pub(super) struct Patch {
    /// The symmetry that gives the mirror images of this patch.
    pub(super) symmetry: Symmetry,
    /// The indices of its control points in [`POINTS`], row by row.
    points: [usize; 16],
}

/// The planes in which a patch is mirrored.
pub(super) enum Symmetry {
    /// The plane y = 0, for the handle and the spout.
    LeftAndRight,
    /// The planes y = 0 and x = 0, for everything round.
    AllAround,
}

impl Patch {
    const fn all_around(points: [usize; 16]) -> Self {
        Patch {
            symmetry: Symmetry::AllAround,
            points,
        }
    }

    const fn left_and_right(points: [usize; 16]) -> Self {
        Patch {
            symmetry: Symmetry::LeftAndRight,
            points,
        }
    }

    /// Returns the control points, row by row.
    pub(super) fn control_points(&self) -> [[DVec3; 4]; 4] {
        let row = |j: usize| [0, 1, 2, 3].map(|i| POINTS[self.points[4 * j + i]]);
        [0, 1, 2, 3].map(row)
    }
}

/// All patches: rim, body (two), knob, lid, bottom, handle (two), spout (two).
#[rustfmt::skip]
pub(super) const PATCHES: &[Patch] = &[
    Patch::all_around([102, 103, 104, 105, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]),
    Patch::all_around([12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27]),
    Patch::all_around([24, 25, 26, 27, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40]),
    Patch::all_around([96, 96, 96, 96, 97, 98, 99, 100, 101, 101, 101, 101, 0, 1, 2, 3]),
    Patch::all_around([0, 1, 2, 3, 106, 107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117]),
    Patch::all_around([118, 118, 118, 118, 124, 122, 119, 121, 123, 126, 125, 120, 40, 39, 38, 37]),
    Patch::left_and_right([41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56]),
    Patch::left_and_right([53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 28, 65, 66, 67]),
    Patch::left_and_right([68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83]),
    Patch::left_and_right([80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 90, 91, 92, 93, 94, 95]),
];

/// All control points, as a table with three per line.
#[rustfmt::skip]
const POINTS: [DVec3; 127] = [
    dvec3(0.2, 0.0, 2.7), dvec3(0.2, -0.112, 2.7), dvec3(0.112, -0.2, 2.7),
    dvec3(0.0, -0.2, 2.7), dvec3(1.3375, 0.0, 2.53125), dvec3(1.3375, -0.749, 2.53125),
    dvec3(0.749, -1.3375, 2.53125), dvec3(0.0, -1.3375, 2.53125), dvec3(1.4375, 0.0, 2.53125),
    dvec3(1.4375, -0.805, 2.53125), dvec3(0.805, -1.4375, 2.53125), dvec3(0.0, -1.4375, 2.53125),
    dvec3(1.5, 0.0, 2.4), dvec3(1.5, -0.84, 2.4), dvec3(0.84, -1.5, 2.4),
    dvec3(0.0, -1.5, 2.4), dvec3(1.75, 0.0, 1.875), dvec3(1.75, -0.98, 1.875),
    dvec3(0.98, -1.75, 1.875), dvec3(0.0, -1.75, 1.875), dvec3(2.0, 0.0, 1.35),
    dvec3(2.0, -1.12, 1.35), dvec3(1.12, -2.0, 1.35), dvec3(0.0, -2.0, 1.35),
    dvec3(2.0, 0.0, 0.9), dvec3(2.0, -1.12, 0.9), dvec3(1.12, -2.0, 0.9),
    dvec3(0.0, -2.0, 0.9), dvec3(-2.0, 0.0, 0.9), dvec3(2.0, 0.0, 0.45),
    dvec3(2.0, -1.12, 0.45), dvec3(1.12, -2.0, 0.45), dvec3(0.0, -2.0, 0.45),
    dvec3(1.5, 0.0, 0.225), dvec3(1.5, -0.84, 0.225), dvec3(0.84, -1.5, 0.225),
    dvec3(0.0, -1.5, 0.225), dvec3(1.5, 0.0, 0.15), dvec3(1.5, -0.84, 0.15),
    dvec3(0.84, -1.5, 0.15), dvec3(0.0, -1.5, 0.15), dvec3(-1.6, 0.0, 2.025),
    dvec3(-1.6, -0.3, 2.025), dvec3(-1.5, -0.3, 2.25), dvec3(-1.5, 0.0, 2.25),
    dvec3(-2.3, 0.0, 2.025), dvec3(-2.3, -0.3, 2.025), dvec3(-2.5, -0.3, 2.25),
    dvec3(-2.5, 0.0, 2.25), dvec3(-2.7, 0.0, 2.025), dvec3(-2.7, -0.3, 2.025),
    dvec3(-3.0, -0.3, 2.25), dvec3(-3.0, 0.0, 2.25), dvec3(-2.7, 0.0, 1.8),
    dvec3(-2.7, -0.3, 1.8), dvec3(-3.0, -0.3, 1.8), dvec3(-3.0, 0.0, 1.8),
    dvec3(-2.7, 0.0, 1.575), dvec3(-2.7, -0.3, 1.575), dvec3(-3.0, -0.3, 1.35),
    dvec3(-3.0, 0.0, 1.35), dvec3(-2.5, 0.0, 1.125), dvec3(-2.5, -0.3, 1.125),
    dvec3(-2.65, -0.3, 0.9375), dvec3(-2.65, 0.0, 0.9375), dvec3(-2.0, -0.3, 0.9),
    dvec3(-1.9, -0.3, 0.6), dvec3(-1.9, 0.0, 0.6), dvec3(1.7, 0.0, 1.425),
    dvec3(1.7, -0.66, 1.425), dvec3(1.7, -0.66, 0.6), dvec3(1.7, 0.0, 0.6),
    dvec3(2.6, 0.0, 1.425), dvec3(2.6, -0.66, 1.425), dvec3(3.1, -0.66, 0.825),
    dvec3(3.1, 0.0, 0.825), dvec3(2.3, 0.0, 2.1), dvec3(2.3, -0.25, 2.1),
    dvec3(2.4, -0.25, 2.025), dvec3(2.4, 0.0, 2.025), dvec3(2.7, 0.0, 2.4),
    dvec3(2.7, -0.25, 2.4), dvec3(3.3, -0.25, 2.4), dvec3(3.3, 0.0, 2.4),
    dvec3(2.8, 0.0, 2.475), dvec3(2.8, -0.25, 2.475), dvec3(3.525, -0.25, 2.49375),
    dvec3(3.525, 0.0, 2.49375), dvec3(2.9, 0.0, 2.475), dvec3(2.9, -0.15, 2.475),
    dvec3(3.45, -0.15, 2.5125), dvec3(3.45, 0.0, 2.5125), dvec3(2.8, 0.0, 2.4),
    dvec3(2.8, -0.15, 2.4), dvec3(3.2, -0.15, 2.4), dvec3(3.2, 0.0, 2.4),
    dvec3(0.0, 0.0, 3.15), dvec3(0.8, 0.0, 3.15), dvec3(0.8, -0.45, 3.15),
    dvec3(0.45, -0.8, 3.15), dvec3(0.0, -0.8, 3.15), dvec3(0.0, 0.0, 2.85),
    dvec3(1.4, 0.0, 2.4), dvec3(1.4, -0.784, 2.4), dvec3(0.784, -1.4, 2.4),
    dvec3(0.0, -1.4, 2.4), dvec3(0.4, 0.0, 2.55), dvec3(0.4, -0.224, 2.55),
    dvec3(0.224, -0.4, 2.55), dvec3(0.0, -0.4, 2.55), dvec3(1.3, 0.0, 2.55),
    dvec3(1.3, -0.728, 2.55), dvec3(0.728, -1.3, 2.55), dvec3(0.0, -1.3, 2.55),
    dvec3(1.3, 0.0, 2.4), dvec3(1.3, -0.728, 2.4), dvec3(0.728, -1.3, 2.4),
    dvec3(0.0, -1.3, 2.4), dvec3(0.0, 0.0, 0.0), dvec3(1.425, -0.798, 0.0),
    dvec3(1.5, 0.0, 0.075), dvec3(1.425, 0.0, 0.0), dvec3(0.798, -1.425, 0.0),
    dvec3(0.0, -1.5, 0.075), dvec3(0.0, -1.425, 0.0), dvec3(1.5, -0.84, 0.075),
    dvec3(0.84, -1.5, 0.075),
];
