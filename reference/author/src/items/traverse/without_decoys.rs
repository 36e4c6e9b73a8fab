//! Trees that tell the truth: every primitive lies in its leaf, but for orphans.

use glam::DVec3;
use grader::exam::Item;
use protocol::Shape;

use super::{item, needs, question_without_decoys, ray_from_around, soup_tree};
use crate::items::{meshes, ray};
use crate::oracle::{Ray64, scan};
use crate::seed::{Rng, Seed};
use crate::tree::{Tree, construction};

pub(super) fn closest_hit(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.closest_hit");
    // Large facets: the boxes of siblings overlap much.
    let tree = soup_tree(&mut draw, 40, 1.6, 1);
    item(
        "closest_hit",
        1,
        [
            "of all hits the closest is the answer, not the first that is found",
            "Boxes overlap: the child that is entered first may hold a hit that is farther than one \
             in the other. Keep the closest so far, and look on.",
        ],
        vec![question_without_decoys(
            &mut draw,
            tree,
            [24, 8],
            ray_from_around,
        )],
    )
}

pub(super) fn first_box_empty(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.first_box_empty");
    // Small facets in large boxes.
    let tree = soup_tree(&mut draw, 40, 0.5, 1);
    item(
        "first_box_empty",
        1,
        [
            "a box that is hit may hold nothing that is",
            "As long as nothing was hit there is no closest hit, and nothing is farther away than \
             it: a distance that starts at 0 skips everything.",
        ],
        vec![question_without_decoys(
            &mut draw,
            tree,
            [16, 16],
            ray_from_around,
        )],
    )
}

pub(super) fn range(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.range");
    let tree = soup_tree(&mut draw, 40, 1.4, 1);
    // From between the first two of the hits, or up to somewhere before the first or the second.
    let kind = |draw: &mut Rng, tree: &Tree| {
        draw.retry(|draw| {
            let ray = ray_from_around(draw, tree);
            let beam = Ray64::from(&ray);
            let first = tree.expected_hit(&beam)?.distance;
            let rest = Ray64 {
                min: first + 0.05,
                ..beam
            };
            let second = tree.expected_hit(&rest)?.distance;
            let (min, max) = match draw.index(3) {
                0 => (draw.uniform(first, second), second + 9.0),
                1 => (0.0, draw.uniform(first * 0.5, first)),
                _ => (0.0, draw.uniform(first, second)),
            };
            Some(ray.within(min as f32, max as f32))
        })
    };
    item(
        "range",
        1,
        [
            "only hits within the ray's range count",
            "The ray's own range is the first limit; a closer hit only makes it smaller. It has \
                 a start as well.",
        ],
        vec![question_without_decoys(&mut draw, tree, [20, 8], kind)],
    )
}

pub(super) fn leaf_of_several(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.leaf_of_several");
    let tree = soup_tree(&mut draw, 48, 1.0, 8);
    // Of several hits in a leaf the closest is now that of its first primitive, now that of its
    // last, now one between.
    let mut turns = 0;
    let kind = |draw: &mut Rng, tree: &Tree| {
        draw.retry(|draw| {
            let ray = ray_from_around(draw, tree);
            let beam = Ray64::from(&ray);
            let Some(leaf) = tree.leaf_of_hit(&beam) else {
                return Some(ray);
            };
            let places = tree.primitives(leaf);
            let met = places.clone().filter_map(|place| {
                let met = scan::intersect(&beam, &tree.shapes[place])?;
                Some((met.distance, place))
            });
            let met: Vec<(f64, usize)> = met.collect();
            let &(_, closest) = met.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
            let is_in_turn = match turns % 3 {
                0 => closest == places.start,
                1 => closest + 1 == places.end,
                _ => closest != places.start && closest + 1 != places.end,
            };
            if met.len() < 2 || !is_in_turn {
                return None;
            }
            turns += 1;
            Some(ray)
        })
    };
    item(
        "leaf_of_several",
        1,
        [
            "every primitive of a leaf is asked",
            "A leaf holds primitives[start..start + size]; the closest of their hits counts, not the \
             first.",
        ],
        vec![question_without_decoys(&mut draw, tree, [24, 8], kind)],
    )
}

pub(super) fn deep(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.deep");
    const LEVELS: usize = 60;
    let chips = (0..LEVELS).map(|i| {
        let center = DVec3::X * (0.5 * i as f64) + draw.point(0.3);
        meshes::random_flat_triangle(&mut draw, center, 0.5)
    });
    let chips: Vec<Shape> = chips.collect();
    let tree = construction::chain(meshes::number_shapes(chips));
    // Along the chain, from either end, and across it.
    let kind = |draw: &mut Rng, _: &Tree| {
        let target = DVec3::X * draw.uniform(0.0, 30.0) + draw.point(0.4);
        let away = match draw.index(3) {
            0 => DVec3::X + draw.point(0.2),
            1 => DVec3::NEG_X + draw.point(0.2),
            _ => draw.direction(),
        };
        ray(target + 6.0 * away, target)
    };
    item(
        "deep",
        1,
        [
            "a tree of 60 levels is walked to its end",
            "A stack of fixed size must be large enough, and what is put on it must come off again.",
        ],
        vec![question_without_decoys(&mut draw, tree, [24, 8], kind)],
    )
}

pub(super) fn flat(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.flat");
    // Axis-parallel facets, one to a leaf.
    let tiles = (0..36).map(|i| {
        let axis = i % 3;
        let (x, y) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
        let corner = draw.point(2.0);
        let size = draw.uniform(0.6, 1.4) * draw.sign();
        meshes::flat_triangle([corner, corner + size * x, corner + size * y], 0)
    });
    let tiles: Vec<Shape> = tiles.collect();
    let tree = construction::median_split(meshes::number_shapes(tiles), 1);
    item(
        "flat",
        1,
        [
            "leaves with flat boxes are entered",
            "A ray enters a box without thickness and leaves it at the same time. If the box test is \
             right, see how its answer is used: an interval of one point is not empty.",
        ],
        vec![question_without_decoys(
            &mut draw,
            tree,
            [24, 8],
            ray_from_around,
        )],
    )
}

pub(super) fn mixed(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.mixed");
    let shapes = (0..36).map(|i| {
        let center = draw.point(2.0);
        if i % 2 == 0 {
            meshes::random_flat_triangle(&mut draw, center, 0.9)
        } else {
            Shape::Sphere {
                center: center.as_vec3(),
                radius: draw.uniform(0.2, 0.5) as f32,
                material: 0,
            }
        }
    });
    let shapes: Vec<Shape> = shapes.collect();
    let tree = construction::median_split(meshes::number_shapes(shapes), 1);
    let item = item(
        "mixed",
        1,
        [
            "spheres and triangles live in one tree",
            "Primitive::hit asks whichever it is; their distances are compared alike.",
        ],
        vec![question_without_decoys(
            &mut draw,
            tree,
            [24, 8],
            ray_from_around,
        )],
    );
    needs::add(item, &needs::SPHERES)
}
