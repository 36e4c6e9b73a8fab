//! Items whose trees contain no decoys: every primitive in a leaf is inside the leaf's box.

use glam::DVec3;
use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::{Ray, Shape};

use super::placed::is_clear_of_faces;
use super::trace;
use super::{
    TRAVERSAL, add_unreferenced, layers, placed, question_without_decoys, ray_from_around,
    soup_tree, traversal_question, unambiguous_rays, with_related_rays, with_unreferenced,
};
use crate::domains::fields::FURTHEST;
use crate::domains::traverse;
use crate::items::transform::Transform;
use crate::items::{Declaration, groups, meshes, ray};
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;
use crate::tree::traversal::{Traversal, TraversalRule};
use crate::tree::{Tree, construction, decoy};

pub(super) const CLOSEST_HIT: Declaration = Declaration {
    id: "traverse.closest_hit",
    title: "the closest hit in all leaves that the ray reaches is returned",
    look: "Follow the ray shown through the tree, box by box, starting at the root: which \
           primitives need to be tested, and which of their hits is the closest? Then see which \
           primitives your code tests, and which hit it keeps after each.",
    look_fits: &[Symptom::more("distance")],
    section: "traversal.md#the-algorithm",
    tests: &["Returns the ray's…", "Boxes overlap, so…"],
    questions: |rng| {
        // At least half of the closest hits are found after a farther hit.
        let kind = |rng: &mut Rng, tree: &Tree| {
            let any = rng.coin();
            rng.retry(|rng| {
                let ray = ray_from_around(rng, tree);
                (any || replaces_a_hit(tree, &Ray64::from(&ray))).then_some(ray)
            })
        };
        // With large triangles, the boxes of siblings overlap considerably.
        let tree = soup_tree(rng, 40, 1.6, 1);
        let mut questions = vec![question_without_decoys(rng, tree, [24, 10], kind)];
        for count in [2, 100] {
            let mut tree = soup_tree(rng, count, 1.6, 1);
            let rays = unambiguous_rays(rng, &tree, [22, 12], ray_from_around);
            let rays = with_related_rays(rng, &tree, rays);
            questions.push(with_unreferenced(rng, &mut tree, rays));
        }
        questions.extend(same_rays_in_three_trees(rng));
        questions.push(across_the_scene(rng));
        questions.push(next_to_the_start(rng));
        questions.push(layers::question(rng));
        questions
    },
    ..TRAVERSAL
};

/// Creates questions about three trees with the same rays. The last ray in each question is also
/// the first ray in the next question, but its answer is different there. The boxes down to the
/// third level are the same in all trees, and all nodes are the same in the last two.
fn same_rays_in_three_trees(rng: &mut Rng) -> [ExamQuestion; 3] {
    let first = soup_tree(rng, 48, 1.2, 1);
    let second = with_other_contents(rng, &first);
    let third = mirrored_in_their_boxes(rng, &second);
    let others = [second.clone(), third.clone()];
    let kind = |rng: &mut Rng, tree: &Tree| {
        rng.retry(|rng| {
            let ray = ray_from_around(rng, tree);
            let ray64 = Ray64::from(&ray);
            let distance = |tree: &Tree| tree.expected_hit(&ray64).map(|hit| hit.distance);
            let is_fair =
                |other: &Tree| decoy::is_fair(other, &[ray]) && is_clear_of_faces(other, &ray);
            let distances = [tree, &others[0], &others[1]].map(distance);
            let differ = distances[0] != distances[1] && distances[1] != distances[2];
            (differ && others.iter().all(is_fair)).then_some(ray)
        })
    };
    let mut rays = unambiguous_rays(rng, &first, [20, 8], kind);
    [first, second, third].map(|mut tree| {
        add_unreferenced(rng, &mut tree, &rays);
        // The nodes of all three trees are in the same order.
        let order = &mut rng.sequence("traverse.closest_hit.order");
        let asked = traversal_question(&tree.with_roots_at_both_ends(order), rays.clone());
        rays.reverse();
        asked
    })
}

/// Returns the tree with each primitive mirrored along an axis, within its box.
fn mirrored_in_their_boxes(rng: &mut Rng, tree: &Tree) -> Tree {
    let mut other = tree.clone();
    for shape in &mut other.shapes {
        let axis = rng.index(3);
        if let Shape::FlatTriangle { corners, .. } = shape {
            let along = corners.map(|corner| corner[axis]);
            let min = along.into_iter().fold(f32::INFINITY, f32::min);
            let max = along.into_iter().fold(f32::NEG_INFINITY, f32::max);
            for corner in corners {
                // Rounding must not change the box.
                corner[axis] = match corner[axis] {
                    at if at == min => max,
                    at if at == max => min,
                    at => min + (max - at),
                };
            }
        }
    }
    other
}

/// Returns a tree with the same nodes but with primitives in different positions. Primitives that
/// touch the faces of the third level's boxes stay in place, so that the boxes of the first three
/// levels are the same.
fn with_other_contents(rng: &mut Rng, tree: &Tree) -> Tree {
    const LEVELS: usize = 3;
    let mut other = tree.clone();
    let mut tops = tree.subtree(tree.root);
    tops.retain(|&node| tree.path(node).len() == LEVELS);
    for &top in &tops {
        let whole = tree.bounds(top);
        let mut below = tree.subtree(top);
        below.retain(|&node| tree.nodes[node].is_leaf());
        for index in below.into_iter().flat_map(|leaf| tree.primitives(leaf)) {
            let shape = &tree.shapes[index];
            let bounds = scan::bounds(shape);
            if bounds.min.cmpeq(whole.min).any() || bounds.max.cmpeq(whole.max).any() {
                continue;
            }
            let half = 0.5 * (bounds.max - bounds.min);
            let room = 0.5 * (whole.max - whole.min) - half;
            let center = whole.center() + 0.99 * room * rng.point(1.0);
            other.shapes[index] = Transform::new(1.0, center - bounds.center()).shape(shape);
        }
    }
    other.refit_below(&tops);
    other
}

/// Creates a question about a few triangles far from the origin. Half of the rays start so close to
/// their hits that moving the start forward by a fraction of its coordinates would skip the hits.
fn next_to_the_start(rng: &mut Rng) -> ExamQuestion {
    /// The largest coordinates, as a multiple of the triangles' size.
    const COORDINATES: f64 = 5000.0;
    rng.retry(|rng| {
        let tree = soup_tree(rng, 5, 1.6, 1);
        let sizes = tree.shapes.iter().map(|shape| {
            let bounds = scan::bounds(shape);
            (bounds.max - bounds.min).max_element()
        });
        let sizes: Vec<f64> = sizes.collect();
        let smallest = sizes.iter().copied().fold(f64::INFINITY, f64::min);
        let distance = 0.5 * COORDINATES * smallest;
        let scale = 0.9 * FURTHEST / distance;
        let signs = DVec3::from_array([rng.sign(), rng.sign(), rng.sign()]);
        let mut offset = signs * rng.vector(0.3, 0.9);
        offset[rng.index(3)] = rng.sign();
        let transform = Transform::new(scale, scale * distance * offset);
        let mut count = 0;
        let kind = |rng: &mut Rng, tree: &Tree| {
            rng.retry(|rng| {
                let mut ray = traverse::ray(rng, tree);
                let hit = tree.expected_hit(&Ray64::from(&ray));
                if let Some(hit) = hit.filter(|_| count % 2 == 0) {
                    let side = sizes[hit.shape as usize];
                    let ahead = rng.uniform(0.009, 0.011) * side;
                    let start = hit.position - ahead * ray.dir.as_dvec3();
                    ray.origin = start.as_vec3();
                    ray.range.min = 0.0;
                }
                let asked = traversal_question(tree, vec![ray]);
                placed::transformed(transform, &asked)?;
                count += 1;
                Some(ray)
            })
        };
        let rays = unambiguous_rays(rng, &tree, [24, 10], kind);
        placed::transformed(transform, &traversal_question(&tree, rays))
    })
}

/// Creates a question about a few large triangles in one corner of the scene. The rays start in the
/// opposite corner.
fn across_the_scene(rng: &mut Rng) -> ExamQuestion {
    let corner = DVec3::from_array([rng.sign(), rng.sign(), rng.sign()]);
    let kind = |rng: &mut Rng, tree: &Tree| {
        let target = tree.bounds(tree.root).center() + rng.point(1.5);
        ray(-10.0 * corner + rng.point(1.0), target)
    };
    rng.retry(|rng| {
        let tree = soup_tree(rng, 6, 1.8, 1);
        let rays = unambiguous_rays(rng, &tree, [24, 10], kind);
        placed::across_the_scene(&traversal_question(&tree, rays))
    })
}

/// Returns whether every correct traversal finds a farther hit before the closest one.
fn replaces_a_hit(tree: &Tree, ray64: &Ray64) -> bool {
    let closest = tree.expected_hit(ray64);
    TraversalRule::all().into_iter().all(|rule| {
        let tested = Traversal::correct(tree, ray64, rule).tested_primitives;
        let mut hits = tested
            .into_iter()
            .filter_map(|primitive| scan::intersect(ray64, &tree.shapes[primitive]));
        hits.next().is_some_and(|first| Some(first) != closest)
    })
}

pub(super) const FIRST_BOX_EMPTY: Declaration = Declaration {
    id: "traverse.first_box_empty",
    title: "a ray can hit a box without hitting anything inside it",
    look: "For the ray shown, work out by hand which of the two boxes it hits, and which \
           primitives in them. As long as nothing has been hit, there is no closest hit to compare \
           with: skip a child only if the ray misses its box.",
    look_fits: &[Symptom::MISS, Symptom::more("distance")],
    section: "traversal.md#no-hit-yet-is-not-a-hit-at-distance-zero",
    tests: &["Boxes overlap, so…"],
    questions: |rng| {
        // Small triangles leave most of a node's box empty.
        let tree = soup_tree(rng, 40, 0.5, 1);
        let kind = ray_from_around_or_in_a_corner();
        vec![question_without_decoys(rng, tree, [20, 17], kind)]
    },
    ..TRAVERSAL
};

/// Returns a function that generates random rays. If possible, every third ray hits something in a
/// corner of the boxes around it.
fn ray_from_around_or_in_a_corner() -> impl FnMut(&mut Rng, &Tree) -> Ray {
    let mut count = 0;
    move |rng: &mut Rng, tree: &Tree| {
        count += 1;
        let in_a_corner = |rng: &mut Rng| {
            let ray = traverse::ray_in_a_corner(rng, tree)?;
            is_clear_of_faces(tree, &ray).then_some(ray)
        };
        let in_a_corner = if count % 3 == 0 {
            rng.attempt(300, in_a_corner)
        } else {
            None
        };
        in_a_corner.unwrap_or_else(|| ray_from_around(rng, tree))
    }
}

pub(super) const RANGE: Declaration = Declaration {
    id: "traverse.range",
    title: "hits outside the ray's range are ignored",
    look: "The answer is the closest hit within ray.range, which need not start at 0 or end at ∞. \
           Find all hits of the ray shown, and see where your code picks a different one, or none.",
    section: "traversal.md#only-a-hit-shortens-the-ray",
    tests: &["Returns the ray's…"],
    questions: range,
    ..TRAVERSAL
};

fn range(rng: &mut Rng) -> Vec<ExamQuestion> {
    let mut tree = soup_tree(rng, 40, 1.4, 1);
    // The range starts before the first hit or between the first two. It ends before, between or
    // after these two hits, or never.
    let kind = |rng: &mut Rng, tree: &Tree| {
        rng.retry(|rng| {
            let ray = ray_from_around(rng, tree).within(0.0, f32::INFINITY);
            let ray64 = Ray64::from(&ray);
            let first = tree.expected_hit(&ray64)?.distance;
            let rest = Ray64 {
                min: first + 0.05,
                ..ray64
            };
            let second = tree.expected_hit(&rest)?.distance;
            let (before, between) = (rng.uniform(0.5, 1.0) * first, rng.uniform(first, second));
            let (min, max) = match rng.index(6) {
                0 => (between, second + 9.0),
                1 => (between, f64::INFINITY),
                2 => (0.0, before),
                3 => (0.0, between),
                4 => (before, between),
                _ => (before, f64::INFINITY),
            };
            Some(ray.within(min as f32, max as f32))
        })
    };
    let rays = unambiguous_rays(rng, &tree, [18, 8], kind);
    // Every second ray is repeated with an unlimited range, either just before or just after the
    // original.
    let again = |(index, ray): (usize, &Ray)| {
        let whole = ray.within(0.0, f32::INFINITY);
        let is_clear = is_clear_of_faces(&tree, &whole) && decoy::is_fair(&tree, &[whole]);
        match index % 4 {
            1 if is_clear => vec![*ray, whole],
            3 if is_clear => vec![whole, *ray],
            _ => vec![*ray],
        }
    };
    let rays: Vec<Ray> = rays.iter().enumerate().flat_map(again).collect();
    vec![with_unreferenced(rng, &mut tree, rays)]
}

pub(super) const LEAF_OF_SEVERAL: Declaration = Declaration {
    id: "traverse.leaf_of_several",
    title: "every primitive in a leaf is tested",
    look: "A leaf holds primitives[start..start + size]. Return the closest hit among all of them, \
        whichever primitive it is on.",
    section: "traversal.md#test-exactly-the-primitives-of-the-leaf",
    tests: &["Returns the ray's…"],
    questions: leaf_of_several,
    ..TRAVERSAL
};

fn leaf_of_several(rng: &mut Rng) -> Vec<ExamQuestion> {
    let trees = [
        soup_tree(rng, 48, 1.0, 12),
        soup_tree(rng, 6, 1.0, 6),
        soup_tree(rng, 100, 0.4, 50),
        tree_with_a_large_leaf(rng),
    ];
    let question = |tree| question_without_decoys(rng, tree, [24, 10], ray_to_a_place_in_a_leaf());
    trees.map(question).to_vec()
}

/// Returns a tree of two leaves. One of them has as many primitives as a leaf may contain.
fn tree_with_a_large_leaf(rng: &mut Rng) -> Tree {
    let mut shapes = meshes::soup(rng, 1000 + 20, 2.0, 0.3);
    let few = shapes.split_off(1000);
    let mut tree = Tree::default();
    let l = tree.add_leaf(shapes);
    let r = tree.add_leaf(few);
    tree.root = tree.add_interior(l, r);
    tree
}

/// Returns a function that generates random rays. The closest of several hits in a leaf is on the
/// leaf's first primitive, its last primitive or any of its primitives, in turn. Some rays hit
/// nothing.
fn ray_to_a_place_in_a_leaf() -> impl FnMut(&mut Rng, &Tree) -> Ray {
    let mut count = 0;
    move |rng: &mut Rng, tree: &Tree| {
        rng.retry(|rng| {
            let any = traverse::ray(rng, tree);
            let leaves = tree.leaves();
            let indices = tree.primitives(leaves[rng.index(leaves.len())]);
            let index = match count % 3 {
                0 => indices.start,
                1 => indices.end - 1,
                _ => indices.start + rng.index(indices.len()),
            };
            let middle = scan::bounds(&tree.shapes[index]).center();
            let target = middle + rng.point(0.1);
            let distance = target.distance(any.origin.as_dvec3());
            let start = target - distance * any.dir.as_dvec3();
            let aimed = Ray::new(start.as_vec3(), any.dir);
            let ray = if rng.index(3) > 0 { aimed } else { any };
            let ray64 = Ray64::from(&ray);
            if tree.expected_hit(&ray64).is_none() {
                return is_clear_of_faces(tree, &ray).then_some(ray);
            }
            let indices = indices.filter_map(|index| {
                let hit = scan::intersect(&ray64, &tree.shapes[index])?;
                Some((hit.distance, index))
            });
            let hits: Vec<(f64, usize)> = indices.collect();
            let &(_, closest) = hits.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
            if hits.len() < 2 || closest != index || !is_clear_of_faces(tree, &ray) {
                return None;
            }
            count += 1;
            Some(ray)
        })
    }
}

pub(super) const DEEP: Declaration = Declaration {
    id: "traverse.deep",
    title: "a tree of 60 levels is traversed to the end",
    look: "Does your traversal reach the deepest level, or does a depth limit or a small fixed-size \
        stack cut it short? If you push nodes, pop all of them.",
    look_fits: &[Symptom::MISS, Symptom::more("distance")],
    section: "traversal.md#deep-trees",
    tests: &["The tree can be 60…"],
    questions: deep,
    ..TRAVERSAL
};

fn deep(rng: &mut Rng) -> Vec<ExamQuestion> {
    const LEVELS: usize = 60;
    let triangles = (0..LEVELS).map(|i| {
        let center = DVec3::X * (0.5 * i as f64) + rng.point(0.3);
        meshes::random_flat_triangle(rng, center, 0.5)
    });
    let triangles = meshes::number_shapes(triangles);
    let fewer = rng.integer(20, 59) as usize;
    let less_deep = construction::chain(triangles[LEVELS - fewer..].to_vec());
    let tree = construction::chain(triangles);
    let mut mirrored = tree.clone();
    for node in &mut mirrored.nodes {
        std::mem::swap(&mut node.l, &mut node.r);
    }
    // Some rays go along the chain from either end, and others go across it.
    let kind = |rng: &mut Rng, _: &Tree| {
        let target = DVec3::X * rng.uniform(0.0, 30.0) + rng.point(0.4);
        let away = match rng.index(3) {
            0 => DVec3::X + rng.point(0.2),
            1 => DVec3::NEG_X + rng.point(0.2),
            _ => rng.direction(),
        };
        ray(target + 6.0 * away, target)
    };
    let mut question = |tree| question_without_decoys(rng, tree, [24, 10], kind);
    let questions = [tree, mirrored, less_deep].map(&mut question);
    let along = along_the_chain(rng);
    questions.into_iter().chain([along]).collect()
}

/// Creates a question about a chain whose first leaves are farthest from the start of the rays.
/// Most rays enter almost all boxes, so almost all leaves have to wait until the end of the chain
/// has been traversed.
fn along_the_chain(rng: &mut Rng) -> ExamQuestion {
    const LEVELS: usize = 60;
    /// The minimum number of boxes that a ray enters.
    const LEAST: usize = 56;
    let triangles = (0..LEVELS).map(|i| {
        let center = DVec3::X * (0.5 * i as f64) + rng.point(0.1);
        meshes::random_flat_triangle(rng, center, 0.9)
    });
    let tree = construction::chain(meshes::number_shapes(triangles));
    let boxes: Vec<_> = tree.shapes.iter().map(scan::bounds).collect();
    let kind = |rng: &mut Rng, tree: &Tree| {
        let end = DVec3::X * (0.5 * LEVELS as f64 + rng.uniform(1.0, 3.0));
        let is_along = rng.index(4) > 0;
        rng.retry(|rng| {
            let start = end + rng.vector(-0.4, 0.4);
            let target = if is_along {
                start * (DVec3::ONE - DVec3::X) + 0.05 * rng.point(1.0)
            } else {
                3.0 * rng.point(1.0)
            };
            let ray = ray(start, target);
            let ray64 = Ray64::from(&ray);
            let entered = boxes.iter().filter(|it| it.span(&ray64).is_some());
            let is_as_planned = !is_along || entered.count() >= LEAST;
            (is_as_planned && is_clear_of_faces(tree, &ray)).then_some(ray)
        })
    };
    question_without_decoys(rng, tree.clone(), [18, 4], kind)
}

pub(super) const FLAT: Declaration = Declaration {
    id: "traverse.flat",
    title: "leaves with flat boxes are entered",
    look: "A ray enters and leaves a flat box at the same time. If your box test is correct, check \
           how you use its result: an interval of one point is not empty.",
    look_fits: &[Symptom::MISS, Symptom::more("distance")],
    section: "traversal.md#a-flat-box-has-equal-entry-and-exit",
    tests: &["Returns the ray's…"],
    questions: |rng| {
        // Axis-parallel triangles, one per leaf.
        let triangles = (0..36).map(|i| {
            let axis = i % 3;
            let (x, y) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
            let corner = rng.point(2.0);
            let size = rng.uniform(0.6, 1.4) * rng.sign();
            meshes::flat_triangle([corner, corner + size * x, corner + size * y], 0)
        });
        let tree = construction::median_split(meshes::number_shapes(triangles), 1);
        let counts = [24, 10];
        vec![question_without_decoys(rng, tree, counts, ray_from_around)]
    },
    ..TRAVERSAL
};

pub(super) const MIXED: Declaration = Declaration {
    id: "traverse.mixed",
    title: "a tree can hold spheres and triangles",
    look: "Primitive::hit tests both kinds, and their distances are compared in the same way.",
    look_fits: &[Symptom::more("distance")],
    section: "traversal.md#the-algorithm",
    tests: &["Returns the ray's…"],
    questions: |rng| {
        let shapes = (0..36).map(|i| {
            let center = rng.point(2.0);
            match i % 4 {
                0 => meshes::random_triangle(rng, center, 0.9),
                2 => meshes::random_flat_triangle(rng, center, 0.9),
                _ => meshes::sphere(center, rng.uniform(0.2, 0.5)),
            }
        });
        let tree = construction::median_split(meshes::number_shapes(shapes), 1);
        let mut count = 0;
        let kind = |rng: &mut Rng, tree: &Tree| {
            count += 1;
            rng.retry(|rng| match count % 4 {
                0 => traverse::ray_through_the_sphere_that_it_starts_on(rng, tree)
                    .filter(|ray| is_clear_of_faces(tree, ray)),
                _ => Some(ray_from_around(rng, tree)),
            })
        };
        let distances = question_without_decoys(rng, tree, [28, 10], kind);
        // The first of these questions is about spheres only, the second about all kinds of
        // primitives.
        let traces = [(2, 5, 1), (3, 24, 2)]
            .map(|(kind, count, max_leaf_size)| trace::question(rng, kind, count, max_leaf_size));
        [vec![distances], traces.to_vec()].concat()
    },
    needs: &[
        groups::TRIANGLE_HITS,
        groups::BOXES,
        groups::SPHERE_HITS,
        groups::TRIANGLE_SURFACE,
        groups::SPHERE_SURFACE,
    ],
    ..TRAVERSAL
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn a_tree_with_other_contents_looks_the_same_from_outside() {
        let mut rng = Seed(1).rng("items.traverse.same_rays");
        let tree = soup_tree(&mut rng, 24, 1.2, 1);
        let other = with_other_contents(&mut rng, &tree);
        for node in tree.subtree(tree.root) {
            if tree.path(node).len() <= 3 {
                assert_eq!(tree.bounds(node), other.bounds(node));
            }
        }
        assert_eq!(tree.nodes.len(), other.nodes.len());
        assert_ne!(tree.shapes, other.shapes);
    }
}
