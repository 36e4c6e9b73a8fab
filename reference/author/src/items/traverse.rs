//! Task 3, step 2: walking trees; the exam's own, so that nothing hangs on a submission's `build`.
//!
//! Before some of the rays stand *orphans*: primitives that are in no leaf. Whoever asks all
//! primitives, without the tree, answers those. See [`crate::tree::trap`] for the traps that tell
//! ways of walking apart. Where the root stands is the idea of one item; in all others whoever
//! begins at the first node or the last begins rightly.

use glam::{DVec3, UVec2, Vec3};
use grader::exam::{Asked, Item, Key, Part, Task};
use protocol::{Question, Ray, Rays, Shape, TreeNode};

use super::{meshes, picture};
use crate::oracle::{Beam, scan};
use crate::recorded::Recorded;
use crate::seed::{Draw, Seed};
use crate::tree::trap::{self, Shelter};
use crate::tree::walk::Walk;
use crate::tree::{RootPlace, Tree, plant};

/// The items of the task `traverse`, but for [`radiance_item`].
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 15] = [
        closest_hit,
        first_box_empty,
        range,
        root,
        leaf_of_several,
        deep,
        flat,
        mixed,
        no_nodes,
        skips_missed,
        prunes,
        nearer_first,
        both_sides,
        own_tree,
        picture,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

fn item(name: &str, points: u32, text: [&str; 2], questions: Vec<Asked>) -> Item {
    Item {
        needs: vec!["triangle.inside".to_owned(), "bbox.through".to_owned()],
        ..super::item(Task::Traverse, name, points, text, questions)
    }
}

/// The materials of orphans and traps begin here, those of the tree's own primitives at 0.
const FIRST_ORPHAN: u32 = 10_000;
const FIRST_TRAP: u32 = 20_000;

/// What the rays meet in the tree. Distances tell everything: no two primitives that a ray could
/// answer are at the same.
fn asked(tree: &Tree, rays: Vec<Ray>) -> Asked {
    Asked {
        key: super::hits(&[Part::Distance], &rays, |beam| tree.truth(beam)),
        question: tree.question(rays),
    }
}

/// Whether the slides' pseudo-code, taken literally, answers this ray rightly.
fn slides_are_right(tree: &Tree, ray: &Ray) -> bool {
    let beam = Beam::from(ray);
    Walk::slides(tree, &beam).closest == tree.truth(&beam)
}

/// A ray from around the tree toward somewhere in it.
fn from_around(draw: &mut Draw, tree: &Tree) -> Ray {
    let bounds = tree.bounds(tree.root);
    let target = bounds.center() + draw.point(0.45) * (bounds.max - bounds.min);
    let away = draw.direction() * draw.uniform(0.6, 1.0) * bounds.diagonal();
    super::ray(target + away, target)
}

/// Rays about which there is no doubt: so many that hit something, and so many that do not.
fn rays(
    draw: &mut Draw,
    tree: &Tree,
    [hits, misses]: [usize; 2],
    mut kind: impl FnMut(&mut Draw, &Tree) -> Ray,
) -> Vec<Ray> {
    let mut rays = Vec::new();
    for (wanted, count) in [(true, hits), (false, misses)] {
        for _ in 0..count {
            rays.push(draw.until(|draw| {
                let ray = kind(draw, tree);
                let hits = tree.truth(&Beam::from(&ray)).is_some();
                (hits == wanted && trap::is_fair(tree, &[ray])).then_some(ray)
            }));
        }
    }
    draw.shuffled(rays)
}

/// Puts orphans before every third ray.
fn add_orphans(draw: &mut Draw, tree: &mut Tree, rays: &[Ray]) {
    for (number, ray) in (FIRST_ORPHAN..).zip(rays.iter().step_by(3)) {
        let end = tree.truth(&Beam::from(ray)).map_or(3.0, |met| met.distance);
        let start = f64::from(ray.range.min);
        let distance = start + (end - start) * draw.uniform(0.3, 0.7);
        let orphan = trap::facet(draw, ray, distance, 0.1, number);
        tree.shapes.push(orphan);
    }
}

/// A question whose tree tells the truth, but for orphans.
fn honest(
    draw: &mut Draw,
    mut tree: Tree,
    counts: [usize; 2],
    kind: impl FnMut(&mut Draw, &Tree) -> Ray,
) -> Asked {
    let rays = rays(draw, &tree, counts, kind);
    add_orphans(draw, &mut tree, &rays);
    asked(&tree.with_roots_at_both_ends(draw), rays)
}

/// A tree over a soup. Leaves of several are the idea of one item: elsewhere they hold one.
fn soup_tree(draw: &mut Draw, count: usize, size: f64, max_leaf_size: usize) -> Tree {
    plant::halves(meshes::soup(draw, count, 2.0, size), max_leaf_size)
}

fn closest_hit(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.closest_hit");
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
        vec![honest(&mut draw, tree, [24, 8], from_around)],
    )
}

fn first_box_empty(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.first_box_empty");
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
        vec![honest(&mut draw, tree, [16, 16], from_around)],
    )
}

fn range(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.range");
    let tree = soup_tree(&mut draw, 40, 1.4, 1);
    // From between the first two of the hits, or up to somewhere before the first or the second.
    let kind = |draw: &mut Draw, tree: &Tree| {
        draw.until(|draw| {
            let ray = from_around(draw, tree);
            let beam = Beam::from(&ray);
            let first = tree.truth(&beam)?.distance;
            let rest = Beam {
                min: first + 0.05,
                ..beam
            };
            let second = tree.truth(&rest)?.distance;
            let (min, max) = match draw.index(3) {
                0 => (draw.uniform(first, second), second + 9.0),
                1 => (0.0, draw.uniform(first * 0.5, first)),
                _ => (0.0, draw.uniform(first, second)),
            };
            Some(ray.within(min as f32, max as f32))
        })
    };
    Item {
        needs: [
            "triangle.inside",
            "triangle.range_max",
            "triangle.range_min",
            "bbox.through",
        ]
        .map(str::to_owned)
        .to_vec(),
        ..item(
            "range",
            1,
            [
                "only hits within the ray's range count",
                "The ray's own range is the first limit; a closer hit only makes it smaller. It has \
                 a start as well.",
            ],
            vec![honest(&mut draw, tree, [20, 8], kind)],
        )
    }
}

fn root(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.root");
    let question = |place: RootPlace| {
        let tree = soup_tree(&mut draw, 20, 0.9, 1);
        let rays = rays(&mut draw, &tree, [10, 4], from_around);
        let inner = if place == RootPlace::First {
            place
        } else {
            RootPlace::Middle
        };
        let tree = tree.rearranged(&mut draw, inner);
        asked(&beside_others(&mut draw, tree, &rays, place), rays)
    };
    item(
        "root",
        1,
        [
            "the walk begins at root, wherever that is",
            "The root need be neither the first node nor the last: Bvh::root says where it stands, \
             and there may be nodes that are no part of the tree.",
        ],
        [RootPlace::First, RootPlace::Middle, RootPlace::Last]
            .map(question)
            .to_vec(),
    )
}

/// Adds two trees, over primitives right before the rays, that do not hang below the root. Their
/// own roots stand at those ends of the list where the tree's does not.
fn beside_others(draw: &mut Draw, mut tree: Tree, rays: &[Ray], place: RootPlace) -> Tree {
    let mut decoy = |tree: &mut Tree, nearness: f64| {
        let facets = rays.iter().enumerate().map(|(i, ray)| {
            let material = FIRST_ORPHAN + tree.shapes.len() as u32 + i as u32;
            trap::facet(draw, ray, nearness, 0.1, material)
        });
        let mut left: Vec<Shape> = facets.collect();
        let right = left.split_off(left.len() / 2);
        let l = tree.leaf(left);
        let r = tree.leaf(right);
        tree.fork(l, r)
    };
    let first = decoy(&mut tree, 0.4);
    if place != RootPlace::First {
        tree.swap_nodes(0, first);
    }
    // The last node added is the last.
    let last = decoy(&mut tree, 0.6);
    if place == RootPlace::Last {
        tree.swap_nodes(tree.root, last);
    }
    tree
}

fn leaf_of_several(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.leaf_of_several");
    let tree = soup_tree(&mut draw, 48, 1.0, 8);
    item(
        "leaf_of_several",
        1,
        [
            "every primitive of a leaf is asked",
            "A leaf holds primitives[start..start + size]; the closest of their hits counts, not the \
             first.",
        ],
        vec![honest(&mut draw, tree, [24, 8], from_around)],
    )
}

fn deep(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.deep");
    const LEVELS: usize = 60;
    let chips = (0..LEVELS).map(|i| {
        let center = DVec3::X * (0.5 * i as f64) + draw.point(0.3);
        meshes::chip(&mut draw, center, 0.5)
    });
    let chips: Vec<Shape> = chips.collect();
    let tree = plant::chain(meshes::numbered(chips));
    // Along the chain, from either end, and across it.
    let kind = |draw: &mut Draw, _: &Tree| {
        let target = DVec3::X * draw.uniform(0.0, 30.0) + draw.point(0.4);
        let away = match draw.index(3) {
            0 => DVec3::X + draw.point(0.2),
            1 => DVec3::NEG_X + draw.point(0.2),
            _ => draw.direction(),
        };
        super::ray(target + 6.0 * away, target)
    };
    item(
        "deep",
        1,
        [
            "a tree of 60 levels is walked to its end",
            "A stack of fixed size must be large enough, and what is put on it must come off again.",
        ],
        vec![honest(&mut draw, tree, [24, 8], kind)],
    )
}

fn flat(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.flat");
    // Axis-parallel facets, one to a leaf.
    let tiles = (0..36).map(|i| {
        let axis = i % 3;
        let (x, y) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
        let corner = draw.point(2.0);
        let size = draw.uniform(0.6, 1.4) * draw.sign();
        meshes::facet([corner, corner + size * x, corner + size * y], 0)
    });
    let tiles: Vec<Shape> = tiles.collect();
    let tree = plant::halves(meshes::numbered(tiles), 1);
    let mut item = item(
        "flat",
        1,
        [
            "leaves with flat boxes are entered",
            "A ray enters a box without thickness and leaves it at the same time. If the box test is \
             right, see how its answer is used: an interval of one point is not empty.",
        ],
        vec![honest(&mut draw, tree, [24, 8], from_around)],
    );
    item.needs.push("bbox.flat".to_owned());
    item
}

fn mixed(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.mixed");
    let shapes = (0..36).map(|i| {
        let center = draw.point(2.0);
        if i % 2 == 0 {
            meshes::chip(&mut draw, center, 0.9)
        } else {
            Shape::Sphere {
                center: center.as_vec3(),
                radius: draw.uniform(0.2, 0.5) as f32,
                material: 0,
            }
        }
    });
    let shapes: Vec<Shape> = shapes.collect();
    let tree = plant::halves(meshes::numbered(shapes), 1);
    let mut item = item(
        "mixed",
        1,
        [
            "spheres and triangles live in one tree",
            "Primitive::hit asks whichever it is; their distances are compared alike.",
        ],
        vec![honest(&mut draw, tree, [24, 8], from_around)],
    );
    item.needs.push("sphere.near_side".to_owned());
    item
}

fn no_nodes(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.no_nodes");
    let nothing = Tree {
        shapes: Vec::new(),
        nodes: Vec::new(),
        root: 0,
    };
    let mut empty_leaf = nothing.clone();
    empty_leaf.nodes.push(TreeNode {
        min: Vec3::NEG_ONE,
        max: Vec3::ONE,
        start: 0,
        size: 0,
        l: 0,
        r: 0,
    });
    let toward = |draw: &mut Draw| {
        let target = draw.point(0.8);
        super::ray(target + 4.0 * draw.direction(), target)
    };
    let mut ask = |tree: &Tree| asked(tree, (0..8).map(|_| toward(&mut draw)).collect());
    let empty = [ask(&nothing), ask(&empty_leaf)];
    let tree = soup_tree(&mut draw, 12, 0.9, 1);
    let control = honest(&mut draw, tree, [8, 4], from_around);
    item(
        "no_nodes",
        1,
        [
            "a tree that holds nothing is hit nowhere",
            "Without nodes there is none at root: look before you take it.",
        ],
        empty.into_iter().chain([control]).collect(),
    )
}

/// A question with traps before most of the rays that hit something, each in a leaf that `fits`.
/// The slides' pseudo-code shall be `right` about the rays that got one, and is about the others.
fn trapped(draw: &mut Draw, fits: &dyn Fn(&Tree, usize, &Beam) -> bool, slides: Slides) -> Asked {
    const TRAPPED: usize = 10;
    const OTHERS: [usize; 2] = [4, 4];
    let mut tree = soup_tree(draw, 48, 0.7, 1);
    let others = rays(draw, &tree, OTHERS, from_around);
    let passing = rays(draw, &tree, [TRAPPED, 0], |draw, tree| {
        draw.until(|draw| {
            let ray = from_around(draw, tree);
            let beam = Beam::from(&ray);
            let any = tree
                .leaves()
                .into_iter()
                .any(|leaf| fits(tree, leaf, &beam));
            any.then_some(ray)
        })
    });
    let rays: Vec<Ray> = passing.into_iter().chain(others).collect();

    let mut trapped_rays = Vec::new();
    for ray in 0..TRAPPED {
        const ATTEMPTS: usize = 30;
        let material = FIRST_TRAP + ray as u32;
        let set = (0..ATTEMPTS).find_map(|_| {
            let trapped = trap::set(draw, &tree, &rays, ray, material, fits)?;
            let as_wanted = (0..).zip(&rays).all(|(place, asked)| {
                let gets_one = place == ray || trapped_rays.contains(&place);
                let wrong = gets_one && slides == Slides::Wrong;
                slides_are_right(&trapped, asked) != wrong
            });
            as_wanted.then_some(trapped)
        });
        // Not every leaf that fits is on the side that the slides treat as wanted.
        if let Some(trapped) = set {
            tree = trapped;
            trapped_rays.push(ray);
        }
    }
    add_orphans(draw, &mut tree, &rays);
    asked(&tree.with_roots_at_both_ends(draw), rays)
}

/// What the slides' pseudo-code, taken literally, makes of a trap.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Slides {
    /// It is not caught.
    Right,
    /// It is caught.
    Wrong,
}

fn is_sheltered(tree: &Tree, leaf: usize, beam: &Beam, wanted: Shelter) -> bool {
    trap::shelter(tree, leaf, beam) == Some(wanted)
}

/// Whether the ray misses the box of the leaf's sibling as well.
fn misses_sibling(tree: &Tree, leaf: usize, beam: &Beam) -> bool {
    let sibling = tree.sibling(leaf);
    sibling.is_some_and(|sibling| tree.bounds(sibling).span(beam).is_none())
}

fn skips_missed(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.skips_missed");
    let fits =
        |tree: &Tree, leaf: usize, beam: &Beam| is_sheltered(tree, leaf, beam, Shelter::Missed);
    item(
        "skips_missed",
        2,
        [
            "a node whose box the ray misses is not entered",
            "That is what the tree is for. In this exam some leaves hold primitives that lie outside \
             of their boxes: who enters a box that is missed, finds them.",
        ],
        vec![
            trapped(&mut draw, &fits, Slides::Right),
            trapped(&mut draw, &fits, Slides::Right),
        ],
    )
}

fn prunes(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.prunes");
    let fits =
        |tree: &Tree, leaf: usize, beam: &Beam| is_sheltered(tree, leaf, beam, Shelter::Beyond);
    item(
        "prunes",
        2,
        [
            "a node that begins beyond the closest hit is not entered",
            "The nearer child goes first. If what it finds is nearer than the other's box, nothing \
             in there can be nearer still.",
        ],
        vec![
            trapped(&mut draw, &fits, Slides::Right),
            trapped(&mut draw, &fits, Slides::Right),
        ],
    )
}

fn nearer_first(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.nearer_first");
    let fits =
        |tree: &Tree, leaf: usize, beam: &Beam| is_sheltered(tree, leaf, beam, Shelter::Beyond);
    item(
        "nearer_first",
        1,
        [
            "the nearer child goes first, be it l or r, and the other is pruned",
            "Where r goes first, it is l that may begin beyond the closest hit. The slides compare \
             hit2.t in both cases: compare the entry of whichever child comes second.",
        ],
        vec![trapped(&mut draw, &fits, Slides::Wrong)],
    )
}

fn both_sides(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.both_sides");
    let one = |tree: &Tree, leaf: usize, beam: &Beam| {
        is_sheltered(tree, leaf, beam, Shelter::Missed) && !misses_sibling(tree, leaf, beam)
    };
    let both = |tree: &Tree, leaf: usize, beam: &Beam| {
        is_sheltered(tree, leaf, beam, Shelter::Missed) && misses_sibling(tree, leaf, beam)
    };
    item(
        "both_sides",
        1,
        [
            "of two children each is entered only if its own box is hit",
            "If one box is missed only the other child is entered; if both are, neither. The slides \
             enter `first` in any case, and after it the child whose box was missed.",
        ],
        vec![
            trapped(&mut draw, &one, Slides::Wrong),
            trapped(&mut draw, &both, Slides::Wrong),
        ],
    )
}

/// A small question that the linear scan gets wrong, and every walk through a tree right.
fn orphans_alone(draw: &mut Draw) -> Asked {
    let tree = soup_tree(draw, 12, 0.9, 1);
    honest(draw, tree, [8, 4], from_around)
}

fn own_tree(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.own_tree");
    let tree = soup_tree(&mut draw, 400, 0.5, 4);
    let rays = rays(&mut draw, &tree, [40, 16], from_around);
    let key = super::hits(&[Part::Distance], &rays, |beam| {
        scan::closest(beam, &tree.shapes)
    });
    let own = Asked {
        question: Question::BuildAndTraverse {
            shapes: tree.shapes,
            max_leaf_size: 4,
            rays: Rays::List(rays),
        },
        key,
    };
    let mut item = item(
        "own_tree",
        1,
        [
            "your own tree, walked, finds what asking every primitive finds",
            "If all other items of both tasks pass, see what the tree that you build has and the \
             exam's do not.",
        ],
        vec![own, orphans_alone(&mut draw)],
    );
    item.needs
        .extend(["build.partition", "build.contains"].map(str::to_owned));
    item
}

fn picture(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.picture");
    let tree = soup_tree(&mut draw, 300, 0.4, 4);
    let mut tree = tree.with_roots_at_both_ends(&mut draw);
    let eye = DVec3::new(0.4, 0.7, 4.5);
    let view = picture::narrow(eye.as_vec3(), (-eye).normalize(), 0.5, 64);
    // An orphan before the left half of the view, right where the tree begins.
    let corner = |x: f64, y: f64| DVec3::new(x, y, 3.0);
    let curtain = [corner(-4.0, -4.0), corner(0.3, 0.6), corner(-4.0, 4.0)];

    let key = picture::first_hits(&view, |beam| scan::closest(beam, &tree.shapes));
    tree.shapes.push(meshes::facet(curtain, FIRST_ORPHAN));
    let question = Question::Traverse {
        shapes: tree.shapes,
        nodes: tree.nodes,
        root: tree.root as u32,
        rays: Rays::View(view),
    };
    item(
        "picture",
        2,
        [
            "a picture through a tree is right in hit, depth, normal and uv",
            "If pieces are missing, some nodes are skipped that should be entered; if pieces that \
             lie behind show, the closest hit is not kept.",
        ],
        vec![Asked { question, key }, orphans_alone(&mut draw)],
    )
}

/// What the radiance item asks; who records its key asks the reference the same.
pub fn radiance_question(seed: Seed, scene: String) -> Question {
    let mut draw = seed.draw("traverse.radiance.seed");
    Question::Radiance {
        scene,
        film: UVec2::splat(32),
        samples: 16,
        bounces: 3,
        seed: draw.index(1 << 30) as u64,
    }
}

/// A path-traced picture, and the reference's own.
pub fn radiance_item(seed: Seed, recorded: Recorded) -> Item {
    /// Of 1024 pixels; correct variants stay below half of it.
    const ALLOWED: u32 = 7;
    let picture = Asked {
        question: recorded.question,
        key: Key::Radiance {
            pixels: recorded.pixels,
            allowed: ALLOWED,
        },
    };
    let mut draw = seed.draw("traverse.radiance");
    let needs = [
        "camera.corners",
        "triangle.inside",
        "triangle.normal",
        "bbox.through",
    ];
    Item {
        needs: needs.map(str::to_owned).to_vec(),
        ..item(
            "radiance",
            2,
            [
                "all of it together draws the Cornell box",
                "Every random number is the framework's, so the picture must be the same but for a \
                 few pixels. If this is the only item that fails, look at cargo render.",
            ],
            vec![picture, orphans_alone(&mut draw)],
        )
    }
}
