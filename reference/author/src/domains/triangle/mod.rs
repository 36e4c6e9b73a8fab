//! The domain of `Triangle::hit`.

mod aspects;
mod draw;
mod plane;

use self::aspects::{RAY_ASPECTS, SUBJECT_ASPECTS};
use super::shape::{self, HARDLY_MOVED, HARDLY_TURNED, MIRRORED_START, ShapeCall};
use super::{FunctionDomain, not_asked};

pub use draw::tables;
pub use plane::Plane;

/// The domain of `Triangle::hit`.
pub static TRIANGLE: FunctionDomain<ShapeCall> = FunctionDomain {
    aspects: &[SUBJECT_ASPECTS, RAY_ASPECTS],
    pairs: &[
        ["size", "axis"],
        ["size", "start"],
        ["size", "crossing"],
        ["size", "cosine"],
        ["cosine", "crossing"],
    ],
    not_asked: &[
        not_asked(&["call before"])
            .classes(&[HARDLY_TURNED, HARDLY_MOVED])
            .columns(&["`None`", "normal", "origin", "shape", "uv"])
            .because(
                "A change this small has a noticeable effect only on the distance and the \
                 position.",
            ),
        not_asked(&["distance"])
            .columns(&["`None`"])
            .because("A miss has no distance."),
        not_asked(&["start"])
            .classes(&["points away"])
            .because("A ray that points away from the triangle hits nothing."),
        not_asked(&["start"]).classes(&["on the surface"]).because(
            "A ray in this class starts on the triangle. Its start is a hit only if its \
             range begins there, but no range in an exam begins or ends so close to the \
             triangle. So the ray hits nothing.",
        ),
        not_asked(&["crossing"])
            .classes(&[
                "just outside an edge",
                "outside",
                "far outside",
                "outside two edges",
            ])
            .because("A ray that passes outside the triangle hits nothing."),
        not_asked(&["crossing"])
            .classes(&["just inside an edge"])
            .columns(&[
                "`None`", "distance", "normal", "origin", "position", "shape",
            ])
            .because(
                "Only the items `triangle.outside` and `triangle.uv_corners` test rays close to \
                 an edge, so that a mistake at the edges costs few points. Of the quantities, \
                 only the texture coordinates are judged, because they show errors in small \
                 weights.",
            ),
        not_asked(&["call before"])
            .classes(&[
                "the same ray with its axes in another order",
                MIRRORED_START,
            ])
            .columns(&["normal", "origin", "position", "shape", "uv"])
            .because(
                "A ray like this hits only shapes near the origin, so it is enough if an exam \
                 tests the distance to the hit.",
            ),
        not_asked(&["call before"])
            .classes(&["the opposite direction"])
            .columns(&["normal", "position", "uv"])
            .because(
                "The items about these quantities test rays from the front, and one of two \
                 opposite rays comes from behind.",
            ),
        not_asked(&["almost right and far"])
            .columns(&[
                "`None`", "some", "distance", "normal", "origin", "position", "shape",
            ])
            .because(
                "Where an angle is almost right, the error shows in texture coordinates that \
                 differ widely.",
            ),
        not_asked(&["small weights"])
            .columns(&[
                "`None`", "some", "distance", "normal", "origin", "position", "shape",
            ])
            .because(
                "A weight below a thousandth has a noticeable effect only on the texture \
                 coordinates.",
            ),
        not_asked(&["interpolated normal"])
            .columns(&[
                "`None`", "some", "distance", "origin", "position", "shape", "uv",
            ])
            .because("Only the normal depends on it."),
        not_asked(&["close to a corner"])
            .columns(&["`None`"])
            .because("The rays in this class hit the triangle."),
        not_asked(&["narrowly outside"])
            .columns(&[
                "some", "distance", "normal", "origin", "position", "shape", "uv",
            ])
            .because("A ray that passes outside the triangle hits nothing."),
        not_asked(&["form"])
            .classes(&[
                "narrow at p0",
                "narrow at p1",
                "narrow at p2",
                "flat at p0",
                "flat at p1",
                "flat at p2",
            ])
            .columns(&["normal", "uv", "origin", "position", "shape"])
            .because(
                "For narrow and flat triangles, the usual formulas are not accurate enough in \
                 single precision: the errors of the weights exceed the tolerances. So the \
                 items that judge normals or texture coordinates contain no such triangles. The \
                 other quantities do not depend on the weights.",
            ),
        not_asked(&["altitude"])
            .columns(&["normal", "uv", "origin", "position", "shape"])
            .because(
                "Triangles this flat are rarely tested, for the same reason as other flat \
                 triangles.",
            ),
        not_asked(&["cosine"])
            .classes(&["below 0.01"])
            .columns(&["normal", "uv"])
            .because(
                "At a cosine this small, the usual formulas seldom compute the weights \
                 accurately enough in single precision. So it is enough if an exam tests the \
                 other quantities.",
            ),
        not_asked(&["cosine"])
            .classes(&["below 0.01"])
            .columns(&["pairs"])
            .because(
                "At a cosine this small, almost all rays cross the plane far outside the \
                 triangle.",
            ),
        not_asked(&["place"])
            .classes(&["1,000 sizes away"])
            .columns(&["normal", "uv"])
            .because(
                "At this distance from the origin, rounding the corners' coordinates changes \
                 the weights by more than the tolerances for normals and texture coordinates \
                 allow.",
            ),
        not_asked(&["distance"])
            .classes(&["2000", "3000"])
            .columns(&["normal", "origin", "position", "shape", "uv"])
            .because(
                "Only the largest triangles are hit from so far away, so it is enough if an \
                 exam tests the distance to the hit.",
            ),
    ],
    ..FunctionDomain::new("Triangle::hit", shape::calls)
};
