//! Generates three kinds of rays, the same for every contender: a path tracer's primary rays, its
//! bounce rays, and random rays.

use glam::{Vec3, vec3};
use protocol::Ray;
use reference::bvh::Bvh;

use crate::mesh::Mesh;
use crate::numbers::SplitMix64;

/// Rays of one kind.
pub struct Rays {
    pub kind: &'static str,
    pub rays: Vec<Ray>,
}

/// Returns the rays of all three kinds. There are about `side`² rays of each kind, as many as a
/// square picture has pixels.
pub fn all_kinds(mesh: &Mesh, bvh: &Bvh, side: u32) -> [Rays; 3] {
    let primary = primary(mesh, side);
    let bounce = bounce(mesh, bvh, &primary);
    let random = random(mesh, primary.len());
    [("primary", primary), ("bounce", bounce), ("random", random)]
        .map(|(kind, rays)| Rays { kind, rays })
}

/// Returns a ray through each pixel, row by row.
fn primary(mesh: &Mesh, side: u32) -> Vec<Ray> {
    let (center, size) = (mesh.bbox.center(), mesh.bbox.max - mesh.bbox.min);
    let (eye, ahead, width) = if mesh.is_building {
        (center - vec3(0.35, 0.05, 0.0) * size, Vec3::X, 1.5)
    } else {
        (center + 1.1 * size.length() * Vec3::Z, Vec3::NEG_Z, 0.6)
    };
    let across = |i: u32| ((i as f32 + 0.5) / side as f32 - 0.5) * width;
    let ray = |i| {
        let (x, y) = (across(i % side), across(i / side));
        Ray::new(eye, ahead + x * ahead.cross(Vec3::Y) + y * Vec3::Y)
    };
    (0..side * side).map(ray).collect()
}

/// Returns rays that start at the hits of the primary rays and leave the surface in random
/// directions, then rays that start at the hits of these rays, and so on.
fn bounce(mesh: &Mesh, bvh: &Bvh, primary: &[Ray]) -> Vec<Ray> {
    let gap = 1e-4 * (mesh.bbox.max - mesh.bbox.min).length();
    let mut numbers = SplitMix64(1);
    let mut all = Vec::new();
    let mut last = primary.to_vec();
    while all.len() < primary.len() && !last.is_empty() {
        let hits = last.iter().filter_map(|ray| Some((ray, bvh.hit(ray)?)));
        let next = hits.map(|(ray, trace)| {
            let facing = trace.normal * -ray.dir.dot(trace.normal).signum();
            let dir = (facing + numbers.in_ball().normalize()).normalize_or(facing);
            Ray::new(trace.position, dir).within(gap, f32::INFINITY)
        });
        last = next.collect();
        all.extend_from_slice(&last);
    }
    all.truncate(primary.len());
    all
}

/// Returns rays to random points in the mesh's box. They start on a sphere around the mesh or, if
/// the mesh is a building, at random points in its box.
fn random(mesh: &Mesh, count: usize) -> Vec<Ray> {
    let (center, size) = (mesh.bbox.center(), mesh.bbox.max - mesh.bbox.min);
    let mut numbers = SplitMix64(2);
    let ray = |_| {
        let to = mesh.bbox.min + numbers.point() * size;
        let from = if mesh.is_building {
            mesh.bbox.min + numbers.point() * size
        } else {
            center + size.length() * numbers.in_ball().normalize()
        };
        Ray::new(from, to - from)
    };
    (0..count).map(ray).collect()
}
