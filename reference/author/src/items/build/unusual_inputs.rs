//! Primitives in unusual places.

use glam::{DVec3, dvec3};
use grader::exam::Item;
use grader::exam::TreeCheck::{Contains, Partition, Split, Tight};
use protocol::Shape;

use super::{build_question, item};
use crate::items::meshes;
use crate::seed::Seed;

pub(super) fn negative(seed: Seed) -> Item {
    let mut draw = seed.rng("build.negative");
    let far = dvec3(-20.0, -30.0, -10.0);
    let chips = (0..80).map(|_| {
        let center = far + draw.point(4.0);
        meshes::random_flat_triangle(&mut draw, center, 0.5)
    });
    let shapes = meshes::number_shapes(chips);
    item(
        "negative",
        1,
        [
            "coordinates below zero are no exception",
            "A box that grows from zero never gets below it, and a cast to usize turns what is \
             negative into 0.",
        ],
        vec![build_question(&[Partition, Contains, Tight], shapes, 2)],
    )
}

pub(super) fn coincident(seed: Seed) -> Item {
    let mut draw = seed.rng("build.coincident");
    let center = draw.point(2.0);
    let same = meshes::random_flat_triangle(&mut draw, center, 0.5);
    let all = meshes::number_shapes(vec![same; 20]);
    // More than half, so that a leaf of them all is one that was not split.
    let mut some = meshes::soup(&mut draw, 17, 3.0, 0.4);
    some.extend(vec![same; 30]);
    item(
        "coincident",
        1,
        [
            "primitives in the same place are split by count",
            "If all centers coincide, all are in one bucket and no plane separates them: see that \
             both sides get some, or it never ends.",
        ],
        vec![
            build_question(&[Partition, Split], all.clone(), 1),
            build_question(&[Partition, Split], all, 4),
            build_question(
                &[Partition, Split],
                meshes::number_shapes(draw.shuffled(some)),
                2,
            ),
        ],
    )
}

pub(super) fn concentric(seed: Seed) -> Item {
    let mut draw = seed.rng("build.concentric");
    let center = draw.point(2.0).as_vec3();
    let shells = (1..=13).map(|i| Shape::Sphere {
        center,
        radius: 0.25 * i as f32,
        material: 0,
    });
    item(
        "concentric",
        1,
        [
            "shells around one center are split by count",
            "Their boxes differ, and still their centers coincide: what is divided by the extent of \
             the centers is divided by zero.",
        ],
        vec![build_question(
            &[Partition, Split, Contains],
            meshes::number_shapes(shells),
            2,
        )],
    )
}

pub(super) fn coplanar(seed: Seed) -> Item {
    let mut draw = seed.rng("build.coplanar");
    let question = |axis: usize| {
        let mut height = DVec3::ZERO;
        height[axis] = draw.uniform(-2.0, 2.0);
        let (x, y) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
        let cells = (0..64).map(|cell| {
            let corner = height + f64::from(cell % 8) * x + f64::from(cell / 8) * y;
            meshes::flat_triangle([corner, corner + x, corner + y], 0)
        });
        build_question(
            &[Partition, Split, Contains],
            meshes::number_shapes(cells),
            2,
        )
    };
    item(
        "coplanar",
        1,
        [
            "a flat grid is no exception",
            "Along one axis all centers coincide: what is divided by their extent there is not a \
             number, and must not become a bucket.",
        ],
        [0, 1, 2].map(question).to_vec(),
    )
}

pub(super) fn collinear(_: Seed) -> Item {
    let question = |axis: usize| {
        let row = (0..40).map(|i| {
            let center = 0.75 * f64::from(i) * DVec3::AXES[axis];
            Shape::Sphere {
                center: center.as_vec3(),
                radius: 0.25,
                material: 0,
            }
        });
        build_question(&[Partition, Split, Contains], meshes::number_shapes(row), 3)
    };
    item(
        "collinear",
        1,
        [
            "a row is no exception, along whichever axis",
            "Along two axes all centers coincide. The third must be found, be it x, y or z.",
        ],
        [0, 1, 2].map(question).to_vec(),
    )
}

pub(super) fn outlier(seed: Seed) -> Item {
    let mut draw = seed.rng("build.outlier");
    let mut crowd = |far: f64| {
        let mut shapes = meshes::soup(&mut draw, 40, 1.0, 0.1);
        let center = far * draw.direction();
        shapes.push(meshes::random_flat_triangle(&mut draw, center, 0.5));
        meshes::number_shapes(draw.shuffled(shapes))
    };
    let judged = [Partition, Split, Contains];
    let questions = vec![
        build_question(&judged, crowd(100.0), 2),
        build_question(&judged, crowd(1000.0), 2),
    ];
    // Growing by a quarter from one to the next: over a thousand times from end to end.
    let growing = (0..32).map(|i| {
        let size = 1e-3 * 1.25f64.powi(i);
        meshes::random_flat_triangle(&mut draw, 4.0 * size * DVec3::ONE, size)
    });
    let growing = meshes::number_shapes(growing);
    item(
        "outlier",
        1,
        [
            "one far from all others does not spoil the tree",
            "Then all others are in one bucket. The split is still one: they are in a smaller node \
             than before, with buckets of its own.",
        ],
        questions
            .into_iter()
            .chain([build_question(&judged, growing, 1)])
            .collect(),
    )
}

pub(super) fn one_or_none(seed: Seed) -> Item {
    let mut draw = seed.rng("build.one_or_none");
    let judged = [Partition, Contains];
    let one = meshes::soup(&mut draw, 1, 2.0, 0.5);
    let two = meshes::soup(&mut draw, 2, 2.0, 0.5);
    item(
        "one_or_none",
        1,
        [
            "no primitives, one, or two: a tree of its own each",
            "Of nothing: no nodes, or one leaf of size 0. Of one: one leaf.",
        ],
        vec![
            build_question(&judged, Vec::new(), 4),
            build_question(&judged, one, 1),
            build_question(&judged, two.clone(), 1),
            build_question(&judged, two, 4),
        ],
    )
}
