//! Right walks of different make, and the slides' own.

use protocol::{Ray, Trace};

use super::parts::{RIGHT, walk};
use super::{Scene, Walk, closest};

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
