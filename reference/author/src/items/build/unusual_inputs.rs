//! Items about primitives in unusual arrangements.

use glam::{DVec3, dvec3};
use judging::exam::TreeCheck::{Contains, Partition, Split, Tight};
use protocol::Shape;

use super::{build_question, item};
use crate::items::{Declaration, DeclaredItem, Group, meshes};
use crate::seed::Seed;

pub(super) fn negative(seed: Seed) -> DeclaredItem {
    let mut rng = seed.rng("build.negative");
    let far = dvec3(-20.0, -30.0, -10.0);
    let triangles = (0..80).map(|_| {
        let center = far + rng.point(4.0);
        meshes::random_flat_triangle(&mut rng, center, 0.5)
    });
    let shapes = meshes::number_shapes(triangles);
    item(
        seed,
        Declaration {
            id: "build.negative",
            points: 1,
            title: "negative coordinates work as well",
            look: "A box that grows from zero never goes below zero, and a cast to usize turns \
                   negative numbers into 0.",
            section: "building.md#start-each-box-empty",
            group: Some(Group::Trees),
            needs: &[],
        },
        vec![build_question(&[Partition, Contains, Tight], shapes, 2)],
    )
}

pub(super) fn coincident(seed: Seed) -> DeclaredItem {
    let mut rng = seed.rng("build.coincident");
    let center = rng.point(2.0);
    let same = meshes::random_flat_triangle(&mut rng, center, 0.5);
    let all = meshes::number_shapes(vec![same; 20]);
    // More than half of the primitives coincide, so a leaf that holds all of these counts as not
    // split.
    let mut some = meshes::soup(&mut rng, 17, 3.0, 0.4);
    some.extend(vec![same; 30]);
    item(
        seed,
        Declaration {
            id: "build.coincident",
            points: 1,
            title: "primitives with the same centre are split by count",
            look: "If all centres coincide, no plane separates the primitives. A leaf with all of \
                   them is too large, and a side with none of them gets you no further: split them \
                   by count.",
            section: "building.md#when-all-centres-coincide",
            group: Some(Group::Trees),
            needs: &[],
        },
        vec![
            build_question(&[Partition, Split], all.clone(), 1),
            build_question(&[Partition, Split], all, 4),
            build_question(
                &[Partition, Split],
                meshes::number_shapes(rng.shuffled(some)),
                2,
            ),
        ],
    )
}

pub(super) fn concentric(seed: Seed) -> DeclaredItem {
    let mut rng = seed.rng("build.concentric");
    let center = rng.point(2.0).as_vec3();
    let step = rng.uniform(0.2, 0.3) as f32;
    let shells = (1..=13).map(|i| Shape::Sphere {
        center,
        radius: step * i as f32,
        material: 0,
    });
    item(
        seed,
        Declaration {
            id: "build.concentric",
            points: 1,
            title: "spheres around one centre are split by count",
            look: "Their boxes differ, but their centres coincide, so no plane between buckets of \
                   centres separates them on any axis. Split them by count.",
            section: "building.md#when-all-centres-coincide",
            group: Some(Group::Trees),
            needs: &[],
        },
        vec![build_question(
            &[Partition, Split, Contains],
            meshes::number_shapes(shells),
            2,
        )],
    )
}

pub(super) fn coplanar(seed: Seed) -> DeclaredItem {
    let mut rng = seed.rng("build.coplanar");
    let question = |axis: usize| {
        let start = rng.point(4.0);
        let size = rng.uniform(0.7, 1.3);
        let (x, y) = (
            size * DVec3::AXES[(axis + 1) % 3],
            size * DVec3::AXES[(axis + 2) % 3],
        );
        let cells = (0..64).map(|cell| {
            let corner = start + f64::from(cell % 8) * x + f64::from(cell / 8) * y;
            meshes::flat_triangle([corner, corner + x, corner + y], 0)
        });
        build_question(
            &[Partition, Split, Contains],
            meshes::number_shapes(cells),
            2,
        )
    };
    item(
        seed,
        Declaration {
            id: "build.coplanar",
            points: 1,
            title: "a flat grid works as well",
            look: "Along one axis all centres coincide: no plane separates them there, and \
                   dividing by their extent gives NaN. Both the search for the cheapest partition \
                   and the partition itself need another axis.",
            section: "building.md#an-axis-without-extent",
            group: Some(Group::Trees),
            needs: &[],
        },
        [0, 1, 2].map(question).to_vec(),
    )
}

pub(super) fn collinear(seed: Seed) -> DeclaredItem {
    let mut rng = seed.rng("build.collinear");
    let question = |axis: usize| {
        let start = rng.point(4.0);
        let step = rng.uniform(0.6, 0.9);
        let radius = rng.uniform(0.2, 0.3) as f32;
        let row = (0..40).map(|i| {
            let center = start + step * f64::from(i) * DVec3::AXES[axis];
            Shape::Sphere {
                center: center.as_vec3(),
                radius,
                material: 0,
            }
        });
        build_question(&[Partition, Split, Contains], meshes::number_shapes(row), 3)
    };
    item(
        seed,
        Declaration {
            id: "build.collinear",
            points: 1,
            title: "a row of primitives works as well, along any axis",
            look: "Along two axes all centres coincide. Find the third one, whether it is x, y or \
                   z.",
            section: "building.md#an-axis-without-extent",
            group: Some(Group::Trees),
            needs: &[],
        },
        [0, 1, 2].map(question).to_vec(),
    )
}

pub(super) fn outlier(seed: Seed) -> DeclaredItem {
    let mut rng = seed.rng("build.outlier");
    let mut crowd = |far: f64| {
        let mut shapes = meshes::soup(&mut rng, 40, 1.0, 0.1);
        let center = far * rng.direction();
        shapes.push(meshes::random_flat_triangle(&mut rng, center, 0.5));
        meshes::number_shapes(rng.shuffled(shapes))
    };
    let checks = [Partition, Split, Contains];
    let questions = vec![
        build_question(&checks, crowd(100.0), 2),
        build_question(&checks, crowd(1000.0), 2),
    ];
    // Each triangle is a quarter larger than the one before, so the last is over 1000 times as
    // large as the first.
    let growing = (0..32).map(|i| {
        let size = 1e-3 * 1.25f64.powi(i);
        meshes::random_flat_triangle(&mut rng, 4.0 * size * DVec3::ONE, size)
    });
    let growing = meshes::number_shapes(growing);
    item(
        seed,
        Declaration {
            id: "build.outlier",
            points: 1,
            title: "one primitive far from all others does not spoil the tree",
            look: "Most of the others are then in one bucket. The split still helps: they are in a \
                   smaller node, which gets buckets of its own.",
            section: "building.md#one-primitive-far-from-the-others",
            group: Some(Group::Trees),
            needs: &[],
        },
        questions
            .into_iter()
            .chain([build_question(&checks, growing, 1)])
            .collect(),
    )
}

pub(super) fn one_or_none(seed: Seed) -> DeclaredItem {
    let mut rng = seed.rng("build.one_or_none");
    let checks = [Partition, Contains];
    let one = meshes::soup(&mut rng, 1, 2.0, 0.5);
    let two = meshes::soup(&mut rng, 2, 2.0, 0.5);
    item(
        seed,
        Declaration {
            id: "build.one_or_none",
            points: 1,
            title: "trees of zero, one and two primitives are built",
            look: "For no primitives, build no nodes or one leaf of size 0. For one primitive, \
                   build one leaf.",
            section: "building.md#very-small-inputs",
            group: Some(Group::Trees),
            needs: &[],
        },
        vec![
            build_question(&checks, Vec::new(), 4),
            build_question(&checks, Vec::new(), 1),
            build_question(&checks, one, 1),
            build_question(&checks, two.clone(), 1),
            build_question(&checks, two, 4),
        ],
    )
}
