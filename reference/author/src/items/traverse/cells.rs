//! Trees of cells. Each cell is a small tree with one decoy. The decoys' properties are distributed
//! so that each reason not to test a decoy occurs with each kind of leaf, each index, each level
//! and each range.
//!
//! ```text
//!   missed            missed with sibling       beyond               both beyond
//!
//!     ┌──┐ decoy's       ┌──┐ decoy's                ┌──┐                  ┌───────┐
//!     └──┘ leaf          └──┘ or                     │  │ decoy's          │       ├──┐
//!  ──────────┌──┐     ────────────┌──┐     ───┌──┐───│──│──       ───┌──┐──└───────┤──│
//!            └──┘ hit    ┌──┐     └──┘        └──┘   └──┘            └──┘          └──┘
//!                        └──┘ here
//! ```
//!
//! The cells are next to each other, so that a ray hits something only in its own cell. In the
//! tree, they form a chain of almost 60 levels.

use glam::{DVec3, dvec3};
use judging::exam::ExamQuestion;
use protocol::{Ray, Shape};

use super::with_decoys::{FIRST_DECOY, SlidesAnswer, slides_are_correct};
use super::{meshes, traversal_question};
use crate::domains::fields::RANGES;
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;
use crate::tree::traversal::{Traversal, TraversalRule};
use crate::tree::{Tree, decoy};

/// Why a cell's decoy must not be tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellSkipReason {
    /// The ray misses the box of the decoy's leaf.
    Missed,
    /// The ray misses the boxes of the decoy's leaf and of the leaf's sibling, but not the parent's
    /// box.
    MissedWithSibling,
    /// The decoy's leaf begins beyond the closest hit.
    Beyond,
    /// The decoy's leaf begins beyond the closest hit. A leaf that the ray enters first has a hit
    /// that is even farther away.
    BeyondAfterFarther,
    /// The decoy's leaf begins beyond the closest hit. The previous ray is parallel, but it enters
    /// this leaf before the leaf's sibling.
    BeyondAfterParallel,
    /// The decoy's leaf and the sibling after it begin beyond the closest hit, but their parent
    /// doesn't.
    NearerOfTwoBeyond,
    /// The decoy's leaf and the sibling before it begin beyond the closest hit, but their parent
    /// doesn't.
    FartherOfTwoBeyond,
}

/// The decoys in a question, with two or three different reasons not to test them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Decoys<'a> {
    pub(super) reasons: &'a [CellSkipReason],
    /// Whether a decoy's leaf is the left child. If both siblings are beyond the hit, the leaf may
    /// be either child.
    pub(super) is_left: bool,
    /// The answer that the slides' pseudocode, taken literally, gives for all rays with a decoy.
    pub(super) slides: SlidesAnswer,
    /// The number of primitives in each leaf that is next to the chain and not part of a cell.
    pub(super) fill: usize,
}

impl Decoys<'_> {
    /// Returns a question about a tree with these decoys, unless it is unfair or the slides'
    /// pseudocode doesn't give the required answers to all rays.
    fn question(
        &self,
        rng: &mut Rng,
        tree: &Tree,
        rays: Vec<Ray>,
        with_decoy: &[Ray],
    ) -> Option<ExamQuestion> {
        let is_as_required = |ray: &Ray| {
            let is_wrong = with_decoy.contains(ray) && self.slides == SlidesAnswer::Wrong;
            slides_are_correct(tree, ray) != is_wrong && tests_no_sphere(tree, ray)
        };
        let is_fair = decoy::is_fair(tree, &rays) && rays.iter().all(is_as_required);
        is_fair.then(|| traversal_question(&tree.with_roots_at_both_ends(rng), rays))
    }
}

/// Creates a question about a single cell for each of the reasons. The decoy's leaf is a child or a
/// grandchild of the root.
pub(super) fn small_questions(rng: &mut Rng, decoys: Decoys) -> Vec<ExamQuestion> {
    let reasons = decoys.reasons.iter();
    let question = |&reason: &CellSkipReason| {
        rng.retry(|rng| {
            let start = rng.index(DECOYS);
            // The last plans aren't about rays that hit nothing.
            let index = rng.integer(4, DECOYS as u32 - 1) as usize;
            let plan = Plan::new(reason, decoys.is_left, index, start);
            let axis = rng.index(3);
            let axes = [0, 1, 2].map(|next| rng.sign() * DVec3::AXES[(axis + next) % 3]);
            let frame = Frame::new(rng, axes, 0);
            let Cell { tree, rays } = rng.attempt(300, |rng| Cell::draw(rng, &plan, &frame, 0))?;
            let with_decoy = rays.last().copied();
            decoys.question(rng, &tree, rays, with_decoy.as_slice())
        })
    };
    reasons.map(question).collect()
}

/// The number of decoys for each reason.
const DECOYS: usize = 12;
/// The number of trees in the chain. The deepest leaf is two levels below the root of the last
/// tree.
const CHAIN: usize = 58;
/// For each class of levels, in order, the links of the chain whose decoys belong to the class.
const LINKS: [std::ops::Range<usize>; 4] = [0..9, 10..21, 22..37, 38..CHAIN];

/// Creates a question about a chain of cells.
pub(super) fn question(rng: &mut Rng, decoys: Decoys) -> ExamQuestion {
    rng.retry(|rng| {
        let mut free_links = LINKS.map(|links| rng.shuffled(links.collect()));
        let mut links: Vec<Option<Cell>> = vec![None; CHAIN];
        let places = rng.shuffled((0..CHAIN).collect::<Vec<usize>>());
        let axis = rng.index(3);
        let axes = [0, 1, 2].map(|next| rng.sign() * DVec3::AXES[(axis + next) % 3]);
        let mut order = Vec::new();
        for &reason in decoys.reasons {
            let start = rng.index(DECOYS);
            for index in 0..DECOYS {
                let plan = Plan::new(reason, decoys.is_left, index, start);
                let link = free_links[plan.level].pop()?;
                let frame = Frame::new(rng, axes, places[link]);
                links[link] = Some(rng.attempt(300, |rng| Cell::draw(rng, &plan, &frame, link))?);
                order.push(link);
            }
        }
        let order = rng.shuffled(order).into_iter();
        let in_order = order.filter_map(|link| links[link].as_ref().map(|cell| cell.rays.clone()));
        let rays: Vec<Ray> = in_order.flatten().collect();
        let with_decoy: Vec<Ray> = links
            .iter()
            .flatten()
            .filter_map(|cell| cell.rays.last().copied())
            .collect();
        let tree = chain(rng, links, axes, (&places, decoys.fill));
        decoys.question(rng, &tree, rays, &with_decoy)
    })
}

/// Returns true if no correct traversal tests a sphere. The spheres are decoys, so these questions
/// depend only on triangles and boxes.
fn tests_no_sphere(tree: &Tree, ray: &Ray) -> bool {
    TraversalRule::all().into_iter().all(|rule| {
        let traversal = Traversal::correct(tree, &Ray64::from(ray), rule);
        let mut tested = traversal.tested_primitives.into_iter();
        !tested.any(|primitive| matches!(tree.shapes[primitive], Shape::Sphere { .. }))
    })
}

/// Returns a chain of cells. Links without a cell have a leaf of `fill` primitives instead. At each
/// node, the rest of the chain can be the left or the right child.
fn chain(
    rng: &mut Rng,
    links: Vec<Option<Cell>>,
    axes: [DVec3; 3],
    (places, fill): (&[usize], usize),
) -> Tree {
    let mut tree = Tree::default();
    let mut below = None;
    for (link, cell) in links.into_iter().enumerate().rev() {
        let root = if let Some(cell) = cell {
            add_tree(&mut tree, &cell.tree)
        } else {
            let frame = Frame::new(rng, axes, places[link]);
            let (min, max) = (dvec3(3.0, 2.0, -0.6), dvec3(5.0, 3.0, 0.6));
            let number = first_number(link);
            let mut shapes = vec![with_number(frame.spanning(min, max), number)];
            // Spheres take up less space in an exam than triangles.
            shapes.extend((1..fill as u32).map(|next| {
                let center = frame.point(0.5 * (min + max) + 0.3 * rng.point(1.0) * (max - min));
                with_number(meshes::sphere(center, 0.15), number + next)
            }));
            tree.add_leaf(shapes)
        };
        below = Some(match below {
            None => root,
            Some(rest) if rng.coin() => tree.add_interior(rest, root),
            Some(rest) => tree.add_interior(root, rest),
        });
    }
    tree.root = below.expect("the chain has links");
    tree
}

/// Adds all nodes and primitives of another tree and returns the index of its root.
fn add_tree(tree: &mut Tree, added: &Tree) -> usize {
    let (nodes, shapes) = (tree.nodes.len() as u32, tree.shapes.len() as u32);
    tree.nodes.extend(added.nodes.iter().map(|node| {
        let mut node = *node;
        if node.is_leaf() {
            node.start += shapes;
        } else {
            node.l += nodes;
            node.r += nodes;
        }
        node
    }));
    tree.shapes.extend(&added.shapes);
    nodes as usize + added.root
}

/// Returns the number of the first primitive in a link of the chain.
fn first_number(link: usize) -> u32 {
    64 * link as u32
}

/// The properties of a decoy and of the ray toward it.
#[derive(Clone, Copy, Debug)]
struct Plan {
    reason: CellSkipReason,
    is_left: bool,
    is_sphere: bool,
    /// The number of primitives in the decoy's leaf, including the decoy.
    leaf_size: usize,
    /// The decoy's index in its leaf.
    place: usize,
    level: usize,
    is_flat: bool,
    /// Whether a flat box is actually a line or a point.
    is_line: bool,
    range: usize,
    hits_nothing: bool,
    /// Whether the ray starts in the box of the leaf's sibling.
    starts_in_sibling: bool,
    /// Whether the previous ray hits something in the decoy's leaf.
    is_after_a_hit_in_its_leaf: bool,
}

impl Plan {
    /// Returns one of `DECOYS` plans. Together, these plans cover every class of every property.
    /// The first four alone cover most classes, including rays that hit nothing.
    fn new(reason: CellSkipReason, is_left: bool, index: usize, start: usize) -> Self {
        let (group, in_group) = (index / 4, index % 4);
        let size = (in_group + start) % 4;
        let is_missed = matches!(
            reason,
            CellSkipReason::Missed | CellSkipReason::MissedWithSibling
        );
        let many = if group == 2 || (is_missed && is_left && group == 0) {
            [17, 33][start % 2] + start
        } else {
            4 + (start + index) % 5
        };
        let leaf_size = [1, 2, 3, many][size];
        let last = leaf_size - 1;
        let places = [0, last / 2 + last % 2, last];
        let is_flat = (index / 2 + group + start).is_multiple_of(2);
        let is_line = is_missed && is_flat && !index.is_multiple_of(2);
        let is_after_parallel = reason == CellSkipReason::BeyondAfterParallel;
        let is_after_a_hit_in_its_leaf =
            !is_after_parallel && leaf_size > 2 && !is_line && group < 2;
        // If the previous ray tests the decoy, the decoy isn't a sphere, so that only triangles and
        // boxes matter.
        let is_tested_before = is_after_parallel || is_after_a_hit_in_its_leaf;
        Plan {
            reason,
            is_left,
            is_sphere: !is_tested_before && (group + index).is_multiple_of(2),
            leaf_size,
            place: places[(size + 2 + group) % 3],
            level: (index + group + start / 4) % 4,
            is_flat,
            is_line,
            range: (index + start) % RANGES.len(),
            hits_nothing: is_missed && group == 0,
            starts_in_sibling: reason == CellSkipReason::Beyond && index.is_multiple_of(3),
            is_after_a_hit_in_its_leaf,
        }
    }
}

/// The position and orientation of a cell. In its own coordinates, the cell extends from 0 to 10
/// along x, from −3 to 7 along y, and from −1 to 1 along z.
#[derive(Clone, Copy, Debug)]
struct Frame {
    axes: [DVec3; 3],
    origin: DVec3,
}

impl Frame {
    /// Picks a random orientation for the cell at this position in the grid of cells.
    fn new(rng: &mut Rng, axes: [DVec3; 3], place: usize) -> Self {
        let corner = dvec3(0.0, 10.0 * (place % 6) as f64, 3.0 * (place / 6) as f64);
        let signs = [rng.sign(), rng.sign(), rng.sign()];
        // A rotated cell stays within the same limits.
        let turned = [10.0, 4.0, 0.0];
        let mut frame = Frame {
            axes,
            origin: DVec3::ZERO,
        };
        for axis in 0..3 {
            let shift = if signs[axis] < 0.0 { turned[axis] } else { 0.0 };
            frame.origin += (corner[axis] + shift) * axes[axis];
            frame.axes[axis] *= signs[axis];
        }
        frame
    }

    fn direction(&self, local: DVec3) -> DVec3 {
        self.axes[0] * local.x + self.axes[1] * local.y + self.axes[2] * local.z
    }

    fn point(&self, local: DVec3) -> DVec3 {
        self.origin + self.direction(local)
    }

    fn ray(&self, from: DVec3, dir: DVec3) -> Ray {
        let dir = self.direction(dir.normalize());
        Ray::new(self.point(from).as_vec3(), dir.as_vec3())
    }

    fn flat_triangle(&self, corners: [DVec3; 3]) -> Shape {
        meshes::flat_triangle(corners.map(|corner| self.point(corner)), 0)
    }

    /// Returns a triangle whose box has exactly these corners. The box may be flat.
    fn spanning(&self, min: DVec3, max: DVec3) -> Shape {
        let [second, third] = [max.with_z(min.z), max.with_y(min.y)];
        self.flat_triangle([min, second, third])
    }

    /// Picks a random small primitive inside a box, which may be flat.
    fn small(&self, rng: &mut Rng, min: DVec3, max: DVec3) -> Shape {
        const SIZE: f64 = 0.35;
        let flat = (0..3).find(|&axis| min[axis] == max[axis]);
        let middle = 0.5 * (min + max);
        let half = (0.5 * (max - min) - SIZE).max(DVec3::ZERO);
        let center = middle + half * rng.point(1.0);
        match flat {
            Some(axis) => {
                let (u, v) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
                self.flat_triangle([-u - v, u - v, v].map(|corner| center + SIZE * corner))
            }
            None => meshes::random_flat_triangle(rng, self.point(center), SIZE),
        }
    }
}

fn with_number(shape: Shape, number: u32) -> Shape {
    meshes::with_numbers([shape], [number])[0]
}

/// A tree with one decoy.
#[derive(Clone, Debug)]
struct Cell {
    tree: Tree,
    /// The ray toward the decoy. In some cells, another ray comes before it.
    rays: Vec<Ray>,
}

impl Cell {
    /// Generates a random cell. Returns `None` if it isn't fair.
    fn draw(rng: &mut Rng, plan: &Plan, frame: &Frame, link: usize) -> Option<Cell> {
        let mut draft = Draft {
            rng,
            tree: Tree::default(),
            plan: *plan,
            frame: *frame,
            number: first_number(link),
            decoy: FIRST_DECOY + link as u32,
        };
        let (ray, parallel) = if plan.reason == CellSkipReason::BeyondAfterParallel {
            draft.add_crossing_leaves()
        } else {
            draft.add_leaves()
        };
        let tree = draft.tree;
        let expected = tree.expected_hit(&Ray64::from(&ray));
        if expected.is_none() != plan.hits_nothing || !decoy::is_fair(&tree, &[ray]) {
            return None;
        }
        let before = if plan.is_after_a_hit_in_its_leaf {
            Some(rng.attempt(100, |rng| ray_to_the_leaf_of_the_decoy(rng, &tree))?)
        } else {
            parallel
        };
        let rays: Vec<Ray> = before.into_iter().chain([ray]).collect();
        decoy::is_fair(&tree, &rays).then_some(Cell { tree, rays })
    }
}

/// Picks a random ray that hits another primitive in the decoy's leaf.
fn ray_to_the_leaf_of_the_decoy(rng: &mut Rng, tree: &Tree) -> Option<Ray> {
    let is_decoy = |index: usize| tree.shapes[index].number() >= FIRST_DECOY;
    let mut leaves = tree.leaves().into_iter();
    let leaf = leaves.find(|&leaf| tree.primitives(leaf).any(is_decoy))?;
    let Bounds { min, max } = tree.bounds(leaf);
    let target = min + rng.vector(0.2, 0.8) * (max - min);
    let dir = rng.direction();
    let ray = Ray::new((target - 3.0 * dir).as_vec3(), dir.as_vec3());
    let is_in_leaf = tree.leaf_of_hit(&Ray64::from(&ray)) == Some(leaf);
    (is_in_leaf && decoy::is_fair(tree, &[ray])).then_some(ray)
}

/// The leaf of a decoy.
#[derive(Clone, Copy, Debug)]
struct LeafOfDecoy {
    /// The corners of its box.
    corners: [DVec3; 2],
    /// The axis along which a flat box is flat.
    flat: usize,
    /// The distance to the decoy.
    ahead: f64,
}

/// A cell under construction.
struct Draft<'a> {
    rng: &'a mut Rng,
    tree: Tree,
    plan: Plan,
    frame: Frame,
    /// The number of the next primitive.
    number: u32,
    /// The number of the decoy.
    decoy: u32,
}

impl Draft<'_> {
    /// Returns the shape with the next number.
    fn numbered(&mut self, shape: Shape) -> Shape {
        self.number += 1;
        with_number(shape, self.number - 1)
    }

    /// Returns a triangle whose box has exactly these corners.
    fn spanning(&mut self, min: DVec3, max: DVec3) -> Shape {
        self.numbered(self.frame.spanning(min, max))
    }

    /// Returns a random small primitive inside a box.
    fn small(&mut self, min: DVec3, max: DVec3) -> Shape {
        let shape = self.frame.small(self.rng, min, max);
        self.numbered(shape)
    }

    /// Adds the leaves of a cell in which no boxes cross. Returns the ray toward the decoy.
    fn add_leaves(&mut self) -> (Ray, Option<Ray>) {
        let (up, side) = (self.rng.uniform(0.45, 0.55), self.rng.uniform(-0.04, 0.04));
        let start = dvec3(self.rng.uniform(-0.4, 0.0), 0.0, 0.0);
        let at = |x: f64| dvec3(x, up * (x - start.x), side * (x - start.x));
        let dir = dvec3(1.0, up, side).normalize();
        let ray = self.with_range(self.frame.ray(start, dir));
        let ahead = self.rng.uniform(1.6, 3.2) / dir.x;

        let hit = at(self.rng.uniform(5.8, 6.2));
        let mut targets = vec![if self.plan.hits_nothing {
            let (min, max) = (dvec3(-1.6, -1.5, -1.0), dvec3(2.4, 1.0, 1.0));
            self.spanning(hit + min, hit + max)
        } else {
            let near = [dvec3(-1.6, 1.0, -1.0), dvec3(-1.6, 1.0, 1.0)];
            let corners = [near[0], near[1], dvec3(2.4, -1.5, 0.0)];
            self.numbered(self.frame.flat_triangle(corners.map(|it| hit + it)))
        }];
        if self.plan.leaf_size > 3 {
            for _ in 0..3 {
                let (x, y) = (self.rng.uniform(-1.3, 2.1), self.rng.uniform(-1.2, 0.7));
                targets.push(self.tiny(hit, dvec3(x, y, 0.72)));
            }
        }
        if self.plan.starts_in_sibling {
            targets.push(self.tiny(start, dvec3(-0.5, -0.6, 0.72)));
        }
        let targets = self.rng.shuffled(targets);

        let corners =
            |x: [f64; 2], y: [f64; 2], z: f64| [dvec3(x[0], y[0], -z), dvec3(x[1], y[1], z)];
        let (low, high) = (at(7.2).y, at(8.5).y);
        let any = self.rng.index(3);
        let (own, sibling, flat) = match self.plan.reason {
            CellSkipReason::Missed => (corners([2.5, 5.0], [3.9, 5.1], 0.6), None, any),
            CellSkipReason::MissedWithSibling => {
                let above = corners([2.5, 4.5], [3.7, 4.7], 0.6);
                let below = corners([2.5, 4.5], [-1.4, -0.4], 0.6);
                if self.rng.coin() {
                    (above, Some(below), any)
                } else {
                    (below, Some(above), any)
                }
            }
            CellSkipReason::Beyond
            | CellSkipReason::BeyondAfterFarther
            | CellSkipReason::BeyondAfterParallel => {
                let behind = corners([7.2, 9.0], [low - 1.2, low + 2.0], 1.0);
                (behind, None, 0)
            }
            CellSkipReason::NearerOfTwoBeyond | CellSkipReason::FartherOfTwoBeyond => {
                let nearer = corners([5.2, 9.0], [low, low + 2.0], 1.0);
                let farther = corners([8.5, 10.0], [low - 1.2, high + 2.0], 1.0);
                if self.plan.reason == CellSkipReason::NearerOfTwoBeyond {
                    (nearer, Some(farther), 1)
                } else {
                    (farther, Some(nearer), 0)
                }
            }
        };
        let decoy = LeafOfDecoy {
            corners: own,
            flat,
            ahead,
        };
        if self.plan.reason == CellSkipReason::BeyondAfterFarther {
            let entry = at(self.rng.uniform(0.8, 1.2));
            let end = at(self.rng.uniform(9.2, 9.6));
            let distance = (end - start).length();
            let farther = decoy::triangle_across(self.rng, &ray, distance, 0.25, 0);
            let farther = self.numbered(farther);
            let early = vec![self.tiny(entry, 0.72 * DVec3::Z), farther];
            let early = self.rng.shuffled(early);
            let (early, target) = (self.tree.add_leaf(early), self.tree.add_leaf(targets));
            let is_left = self.rng.coin();
            let both = self.add_interior(early, target, is_left);
            let leaf = self.add_leaf_of_decoy(&decoy, &ray);
            self.add_interior(leaf, both, self.plan.is_left);
            return (ray, None);
        }
        let Some([min, max]) = sibling else {
            self.add_siblings(&decoy, &ray, targets, self.plan.is_left);
            return (ray, None);
        };
        let mut others = vec![self.spanning(min, max)];
        if self.plan.leaf_size > 3 {
            others.extend([(); 3].map(|()| self.small(min, max)));
        }
        let is_missed = self.plan.reason == CellSkipReason::MissedWithSibling;
        let is_left = if is_missed {
            self.plan.is_left
        } else {
            self.rng.coin()
        };
        let both = self.add_siblings(&decoy, &ray, others, is_left);
        let target = self.tree.add_leaf(targets);
        let is_left = self.rng.coin();
        self.add_interior(both, target, is_left);
        (ray, None)
    }

    /// Adds the decoy's leaf and its sibling, starting with the left child, and then their parent.
    fn add_siblings(
        &mut self,
        decoy: &LeafOfDecoy,
        ray: &Ray,
        others: Vec<Shape>,
        is_left: bool,
    ) -> usize {
        if is_left {
            let leaf = self.add_leaf_of_decoy(decoy, ray);
            let other = self.tree.add_leaf(others);
            return self.add_interior(leaf, other, true);
        }
        let other = self.tree.add_leaf(others);
        let leaf = self.add_leaf_of_decoy(decoy, ray);
        self.add_interior(leaf, other, false)
    }

    /// Returns a tiny triangle beside a point, on a random side of the ray's plane.
    fn tiny(&mut self, point: DVec3, beside: DVec3) -> Shape {
        const SIZE: f64 = 0.25;
        let beside = beside * dvec3(1.0, 1.0, self.rng.sign());
        let center = self.frame.point(point + beside);
        let shape = meshes::random_flat_triangle(self.rng, center, SIZE);
        self.numbered(shape)
    }

    /// Adds two leaves whose boxes form a cross. Returns the ray toward the decoy and a parallel
    /// ray that enters the boxes in the opposite order.
    fn add_crossing_leaves(&mut self) -> (Ray, Option<Ray>) {
        let dir = dvec3(1.0, -1.0, self.rng.uniform(-0.03, 0.03)).normalize();
        let shift = dvec3(3.0, 0.0, 0.0);
        let mut jitter = || self.rng.uniform(-0.1, 0.1);
        let start = shift + dvec3(-0.8 + jitter(), 4.0 + jitter(), 0.1);
        let before = shift + dvec3(-2.5 + jitter(), 0.6 + jitter(), 0.1);
        let ray = self.with_range(self.frame.ray(start, dir));

        let (min, max) = (dvec3(0.0, -3.0, -1.0), dvec3(1.0, 3.0, 1.0));
        let wall = self.spanning(shift + min, shift + max);
        let hit = decoy::triangle_across(self.rng, &ray, 2.0, 0.15, 0);
        let hit = self.numbered(hit);
        let target = self.tree.add_leaf(vec![wall, hit]);
        let crossing = [dvec3(-2.5, -3.0, -1.0), dvec3(5.0, -1.0, 1.0)];
        let crossing = if self.plan.is_flat {
            [crossing[0].with_y(-1.0), crossing[1]]
        } else {
            crossing
        };
        let ahead = self.rng.uniform(0.7, 1.1);
        let decoy = LeafOfDecoy {
            corners: crossing.map(|corner| shift + corner),
            flat: 1,
            ahead,
        };
        let leaf = self.add_leaf_of_decoy(&decoy, &ray);
        self.add_interior(leaf, target, self.plan.is_left);
        (ray, Some(self.frame.ray(before, dir)))
    }

    /// Returns the ray with the planned range. The range begins before the decoy and ends beyond
    /// all boxes.
    fn with_range(&mut self, ray: Ray) -> Ray {
        let later = self.rng.uniform(0.05, 0.3) as f32;
        let end = self.rng.uniform(14.0, 25.0) as f32;
        let far_end = self.rng.log_uniform(1e18, 1e30) as f32;
        let (min, max) = match self.plan.range {
            0 => (0.0, f32::INFINITY),
            1 => (0.0, end),
            2 => (later, f32::INFINITY),
            3 => (later, end),
            4 => (0.0, far_end),
            _ => (later, far_end),
        };
        ray.within(min, max)
    }

    /// Adds the leaf with the decoy. The decoy is on the ray. A flat box is flattened along `flat`,
    /// onto the face where the ray enters.
    fn add_leaf_of_decoy(&mut self, decoy: &LeafOfDecoy, ray: &Ray) -> usize {
        let LeafOfDecoy {
            corners: [min, mut max],
            flat,
            ahead,
        } = *decoy;
        if self.plan.is_line {
            // If this isn't one of the three axes, the box is a point.
            let along = self.rng.index(4);
            for axis in (0..3).filter(|&axis| axis != along) {
                max[axis] = min[axis];
            }
        } else if self.plan.is_flat {
            max[flat] = min[flat];
        }
        let mut others = vec![self.spanning(min, max)];
        for _ in 2..self.plan.leaf_size {
            others.push(if self.plan.is_line {
                let end = min.lerp(max, self.rng.uniform(0.1, 0.9));
                self.spanning(min, end)
            } else {
                self.small(min, max)
            });
        }
        let others = self.rng.shuffled(others);
        let decoy = if self.plan.is_sphere {
            let middle = ray.origin.as_dvec3() + ahead * ray.dir.as_dvec3();
            with_number(meshes::sphere(middle, 0.25), self.decoy)
        } else {
            decoy::triangle_across(self.rng, ray, ahead, 0.25, self.decoy)
        };
        let leaf = self.tree.add_leaf(others);
        let start = self.tree.primitives(leaf).start;
        if self.plan.leaf_size == 1 {
            self.tree.shapes[start] = decoy;
            return leaf;
        }
        self.tree.shapes.insert(start + self.plan.place, decoy);
        self.tree.nodes[leaf].size += 1;
        leaf
    }

    /// Adds a node above two others and makes it the root.
    fn add_interior(&mut self, one: usize, other: usize, is_left: bool) -> usize {
        let (l, r) = if is_left { (one, other) } else { (other, one) };
        self.tree.root = self.tree.add_interior(l, r);
        self.tree.root
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::domains::{Domain, traverse};
    use crate::seed::Seed;

    #[test]
    fn the_plans_for_a_reason_have_all_properties() {
        for start in 0..DECOYS {
            let plan = |index: usize| Plan::new(CellSkipReason::Missed, true, index, start);
            let plans: Vec<Plan> = (0..DECOYS).map(plan).collect();
            let count = |property: fn(&Plan) -> usize| {
                let values: BTreeSet<usize> = plans.iter().map(property).collect();
                values.len()
            };
            assert_eq!(count(|plan| plan.leaf_size.min(4)), 4);
            assert_eq!(count(|plan| plan.level), LINKS.len());
            assert_eq!(count(|plan| plan.range), RANGES.len());
            assert_eq!(count(|plan| usize::from(plan.is_sphere)), 2);
            assert_eq!(count(|plan| usize::from(plan.is_flat)), 2);
            assert!(plans.iter().all(|plan| plan.place < plan.leaf_size));
        }
    }

    #[test]
    fn every_reason_has_decoys_of_its_class() {
        let reasons = [
            CellSkipReason::Missed,
            CellSkipReason::MissedWithSibling,
            CellSkipReason::NearerOfTwoBeyond,
        ];
        let decoys = Decoys {
            reasons: &reasons,
            is_left: true,
            slides: SlidesAnswer::Wrong,
            fill: 1,
        };
        let asked = question(&mut Seed(1).rng("items.traverse.cells"), decoys);
        let aspects = traverse::TRAVERSE.aspects();
        let aspect = aspects.iter().position(|(name, _)| *name == "decoy");
        let aspect = aspect.expect("the domain has the aspect");
        let calls = traverse::TRAVERSE.classes(&asked.question, None);
        let times = |class: usize| {
            let of_class = calls.iter().filter(|call| call[aspect] == Some(class));
            of_class.count()
        };
        assert_eq!([0, 1, 2, 3, 4].map(times), [DECOYS, DECOYS, 0, DECOYS, 0]);
    }
}
