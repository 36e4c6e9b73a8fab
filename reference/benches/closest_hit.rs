//! The reference's `Bvh` beside the crate `bvh`: the same triangles, the same rays, one thread,
//! turn by turn in one process, so that a noisy machine disturbs both alike.
//!
//! `cargo bench -p reference` prints rays per second and their ratio, the median of the rounds.

use std::path::Path;
use std::time::Instant;

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh as TheirBvh;
use framework::scene::Scene;
use glam::{Vec3, vec3};
use nalgebra::{Point3, Vector3};
use protocol::{Ray, Shape};
use reference::bvh::Bvh;
use reference::camera::Camera;
use reference::primitive::Primitive;

const ROUNDS: usize = 7;
const RAYS: usize = 100_000;
const LEAF: usize = 4;

fn main() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/gyroid.json");
    let scene = Scene::load(&path).expect("the scene is part of the project");
    let ours = Bvh::build(scene.shapes.iter().map(Primitive::new).collect(), LEAF);
    let mut triangles: Vec<Corners> = scene.shapes.iter().filter_map(Corners::of).collect();
    assert_eq!(triangles.len(), scene.shapes.len(), "triangles only");
    let theirs = TheirBvh::build(&mut triangles);

    println!(
        "{} triangles, {RAYS} rays of each kind, median of {ROUNDS} rounds\n",
        triangles.len()
    );
    println!("rays       reference   crate bvh   ratio");
    let primary = primary(&scene);
    let bounce = bounce(&ours, &primary);
    for (name, rays) in [
        ("primary", &primary),
        ("bounce", &bounce),
        ("random", &random()),
    ] {
        compare(name, rays, &ours, &theirs, &triangles);
    }
}

fn compare(name: &str, rays: &[Ray], ours: &Bvh, theirs: &TheirBvh<f32, 3>, triangles: &[Corners]) {
    let mut speeds = Vec::new();
    for _ in 0..ROUNDS {
        let (our_hits, our_speed) = timed(rays, |ray| ours.hit(ray).map(|trace| trace.distance));
        // Its two ways to the closest hit, of which the faster counts.
        let (near_hits, near_speed) = timed(rays, |ray| nearest(theirs, triangles, ray));
        let (all_hits, all_speed) = timed(rays, |ray| all(theirs, triangles, ray));
        agree(&our_hits, &near_hits);
        agree(&our_hits, &all_hits);
        speeds.push((our_speed, near_speed.max(all_speed)));
    }
    let median = |of: fn(&(f64, f64)) -> f64| {
        let mut values: Vec<f64> = speeds.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values[ROUNDS / 2]
    };
    let (our_speed, their_speed) = (median(|pair| pair.0), median(|pair| pair.1));
    let ratio = median(|pair| pair.0 / pair.1);
    println!("{name:8} {our_speed:>6.2} M/s    {their_speed:>6.2} M/s    {ratio:>4.2}");
}

fn timed(rays: &[Ray], hit: impl Fn(&Ray) -> Option<f32>) -> (Vec<Option<f32>>, f64) {
    let start = Instant::now();
    let hits = rays.iter().map(hit).collect();
    (
        hits,
        rays.len() as f64 / start.elapsed().as_secs_f64() / 1e6,
    )
}

/// Speed is worth nothing without right answers; last bits may differ at edges.
fn agree(a: &[Option<f32>], b: &[Option<f32>]) {
    let same = |(a, b): &(&Option<f32>, &Option<f32>)| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-3 * a.max(1.0),
        (None, None) => true,
        (Some(_), None) | (None, Some(_)) => false,
    };
    let differing = a.len() - a.iter().zip(b).filter(same).count();
    assert!(
        differing * 1000 <= a.len(),
        "{differing} of {} rays differ",
        a.len()
    );
}

/// In order of distance, until a box begins beyond the closest hit.
fn nearest(bvh: &TheirBvh<f32, 3>, triangles: &[Corners], ray: &Ray) -> Option<f32> {
    let query = query(ray);
    let mut closest = f32::INFINITY;
    for triangle in bvh.nearest_traverse_iterator(&query, triangles) {
        let entry = query.intersection_slice_for_aabb(&triangle.aabb());
        if entry.is_some_and(|(entry, _)| entry > closest) {
            break;
        }
        closest = closest.min(triangle.distance(ray));
    }
    closest.is_finite().then_some(closest)
}

/// Every triangle whose box is met.
fn all(bvh: &TheirBvh<f32, 3>, triangles: &[Corners], ray: &Ray) -> Option<f32> {
    let query = query(ray);
    let met = bvh.traverse_iterator(&query, triangles);
    let closest = met
        .map(|triangle| triangle.distance(ray))
        .fold(f32::INFINITY, f32::min);
    closest.is_finite().then_some(closest)
}

fn query(ray: &Ray) -> bvh::ray::Ray<f32, 3> {
    bvh::ray::Ray::new(
        Point3::from(ray.origin.to_array()),
        Vector3::from(ray.dir.to_array()),
    )
}

/// A triangle as that crate wants it.
struct Corners {
    corners: [Vec3; 3],
    node: usize,
}

impl Corners {
    fn of(shape: &Shape) -> Option<Self> {
        let corners = match *shape {
            Shape::Triangle { vertices, .. } => vertices.map(|vertex| vertex.position),
            Shape::Facet { corners, .. } => corners,
            Shape::Sphere { .. } => return None,
        };
        Some(Corners { corners, node: 0 })
    }

    /// Möller and Trumbore's test, two-sided, for the distance alone: that crate's own culls back
    /// faces. Infinite for a miss.
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

/// One ray through each of enough pixels.
fn primary(scene: &Scene) -> Vec<Ray> {
    let side = (RAYS as f32).sqrt() as u32;
    let film = glam::uvec2(side, side);
    let camera = Camera::new(scene.camera.lens.vertical_fov, 1.0, film);
    let pixels = (0..side * side).map(|i| glam::uvec2(i % side, i / side));
    pixels
        .map(|pixel| {
            scene
                .camera
                .placement
                .to_world(&camera.sample_ray(pixel, glam::Vec2::splat(0.5)))
        })
        .collect()
}

/// From where the primary rays hit, anywhere into the hemisphere.
fn bounce(bvh: &Bvh, primary: &[Ray]) -> Vec<Ray> {
    let mut numbers = Numbers(1);
    let hits = primary.iter().filter_map(|ray| Some((ray, bvh.hit(ray)?)));
    hits.map(|(ray, trace)| {
        let facing = trace.normal * -ray.dir.dot(trace.normal).signum();
        let dir = (facing + numbers.direction()).normalize_or(facing);
        Ray::new(trace.position, dir).within(1e-3, f32::INFINITY)
    })
    .collect()
}

/// From a sphere around the mesh to anywhere in it.
fn random() -> Vec<Ray> {
    let mut numbers = Numbers(2);
    let ray = |_| {
        let origin = 3.0 * numbers.direction();
        Ray::new(origin, numbers.direction() - origin)
    };
    (0..RAYS).map(ray).collect()
}

/// SplitMix64: Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", 2014.
struct Numbers(u64);

impl Numbers {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let point = vec3(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0;
            if (0.01..1.0).contains(&point.length_squared()) {
                return point.normalize();
            }
        }
    }
}
