//! Ways through a tree in single precision: right ones, and wrong ones.

use protocol::{Interval, Ray, Shape, Trace, TreeNode};

use super::shapes::{SPHERES, TRIANGLES};
use super::{Solver, boxes};

/// What is walked.
pub struct Scene<'a> {
    pub shapes: &'a [Shape],
    pub nodes: &'a [TreeNode],
    pub root: usize,
}

/// The answers to all rays of a question, one after the other.
pub type Walk = fn(&Scene, &[Ray]) -> Vec<Option<Trace>>;

impl Scene<'_> {
    fn node(&self, place: usize) -> &TreeNode {
        &self.nodes[place]
    }

    fn children(&self, place: usize) -> [usize; 2] {
        let node = self.node(place);
        [node.l as usize, node.r as usize]
    }

    fn in_leaf(&self, place: usize) -> &[Shape] {
        let node = self.node(place);
        &self.shapes[node.start as usize..(node.start + node.size) as usize]
    }

    fn span(&self, place: usize, ray: &Ray) -> Option<Interval> {
        let node = self.node(place);
        boxes::BOXES[0].1(ray, ray.range, node.min, node.max)
    }

    fn each(&self, rays: &[Ray], walk: impl Fn(&Ray) -> Option<Trace>) -> Vec<Option<Trace>> {
        let nothing = self.nodes.is_empty();
        rays.iter()
            .map(|ray| if nothing { None } else { walk(ray) })
            .collect()
    }
}

/// What one primitive answers.
pub fn ask(ray: &Ray, shape: &Shape) -> Option<Trace> {
    Solver {
        triangle: TRIANGLES[0].1,
        sphere: SPHERES[0].1,
        ..Solver::RIGHT
    }
    .hit(ray, shape)
}

fn closest(ray: &Ray, shapes: &[Shape]) -> Option<Trace> {
    shapes
        .iter()
        .map(|shape| ask(ray, shape))
        .fold(None, Trace::nearer)
}

/// What makes a walk: each part can be right or wrong by itself.
#[derive(Clone, Copy)]
struct Parts {
    root: fn(&Scene) -> usize,
    culls: Culling,
    order: Order,
    prunes: Pruning,
    leaf: fn(&Ray, &[Shape]) -> Option<Trace>,
    /// The closest hit before anything was hit.
    start: f32,
    first_found: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum Culling {
    Each,
    BothIfEither,
    Never,
    /// The box test shrinks the ray for all that follows.
    Shrinks,
}

/// Which child goes first.
#[derive(Clone, Copy)]
enum Order {
    Nearer,
    Farther,
    L,
    R,
}

#[derive(Clone, Copy, PartialEq)]
enum Pruning {
    ByEntry,
    /// Compares where the ray leaves the box.
    ByExit,
    Never,
}

const RIGHT: Parts = Parts {
    root: |scene| scene.root,
    culls: Culling::Each,
    order: Order::Nearer,
    prunes: Pruning::ByEntry,
    leaf: closest,
    start: f32::INFINITY,
    first_found: false,
};

fn walk(parts: Parts, scene: &Scene, rays: &[Ray]) -> Vec<Option<Trace>> {
    scene.each(rays, |ray| {
        let mut best = None;
        let root = (parts.root)(scene);
        scene.span(root, ray)?;
        visit(parts, scene, root, &mut ray.clone(), &mut best);
        best
    })
}

fn visit(parts: Parts, scene: &Scene, place: usize, ray: &mut Ray, best: &mut Option<Trace>) {
    if parts.first_found && best.is_some() {
        return;
    }
    if scene.node(place).is_leaf() {
        *best = Trace::nearer(*best, (parts.leaf)(ray, scene.in_leaf(place)));
        return;
    }
    let children = scene.children(place);
    let spans = children.map(|child| scene.span(child, ray));
    let enters = match parts.culls {
        Culling::Each | Culling::Shrinks => spans.map(|span| span.is_some()),
        Culling::BothIfEither => [spans[0].is_some() || spans[1].is_some(); 2],
        Culling::Never => [true; 2],
    };
    let entry = spans.map(|span| span.map_or(f32::INFINITY, |span| span.min));
    let l_first = match parts.order {
        Order::Nearer => entry[0] <= entry[1],
        Order::Farther => entry[0] > entry[1],
        Order::L => true,
        Order::R => false,
    };
    for i in if l_first { [0, 1] } else { [1, 0] } {
        let so_far = best.map_or(parts.start, |best| best.distance);
        let beyond = match parts.prunes {
            Pruning::ByEntry => spans[i].is_some_and(|span| span.min > so_far),
            Pruning::ByExit => spans[i].is_some_and(|span| span.max > so_far),
            Pruning::Never => false,
        };
        if !enters[i] || beyond {
            continue;
        }
        if let (Culling::Shrinks, Some(span)) = (parts.culls, spans[i]) {
            ray.range.min = ray.range.min.max(span.min);
            ray.range.max = ray.range.max.min(span.max);
        }
        visit(parts, scene, children[i], ray, best);
    }
}

/// With a stack; boxes are tested when they are taken off it.
fn stack(scene: &Scene, rays: &[Ray]) -> Vec<Option<Trace>> {
    scene.each(rays, |ray| {
        let mut ray = *ray;
        let mut best = None;
        let mut open = vec![scene.root];
        while let Some(place) = open.pop() {
            if scene.span(place, &ray).is_none() {
                continue;
            }
            if scene.node(place).is_leaf() {
                if let Some(trace) = closest(&ray, scene.in_leaf(place)) {
                    ray.range.max = trace.distance;
                    best = Some(trace);
                }
                continue;
            }
            let [l, r] = scene.children(place);
            let entry = |child| {
                scene
                    .span(child, &ray)
                    .map_or(f32::INFINITY, |span| span.min)
            };
            open.extend(if entry(l) <= entry(r) { [r, l] } else { [l, r] });
        }
        best
    })
}

/// Two levels at once: up to four children, the nearest first.
fn wide(scene: &Scene, rays: &[Ray]) -> Vec<Option<Trace>> {
    fn below(scene: &Scene, place: usize) -> Vec<usize> {
        let node = scene.node(place);
        if node.is_leaf() {
            vec![place]
        } else {
            scene.children(place).to_vec()
        }
    }
    fn visit(scene: &Scene, place: usize, ray: &mut Ray, best: &mut Option<Trace>) {
        if scene.node(place).is_leaf() {
            if let Some(trace) = closest(ray, scene.in_leaf(place)) {
                ray.range.max = trace.distance;
                *best = Some(trace);
            }
            return;
        }
        let [l, r] = scene.children(place);
        let children = below(scene, l).into_iter().chain(below(scene, r));
        let mut ahead: Vec<(f32, usize)> = children
            .filter_map(|child| Some((scene.span(child, ray)?.min, child)))
            .collect();
        ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (entry, child) in ahead {
            if entry <= ray.range.max {
                visit(scene, child, ray, best);
            }
        }
    }
    scene.each(rays, |ray| {
        let mut best = None;
        visit(scene, scene.root, &mut ray.clone(), &mut best);
        best
    })
}

/// The slides' pseudo-code to the letter.
fn slides(scene: &Scene, rays: &[Ray]) -> Vec<Option<Trace>> {
    fn hit(scene: &Scene, place: usize, ray: &Ray, best: &mut Option<Trace>) {
        if scene.node(place).is_leaf() {
            *best = Trace::nearer(*best, closest(ray, scene.in_leaf(place)));
            return;
        }
        let [child1, child2] = scene.children(place);
        let time = |child| {
            scene
                .span(child, ray)
                .map_or(f32::INFINITY, |span| span.min)
        };
        let (hit1, hit2) = (time(child1), time(child2));
        let (first, second) = if hit1 <= hit2 {
            (child1, child2)
        } else {
            (child2, child1)
        };
        hit(scene, first, ray, best);
        if hit2 < best.map_or(f32::INFINITY, |best| best.distance) {
            hit(scene, second, ray, best);
        }
    }
    scene.each(rays, |ray| {
        let mut best = None;
        hit(scene, scene.root, ray, &mut best);
        best
    })
}

pub const WALKS: [(&str, Walk); 3] = [
    ("recursive", |scene, rays| walk(RIGHT, scene, rays)),
    ("with a stack", stack),
    ("four at once", wide),
];

pub const SLIDES: (&str, Walk) = ("the slides, literally", slides);

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
