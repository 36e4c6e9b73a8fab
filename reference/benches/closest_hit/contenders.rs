//! The contenders. Each builds a tree over the same triangles and finds closest hits.

use std::hint::black_box;
use std::rc::Rc;
use std::time::Duration;

use ::bvh::aabb::{Aabb, Bounded};
use ::bvh::bounding_hierarchy::BHShape;
use ::bvh::bvh::Bvh as CrateBvh;
use glam::Vec3;
use nalgebra::{Point3, Vector3};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::ray::RayHit;
use obvhs::triangle::Triangle;
use protocol::{Ray, Trace};
use reference::bvh::Bvh;
use variants::bvh::wide;

use crate::embree::EmbreeScene;

/// The maximum number of primitives in a leaf of the reference and the variant.
pub const MAX_LEAF_SIZE: usize = 4;

/// A tree over the triangles, which finds closest hits.
pub trait Contender {
    /// Returns the distance to the closest hit of each ray, or infinity for a ray that hits
    /// nothing.
    fn distances(&self, rays: &[Ray]) -> Vec<f32>;
}

/// The reference, which students can read. Like the variant `wide`, it computes the complete
/// [`Trace`].
impl Contender for Bvh {
    fn distances(&self, rays: &[Ray]) -> Vec<f32> {
        trace_distances(rays, |ray| self.hit(ray))
    }
}

/// The eight-wide variant.
impl Contender for wide::Bvh {
    fn distances(&self, rays: &[Ray]) -> Vec<f32> {
        trace_distances(rays, |ray| self.hit(ray))
    }
}

/// Computes complete hits and returns their distances. The compiler cannot leave out the other
/// parts of the hits.
fn trace_distances(rays: &[Ray], hit: impl Fn(&Ray) -> Option<Trace>) -> Vec<f32> {
    let distance = |ray| black_box(hit(ray)).map_or(f32::INFINITY, |trace| trace.distance);
    rays.iter().map(distance).collect()
}

impl Contender for EmbreeScene<'_> {
    fn distances(&self, rays: &[Ray]) -> Vec<f32> {
        rays.iter().map(|ray| self.distance(ray)).collect()
    }
}

/// The binary tree of the crate `obvhs`, built with `medium_build`.
pub struct Obvhs {
    bvh: Bvh2,
    /// The triangles in leaf order, as recommended by the crate's documentation.
    triangles: Vec<Triangle>,
}

impl Obvhs {
    pub fn triangles(corners: &[[Vec3; 3]]) -> Vec<Triangle> {
        let triangle = |[v0, v1, v2]: &[Vec3; 3]| Triangle {
            v0: (*v0).into(),
            v1: (*v1).into(),
            v2: (*v2).into(),
        };
        corners.iter().map(triangle).collect()
    }

    pub fn build(triangles: &[Triangle]) -> Self {
        let mut ignored = Duration::ZERO;
        let bvh = build_bvh2_from_tris(triangles, BvhBuildParams::medium_build(), &mut ignored);
        let indices = bvh.primitive_indices.iter();
        let triangles = indices.map(|&index| triangles[index as usize]).collect();
        Obvhs { bvh, triangles }
    }
}

impl Contender for Obvhs {
    fn distances(&self, rays: &[Ray]) -> Vec<f32> {
        let distance = |ray: &Ray| {
            let range = ray.range;
            let ray = obvhs::ray::Ray::new(ray.origin.into(), ray.dir.into(), range.min, range.max);
            let mut hit = RayHit::none();
            self.bvh
                .ray_traverse(ray, &mut hit, |ray, id| self.triangles[id].intersect(ray));
            hit.t
        };
        rays.iter().map(distance).collect()
    }
}

/// A tree built by the crate `bvh`. The crate can traverse the tree in two ways. Which of them is
/// faster depends on the rays.
pub struct CrateBvhTree {
    bvh: CrateBvh<f32, 3>,
    triangles: Vec<Corners>,
}

impl CrateBvhTree {
    pub fn build(corners: &[[Vec3; 3]]) -> Self {
        let corners = corners.iter().copied();
        let mut triangles: Vec<Corners> = corners
            .map(|corners| Corners { corners, node: 0 })
            .collect();
        let bvh = CrateBvh::build(&mut triangles);
        CrateBvhTree { bvh, triangles }
    }

    /// Returns the distance to the closest hit. Traverses in order of distance and stops at the
    /// first box that is farther away than the closest hit.
    fn closest_ordered(&self, ray: &Ray) -> f32 {
        let query = query(ray);
        let mut closest = f32::INFINITY;
        for triangle in self.bvh.nearest_traverse_iterator(&query, &self.triangles) {
            let entry = query.intersection_slice_for_aabb(&triangle.aabb());
            if entry.is_some_and(|(entry, _)| entry > closest) {
                break;
            }
            closest = closest.min(triangle.distance(ray));
        }
        closest
    }

    /// Returns the distance to the closest hit. Tests every triangle whose box the ray hits.
    fn closest_of_all(&self, ray: &Ray) -> f32 {
        let query = query(ray);
        let candidates = self.bvh.traverse_iterator(&query, &self.triangles);
        candidates
            .map(|triangle| triangle.distance(ray))
            .fold(f32::INFINITY, f32::min)
    }
}

/// The crate `bvh`, with one of its two ways of traversing a tree.
pub struct Traversed {
    pub tree: Rc<CrateBvhTree>,
    /// Whether to traverse in order of distance instead of testing every triangle whose box is hit.
    pub is_ordered: bool,
}

impl Contender for Traversed {
    fn distances(&self, rays: &[Ray]) -> Vec<f32> {
        let distance = |ray| {
            if self.is_ordered {
                self.tree.closest_ordered(ray)
            } else {
                self.tree.closest_of_all(ray)
            }
        };
        rays.iter().map(distance).collect()
    }
}

fn query(ray: &Ray) -> ::bvh::ray::Ray<f32, 3> {
    ::bvh::ray::Ray::new(
        Point3::from(ray.origin.to_array()),
        Vector3::from(ray.dir.to_array()),
    )
}

/// A triangle that implements the traits required by the crate `bvh`.
struct Corners {
    corners: [Vec3; 3],
    node: usize,
}

impl Corners {
    /// Returns the distance to the hit, or infinity. This is the Möller–Trumbore test, for both
    /// sides of the triangle. The crate's own test culls back faces.
    fn distance(&self, ray: &Ray) -> f32 {
        let [p0, p1, p2] = self.corners;
        let (e1, e2) = (p1 - p0, p2 - p0);
        let p = ray.dir.cross(e2);
        let determinant = e1.dot(p);
        let s = ray.origin - p0;
        let u = s.dot(p) / determinant;
        let q = s.cross(e1);
        let v = ray.dir.dot(q) / determinant;
        let t = e2.dot(q) / determinant;
        let hit = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && ray.range.contains(t);
        if hit { t } else { f32::INFINITY }
    }
}

impl Bounded<f32, 3> for Corners {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [a, b, c] = self.corners.map(|corner| Point3::from(corner.to_array()));
        Aabb::empty().grow(&a).grow(&b).grow(&c)
    }
}

impl BHShape<f32, 3> for Corners {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}
