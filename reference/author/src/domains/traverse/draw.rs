//! Generates random rays toward trees and from inside them.

use glam::DVec3;
use protocol::{Ray, Shape};

use crate::domains::fields::direction;
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;
use crate::tree::Tree;

/// Picks a random ray toward a point in a tree. The ray starts near the tree, far away from it or
/// inside it, but its distance from each shape is at most 30 times the shape's size.
pub fn ray(rng: &mut Rng, tree: &Tree) -> Ray {
    /// The maximum distance from a faraway start to any shape, as a multiple of the smallest
    /// shape's size.
    const FARTHEST: f64 = 27.0;
    let bounds = tree.bounds(tree.root);
    let target = bounds.center() + rng.point(0.45) * (bounds.max - bounds.min);
    let sizes = tree.shapes.iter();
    let sizes = sizes.map(|shape| scan::bounds(shape).half_side());
    let smallest = sizes.fold(f64::INFINITY, f64::min);
    let farthest = FARTHEST * smallest - bounds.diagonal();
    let dir = direction(rng);
    let near = rng.uniform(0.6, 1.0) * bounds.diagonal();
    let distance = match rng.index(6) {
        0 => rng.uniform(0.0, 0.2) * bounds.diagonal(),
        1 => near.max(farthest.min(6.0 * bounds.diagonal())),
        _ => near,
    };
    let start: DVec3 = target - distance * dir;
    Ray::new(start.as_vec3(), dir.as_vec3())
}

/// Picks a random ray that starts where another ray hits a surface. The new ray's range begins a
/// short distance from its start. Returns `None` if the other ray hits nothing.
pub fn ray_from_a_surface(rng: &mut Rng, tree: &Tree) -> Option<Ray> {
    let hit = tree.expected_hit(&Ray64::from(&ray(rng, tree)))?;
    let later = 0.02 * tree.bounds(tree.root).diagonal();
    let ray = Ray::new(hit.position.as_vec3(), direction(rng).as_vec3());
    Some(ray.within(later as f32, f32::INFINITY))
}

/// Picks a random ray that starts on a sphere and passes through it. The range begins a little
/// after the ray's start. Returns `None` if the ray doesn't hit that sphere.
pub fn ray_through_the_sphere_that_it_starts_on(rng: &mut Rng, tree: &Tree) -> Option<Ray> {
    let shape = &tree.shapes[rng.index(tree.shapes.len())];
    let Shape::Sphere { center, radius, .. } = *shape else {
        return None;
    };
    let (normal, dir) = (rng.direction(), direction(rng));
    let start = center.as_dvec3() + f64::from(radius) * normal;
    let ray = Ray::new(start.as_vec3(), dir.as_vec3()).within(0.06 * radius, f32::INFINITY);
    let hit = tree.expected_hit(&Ray64::from(&ray))?;
    (dir.dot(normal) < -0.3 && hit.shape == shape.number()).then_some(ray)
}

/// Picks a random ray that starts in a box, more than half a side away from the middle, and hits
/// something in a corner of that box. Returns `None` if there is nothing to hit.
pub fn ray_in_a_corner(rng: &mut Rng, tree: &Tree) -> Option<Ray> {
    let leaves = tree.leaves();
    let leaf = leaves[rng.index(leaves.len())];
    let target = tree.bounds(leaf).center();
    let path = tree.path(leaf);
    let bounds = tree.bounds(path[rng.index(path.len())]);
    let from_middle = target - bounds.center();
    let dir = from_middle.try_normalize()?;
    let start = bounds.center() + bounds.half_side() * rng.uniform(1.02, 1.1) * dir;
    let is_ahead = from_middle.length() > start.distance(bounds.center());
    let ray = Ray::new(start.as_vec3(), dir.as_vec3());
    let is_hit = tree.leaf_of_hit(&Ray64::from(&ray)) == Some(leaf);
    (is_ahead && is_hit).then_some(ray)
}

#[cfg(test)]
mod tests {
    use super::super::tests::row_of_spheres;
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn rays_lead_toward_the_tree_from_not_too_far_away() {
        let tree = row_of_spheres();
        let mut rng = Seed(1).rng("domains.traverse");
        for _ in 0..100 {
            let ray = ray(&mut rng, &tree);
            let span = tree.bounds(tree.root).span(&Ray64::from(&ray));
            assert!(span.is_some(), "{ray:?}");
            assert!(ray.origin.length() < 30.0 + 8.0, "{ray:?}");
        }
    }

    #[test]
    fn a_ray_from_a_surface_starts_where_another_one_hits() {
        let tree = row_of_spheres();
        let mut rng = Seed(2).rng("domains.traverse");
        let ray = rng.retry(|rng| ray_from_a_surface(rng, &tree));
        let start = ray.origin.as_dvec3();
        let mut centers = (0..3).map(|index| 4.0 * f64::from(index) * DVec3::X);
        assert!(centers.any(|center| (start.distance(center) - 1.0).abs() < 1e-5));
        assert!(ray.range.min > 0.0);
    }
}
