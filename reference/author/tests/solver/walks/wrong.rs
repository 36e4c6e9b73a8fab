//! Wrong walks.

use protocol::{Ray, Shape, Trace};

use super::parts::{Culling, Order, Parts, Pruning, RIGHT, visit, walk};
use super::{Walk, ask, closest};

pub const WRONG_WALKS: [(&str, Walk); 22] = [
    ("never", |_, rays| vec![None; rays.len()]),
    ("linear scan", |scene, rays| {
        rays.iter().map(|ray| closest(ray, scene.shapes)).collect()
    }),
    ("every leaf", |scene, rays| {
        let parts = Parts {
            culls: Culling::Never,
            prunes: Pruning::Never,
            ..RIGHT
        };
        walk(parts, scene, rays)
    }),
    ("no culling", |scene, rays| {
        walk(
            Parts {
                culls: Culling::Never,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("both children if either is hit", |scene, rays| {
        walk(
            Parts {
                culls: Culling::BothIfEither,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("no pruning", |scene, rays| {
        walk(
            Parts {
                prunes: Pruning::Never,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("far child first", |scene, rays| {
        walk(
            Parts {
                order: Order::Farther,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("l first, pruning", |scene, rays| {
        walk(
            Parts {
                order: Order::L,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("r first, pruning", |scene, rays| {
        walk(
            Parts {
                order: Order::R,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("l first, no pruning", |scene, rays| {
        walk(
            Parts {
                order: Order::L,
                prunes: Pruning::Never,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("prunes by where the box ends", |scene, rays| {
        walk(
            Parts {
                prunes: Pruning::ByExit,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("first leaf that is hit", |scene, rays| {
        walk(
            Parts {
                first_found: true,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("near child only", |scene, rays| {
        scene.each(rays, |ray| {
            let mut place = scene.root;
            while !scene.node(place).is_leaf() {
                let [l, r] = scene.children(place);
                let entry = |child| {
                    scene
                        .span(child, ray)
                        .map_or(f32::INFINITY, |span| span.min)
                };
                place = if entry(l) <= entry(r) { l } else { r };
            }
            closest(ray, scene.in_leaf(place))
        })
    }),
    ("begins at the first node", |scene, rays| {
        walk(
            Parts {
                root: |_| 0,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("begins at the last node", |scene, rays| {
        walk(
            Parts {
                root: |scene| scene.nodes.len() - 1,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("first primitive of a leaf", |scene, rays| {
        walk(
            Parts {
                leaf: |ray, shapes| closest(ray, &shapes[..1.min(shapes.len())]),
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("last hit of a leaf", |scene, rays| {
        let leaf =
            |ray: &Ray, shapes: &[Shape]| shapes.iter().filter_map(|s| ask(ray, s)).next_back();
        walk(Parts { leaf, ..RIGHT }, scene, rays)
    }),
    ("a closest hit that starts at 0", |scene, rays| {
        walk(
            Parts {
                start: 0.0,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("the box test shrinks the ray", |scene, rays| {
        walk(
            Parts {
                culls: Culling::Shrinks,
                ..RIGHT
            },
            scene,
            rays,
        )
    }),
    ("remembers the last ray's closest hit", |scene, rays| {
        let mut best: Option<Trace> = None;
        let mut answers = Vec::new();
        for ray in rays {
            if !scene.nodes.is_empty() {
                visit(RIGHT, scene, scene.root, &mut ray.clone(), &mut best);
            }
            answers.push(best);
        }
        answers
    }),
    ("ignores the ray's range", |scene, rays| {
        let rays: Vec<Ray> = rays
            .iter()
            .map(|ray| ray.within(0.0, f32::INFINITY))
            .collect();
        walk(RIGHT, scene, &rays)
    }),
    ("a stack of 32", |scene, rays| {
        scene.each(rays, |ray| {
            let mut best = None;
            let mut open = vec![scene.root];
            while let Some(place) = open.pop() {
                let Some(span) = scene.span(place, ray) else {
                    continue;
                };
                if best.is_some_and(|best: Trace| best.distance < span.min) {
                    continue;
                }
                if scene.node(place).is_leaf() {
                    best = Trace::nearer(best, closest(ray, scene.in_leaf(place)));
                    continue;
                }
                let [l, r] = scene.children(place);
                let entry = |child| {
                    scene
                        .span(child, ray)
                        .map_or(f32::INFINITY, |span| span.min)
                };
                // All that goes down the chain stays on the stack.
                open.extend(if entry(l) <= entry(r) { [r, l] } else { [l, r] });
                open.truncate(32);
            }
            best
        })
    }),
];
