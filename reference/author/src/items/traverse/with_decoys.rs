//! Items whose trees contain decoys.

use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::Ray;

use super::cells::{self, CellSkipReason, Decoys};
use super::placed::as_dust;
use super::{
    TRAVERSAL, add_unreferenced, ray_from_around, soup_tree, traversal_question, unambiguous_rays,
};
use crate::items::Declaration;
use crate::oracle::Ray64;
use crate::seed::Rng;
use crate::tree::Tree;
use crate::tree::decoy::{self, Child, SkipReason};
use crate::tree::traversal::Traversal;

/// Returns whether the slides' pseudocode, taken literally, gives the correct answer for this ray.
pub(super) fn slides_are_correct(tree: &Tree, ray: &Ray) -> bool {
    let ray64 = Ray64::from(ray);
    Traversal::by_the_slides(tree, &ray64).closest == tree.expected_hit(&ray64)
}

/// The number of the first decoy. The numbers of unreferenced primitives are smaller.
pub(super) const FIRST_DECOY: u32 = 20_000;

/// A filter for the leaves that may contain a decoy for a ray.
type LeafFilter<'a> = &'a dyn Fn(&Tree, usize, &Ray64) -> bool;

/// The number of rays in a question that may get a decoy. They come before all other rays.
const RAYS_WITH_DECOYS: usize = 10;
const OTHER_RAYS: [usize; 2] = [4, 4];
/// The minimum number of decoys in a question. A question with fewer decoys is rejected.
const MIN_DECOYS: usize = 4;

/// Creates a question in which at least `MIN_DECOYS` rays have a decoy, each in a leaf that `fits`
/// accepts. Taken literally, the slides' pseudocode gives the answer `slides` for rays with a
/// decoy and the correct answer for all others.
fn question_with_decoys(rng: &mut Rng, fits: LeafFilter, slides: SlidesAnswer) -> ExamQuestion {
    rng.retry(|rng| {
        let tree = soup_tree(rng, 48, 0.7, 1);
        let rays = rays_with_candidate_leaves(rng, &tree, fits);
        let (mut tree, count) = add_decoys(rng, tree, &rays, fits, slides);
        if count < MIN_DECOYS {
            return None;
        }
        add_unreferenced(rng, &mut tree, &rays);
        Some(traversal_question(&tree.with_roots_at_both_ends(rng), rays))
    })
}

/// Returns rays for which `fits` accepts some leaf, followed by some other rays.
fn rays_with_candidate_leaves(rng: &mut Rng, tree: &Tree, fits: LeafFilter) -> Vec<Ray> {
    let mut chosen = unambiguous_rays(rng, tree, [RAYS_WITH_DECOYS, 0], |rng, tree| {
        rng.retry(|rng| {
            let ray = ray_from_around(rng, tree);
            let ray64 = Ray64::from(&ray);
            let mut leaves = tree.leaves().into_iter();
            leaves.any(|leaf| fits(tree, leaf, &ray64)).then_some(ray)
        })
    });
    chosen.extend(unambiguous_rays(rng, tree, OTHER_RAYS, ray_from_around));
    chosen
}

/// Adds a decoy for each of the first `RAYS_WITH_DECOYS` rays, where this is possible. Returns the
/// tree and the number of decoys.
fn add_decoys(
    rng: &mut Rng,
    mut tree: Tree,
    rays: &[Ray],
    fits: LeafFilter,
    slides: SlidesAnswer,
) -> (Tree, usize) {
    const ATTEMPTS: usize = 30;
    let mut done = Vec::new();
    for index in 0..RAYS_WITH_DECOYS {
        let shape = FIRST_DECOY + index as u32;
        let added = (0..ATTEMPTS).find_map(|_| {
            let with_decoy = decoy::add_decoy(rng, &tree, rays, index, shape, fits)?;
            let is_as_required = (0..).zip(rays).all(|(other, ray)| {
                let has_decoy = other == index || done.contains(&other);
                let is_wrong = has_decoy && slides == SlidesAnswer::Wrong;
                slides_are_correct(&with_decoy, ray) != is_wrong
            });
            is_as_required.then_some(with_decoy)
        });
        // Some rays don't get a decoy, because no decoy in the leaves that `fits` accepts gives the
        // answer that `slides` requires.
        if let Some(with_decoy) = added {
            tree = with_decoy;
            done.push(index);
        }
    }
    (tree, done.len())
}

/// The result of following the slides' pseudocode literally for a ray with a decoy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SlidesAnswer {
    /// The correct answer: the decoy is not tested.
    Correct,
    /// A wrong answer: the decoy is tested and hit.
    Wrong,
}

/// Returns a filter for the leaves that every correct traversal skips for this reason.
fn skipped_for(reason: SkipReason) -> impl Fn(&Tree, usize, &Ray64) -> bool {
    move |tree, leaf, ray64| decoy::skip_reason(tree, leaf, ray64) == Some(reason)
}

/// Returns a filter for the leaves that are the given child of their parent and whose boxes the ray
/// misses, although it hits the sibling's box.
fn missed_alone(child: Child) -> impl Fn(&Tree, usize, &Ray64) -> bool {
    move |tree, leaf, ray64| {
        decoy::is_missed_child(tree, leaf, ray64, child)
            && !decoy::misses_sibling(tree, leaf, ray64)
    }
}

/// Returns a filter for the leaves that are the given child of their parent, where the ray misses
/// both the leaf's box and its sibling's.
fn missed_with_sibling(child: Child) -> impl Fn(&Tree, usize, &Ray64) -> bool {
    move |tree, leaf, ray64| {
        decoy::is_missed_child(tree, leaf, ray64, child) && decoy::misses_sibling(tree, leaf, ray64)
    }
}

pub(super) const SKIPS_MISSED: Declaration = Declaration {
    id: "traverse.skips_missed",
    points: 2,
    title: "a node whose box the ray misses is not entered",
    look: "This is what the tree is for. In this exam, some leaves hold primitives outside their \
           boxes: a traversal that enters a missed box finds them.",
    look_fits: &[Symptom::HIT, Symptom::less("distance")],
    section: "traversal.md#do-not-enter-a-box-that-is-missed",
    tests: &["Do not enter a node whose box the…"],
    questions: |rng| {
        let fits = skipped_for(SkipReason::Missed);
        // The slides' pseudocode enters the left child if both children are missed, and may enter
        // it if only the right child is hit: see `both_sides`.
        let after_nothing = |tree: &Tree, leaf: usize, ray64: &Ray64| {
            missed_alone(|node| node.r)(tree, leaf, ray64)
                && !decoy::hits_below_sibling(tree, leaf, ray64)
        };
        let mut questions = vec![
            question_with_decoys(rng, &fits, SlidesAnswer::Correct),
            question_with_decoys(rng, &after_nothing, SlidesAnswer::Correct),
        ];
        let decoys = Decoys {
            reasons: &[CellSkipReason::Missed, CellSkipReason::MissedWithSibling],
            is_left: false,
            slides: SlidesAnswer::Correct,
            fill: 50,
        };
        questions.push(cells::question(rng, decoys));
        questions.extend(cells::small_questions(rng, decoys));
        questions
    },
    ..TRAVERSAL
};

pub(super) const PRUNES: Declaration = Declaration {
    id: "traverse.prunes",
    points: 2,
    title: "a node that begins beyond the closest hit is not entered",
    look: "First visit the child whose box the ray enters first. After that, if the ray enters the \
           other box beyond the closest hit so far, nothing in it can be nearer: skip it.",
    look_fits: &[Symptom::less("distance")],
    section: "traversal.md#order-the-children-and-prune",
    tests: &["Do not enter a node whose box begins…"],
    questions: |rng| {
        let fits = skipped_for(SkipReason::SubtreePruned);
        let decoys = Decoys {
            reasons: &[
                CellSkipReason::Beyond,
                CellSkipReason::FartherOfTwoBeyond,
                CellSkipReason::BeyondAfterFarther,
            ],
            is_left: false,
            slides: SlidesAnswer::Correct,
            fill: 50,
        };
        let mut questions = vec![
            question_with_decoys(rng, &fits, SlidesAnswer::Correct),
            cells::question(rng, decoys),
            as_dust(&question_with_decoys(rng, &fits, SlidesAnswer::Correct)),
        ];
        questions.extend(cells::small_questions(rng, decoys));
        questions
    },
    ..TRAVERSAL
};

pub(super) const NEARER_FIRST: Declaration = Declaration {
    id: "traverse.nearer_first",
    title: "if the ray enters r first, r is visited first, and l is pruned by its own entry",
    look: "First visit the child whose box the ray enters first, whether that is l or r. Then \
        compare the entry of the other child with the closest hit: the slides' hit2.t is the entry \
        of r, even if l comes second.",
    look_fits: &[Symptom::less("distance")],
    section: "traversal.md#order-the-children-and-prune",
    tests: &[
        "If the ray hits the…",
        "Do not take the slides'…",
        "It compares `hit2.t`,…",
    ],
    questions: nearer_first,
    ..TRAVERSAL
};

fn nearer_first(rng: &mut Rng) -> Vec<ExamQuestion> {
    let fits = skipped_for(SkipReason::SubtreePruned);
    let left_last = |tree: &Tree, leaf: usize, ray64: &Ray64| {
        let fork = decoy::find_fork(tree, leaf, ray64);
        fork.is_some_and(|fork| fork.toward_leaf == leaf && fork.exits_hit_side_last(tree, ray64))
            && fits(tree, leaf, ray64)
    };
    // The box that the ray enters second has the nearer centre.
    let nearer_center = |tree: &Tree, leaf: usize, ray64: &Ray64| {
        let fork = decoy::find_fork(tree, leaf, ray64);
        let distance = |index: usize| tree.bounds(index).center().distance(ray64.origin);
        fork.is_some_and(|fork| distance(fork.toward_leaf) < distance(fork.toward_hit))
            && fits(tree, leaf, ray64)
    };
    let decoys = Decoys {
        reasons: &[CellSkipReason::Beyond, CellSkipReason::BeyondAfterParallel],
        is_left: true,
        slides: SlidesAnswer::Wrong,
        fill: 1,
    };
    let mut questions = vec![
        question_with_decoys(rng, &left_last, SlidesAnswer::Wrong),
        question_with_decoys(rng, &nearer_center, SlidesAnswer::Wrong),
        cells::question(rng, decoys),
        as_dust(&question_with_decoys(rng, &fits, SlidesAnswer::Wrong)),
    ];
    questions.extend(cells::small_questions(rng, decoys));
    questions
}

pub(super) const BOTH_SIDES: Declaration = Declaration {
    id: "traverse.both_sides",
    title: "a child is entered only if the ray hits its own box before the closest hit",
    look: "Look at each child's own box: enter the child only if the ray hits that box and doesn't \
        enter it beyond the closest hit so far. If both boxes are missed, enter neither, even \
        though the slides always enter `first`.",
    look_fits: &[Symptom::HIT, Symptom::less("distance")],
    section: "traversal.md#do-not-enter-a-box-that-is-missed",
    tests: &[
        "Do not enter a node whose box the…",
        "Do not enter a node whose box begins…",
        "Do not take the slides'…",
        "It also enters `first`…",
    ],
    questions: |rng| {
        let missed_alone = missed_alone(|node| node.l);
        let with_sibling = missed_with_sibling(|node| node.l);
        let pruned_alone = |tree: &Tree, leaf: usize, ray64: &Ray64| {
            skipped_for(SkipReason::LeafPruned)(tree, leaf, ray64)
                && decoy::siblings_beyond_are_missed(tree, leaf, ray64)
        };
        let decoys = Decoys {
            reasons: &[
                CellSkipReason::Missed,
                CellSkipReason::MissedWithSibling,
                CellSkipReason::NearerOfTwoBeyond,
            ],
            is_left: true,
            slides: SlidesAnswer::Wrong,
            fill: 1,
        };
        let mut questions = vec![
            question_with_decoys(rng, &missed_alone, SlidesAnswer::Wrong),
            question_with_decoys(rng, &with_sibling, SlidesAnswer::Wrong),
            cells::question(rng, decoys),
            question_with_decoys(rng, &pruned_alone, SlidesAnswer::Wrong),
        ];
        questions.extend(cells::small_questions(rng, decoys));
        questions
    },
    ..TRAVERSAL
};
