//! A recursive walk of parts that can each be wrong.

use protocol::{Ray, Shape, Trace};

use super::{Scene, closest};

/// What makes a walk: each part can be right or wrong by itself.
#[derive(Clone, Copy)]
pub struct Parts {
    pub root: fn(&Scene) -> usize,
    pub culls: Culling,
    pub order: Order,
    pub prunes: Pruning,
    pub leaf: fn(&Ray, &[Shape]) -> Option<Trace>,
    /// The closest hit before anything was hit.
    pub start: f32,
    pub first_found: bool,
}

#[derive(Clone, Copy, PartialEq)]
pub enum Culling {
    Each,
    BothIfEither,
    Never,
    /// The box test shrinks the ray for all that follows.
    Shrinks,
}

/// Which child goes first.
#[derive(Clone, Copy)]
pub enum Order {
    Nearer,
    Farther,
    L,
    R,
}

#[derive(Clone, Copy, PartialEq)]
pub enum Pruning {
    ByEntry,
    /// Compares where the ray leaves the box.
    ByExit,
    Never,
}

pub const RIGHT: Parts = Parts {
    root: |scene| scene.root,
    culls: Culling::Each,
    order: Order::Nearer,
    prunes: Pruning::ByEntry,
    leaf: closest,
    start: f32::INFINITY,
    first_found: false,
};

pub fn walk(parts: Parts, scene: &Scene, rays: &[Ray]) -> Vec<Option<Trace>> {
    scene.each(rays, |ray| {
        let mut best = None;
        let root = (parts.root)(scene);
        scene.span(root, ray)?;
        visit(parts, scene, root, &mut ray.clone(), &mut best);
        best
    })
}

pub fn visit(parts: Parts, scene: &Scene, place: usize, ray: &mut Ray, best: &mut Option<Trace>) {
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
