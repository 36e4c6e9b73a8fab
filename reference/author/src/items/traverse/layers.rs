//! Pairs of triangles, one close behind the other. A correct traversal returns the hit on the front
//! triangle, no matter how close the other triangle is or which of the two is found first.

use glam::{DVec3, dvec3};
use judging::exam::ExamQuestion;
use protocol::{Ray, Shape};

use super::placed::as_dust;
use super::{meshes, traversal_question};
use crate::oracle::Ray64;
use crate::seed::Rng;
use crate::tree::{Tree, decoy};

/// The number of pairs.
const PAIRS: usize = 18;
/// The size of the triangles.
const SIZE: f64 = 0.2;
/// The extent of the pairs' positions. It is so large that, if a ray starts near a pair, the
/// distances to both triangles are tiny even compared to the start's coordinates.
const SPREAD: f64 = 52.0;
/// The distance between the two triangles of a pair.
const SPACE: f64 = 0.0175;

/// Creates a question about pairs of triangles. The triangles are so small that `Mover` doesn't
/// move the question. A third of the rays start so close to a pair that the distances to both
/// triangles are tiny compared to the size of the tree. The other rays start so far away that both
/// triangles, which are in the same leaf or in different leaves, are at almost the same distance.
pub(super) fn question(rng: &mut Rng) -> ExamQuestion {
    rng.retry(|rng| {
        let mut tree = Tree::default();
        let mut rays = Vec::new();
        let mut roots = Vec::new();
        for index in 0..PAIRS {
            let place = dvec3(
                (index % 3) as f64,
                (index / 3 % 3) as f64,
                (index / 9) as f64,
            );
            let place = SPREAD * (place / dvec3(2.0, 2.0, 1.0) - 0.5) + rng.point(0.8);
            let axis = index % 3;
            let pair = Pair {
                place,
                normal: rng.sign() * DVec3::AXES[axis],
                across: [1, 2].map(|next| DVec3::AXES[(axis + next) % 3]),
                number: 4 * index as u32,
            };
            let distance = match index / 3 % 3 {
                0 => rng.uniform(0.0048, 0.0056),
                _ => rng.uniform(20.0, 24.0),
            };
            let root = match index / 3 % 3 {
                2 => pair.add_leaf(&mut tree),
                _ => pair.add_two_leaves(rng, &mut tree),
            };
            let (hit, miss) = pair.rays(rng, distance);
            roots.push(root);
            rays.extend([hit, miss]);
        }
        while let [first, second, ..] = roots[..] {
            let both = if rng.coin() {
                tree.add_interior(first, second)
            } else {
                tree.add_interior(second, first)
            };
            roots.drain(..2);
            roots.push(both);
        }
        tree.root = roots[0];
        let is_hit = |ray: &Ray| tree.expected_hit(&Ray64::from(ray)).is_some();
        let is_as_planned = rays
            .chunks(2)
            .all(|pair| is_hit(&pair[0]) && !is_hit(&pair[1]));
        if !is_as_planned || !decoy::is_fair(&tree, &rays) {
            return None;
        }
        let rays = rng.shuffled(rays);
        let asked = traversal_question(&tree.with_roots_at_both_ends(rng), rays);
        Some(as_dust(&asked))
    })
}

/// Two triangles perpendicular to an axis.
#[derive(Clone, Copy, Debug)]
struct Pair {
    /// The middle of the front triangle.
    place: DVec3,
    /// The direction from the front triangle to the rear triangle.
    normal: DVec3,
    /// The axes along which the triangles extend.
    across: [DVec3; 2],
    /// The number of the first primitive.
    number: u32,
}

impl Pair {
    /// Returns a triangle that is offset from the front triangle by these distances, backward and
    /// sideways.
    fn triangle(&self, behind: f64, aside: f64, number: u32) -> Shape {
        let [x, y] = self.across;
        let middle = self.place + behind * self.normal + aside * x;
        let corner = |(along_x, along_y): (f64, f64)| middle + SIZE * (along_x * x + along_y * y);
        let corners = [(-1.0, -0.7), (1.0, -0.7), (0.0, 1.1)].map(corner);
        meshes::flat_triangle(corners, self.number + number)
    }

    /// Returns two rays that start at this distance: one hits the front triangle, and the other
    /// misses it.
    fn rays(&self, rng: &mut Rng, distance: f64) -> (Ray, Ray) {
        let [x, y] = self.across;
        let slant = rng.uniform(-0.15, 0.15) * x + rng.uniform(-0.15, 0.15) * y;
        let dir = (self.normal + slant).normalize();
        let target =
            self.place + 0.1 * SIZE * (rng.uniform(-1.0, 1.0) * x + rng.uniform(-1.0, 1.0) * y);
        let ray = |target: DVec3| Ray::new((target - distance * dir).as_vec3(), dir.as_vec3());
        (ray(target), ray(target - 3.0 * SIZE * y))
    }

    /// Adds the two triangles in two leaves. The box of the rear triangle's leaf begins before the
    /// front triangle.
    fn add_two_leaves(&self, rng: &mut Rng, tree: &mut Tree) -> usize {
        let behind = self.triangle(SPACE, 0.0, 0);
        let corner = self.triangle(-0.4, 3.0 * SIZE, 1);
        let front = self.triangle(0.0, 0.0, 2);
        let around = tree.add_leaf(vec![behind, corner]);
        let front = tree.add_leaf(vec![front]);
        if rng.coin() {
            tree.add_interior(around, front)
        } else {
            tree.add_interior(front, around)
        }
    }

    /// Adds the two triangles in one leaf, the rear one first.
    fn add_leaf(&self, tree: &mut Tree) -> usize {
        let behind = self.triangle(SPACE, 0.0, 0);
        let front = self.triangle(0.0, 0.0, 1);
        tree.add_leaf(vec![behind, front])
    }
}
