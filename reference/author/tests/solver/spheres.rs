//! Spheres in single precision: several right formulas, and wrong ones.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3, vec2};
use protocol::{Ray, Trace};

pub type SphereHit = fn(&Ray, Vec3, f32, u32) -> Option<Trace>;

fn uv(dir: Vec3) -> Vec2 {
    let u = dir.z.atan2(dir.x) / TAU;
    vec2(u.rem_euclid(1.0), (-dir.y.clamp(-1.0, 1.0)).acos() / PI)
}

fn on_sphere(ray: &Ray, center: Vec3, material: u32, t: f32) -> Trace {
    let position = ray.at(t);
    let normal = (position - center).normalize();
    Trace {
        distance: t,
        position,
        normal,
        uv: uv(normal),
        origin: ray.origin,
        material,
    }
}

/// All of the slides' formula.
fn full_roots(ray: &Ray, center: Vec3, radius: f32) -> [f32; 2] {
    let o = ray.origin - center;
    let a = ray.dir.length_squared();
    let b = 2.0 * o.dot(ray.dir);
    let c = o.length_squared() - radius * radius;
    let root = (b * b - 4.0 * a * c).sqrt();
    [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]
}

/// Without the twos, and with a = 1.
fn half_roots(ray: &Ray, center: Vec3, radius: f32) -> [f32; 2] {
    let o = ray.origin - center;
    let b = o.dot(ray.dir);
    let root = (b * b - (o.dot(o) - radius * radius)).sqrt();
    [-b - root, -b + root]
}

/// Without cancellation: Press et al., "Numerical Recipes", section 5.6.
fn stable_roots(ray: &Ray, center: Vec3, radius: f32) -> [f32; 2] {
    let o = ray.origin - center;
    let b = o.dot(ray.dir);
    let c = o.length_squared() - radius * radius;
    let q = -(b + b.signum() * (b * b - c).sqrt());
    if b > 0.0 { [q, c / q] } else { [c / q, q] }
}

type Roots = fn(&Ray, Vec3, f32) -> [f32; 2];

fn first(roots: Roots, ray: &Ray, center: Vec3, radius: f32, material: u32) -> Option<Trace> {
    let roots = roots(ray, center, radius);
    let t = roots.into_iter().find(|t| ray.range.contains(*t))?;
    Some(on_sphere(ray, center, material, t))
}

pub const SPHERES: [(&str, SphereHit); 3] = [
    ("all of the quadratic", |ray, c, r, m| {
        first(full_roots, ray, c, r, m)
    }),
    ("half of it", |ray, c, r, m| first(half_roots, ray, c, r, m)),
    ("a stable one", |ray, c, r, m| {
        first(stable_roots, ray, c, r, m)
    }),
];

fn sphere_but(
    ray: &Ray,
    c: Vec3,
    r: f32,
    m: u32,
    change: impl FnOnce(&mut Trace),
) -> Option<Trace> {
    let mut trace = first(half_roots, ray, c, r, m)?;
    change(&mut trace);
    Some(trace)
}

pub const WRONG_SPHERES: [(&str, SphereHit); 17] = [
    ("never", |_, _, _, _| None),
    ("far root first", |ray, c, r, m| {
        let [near, far] = half_roots(ray, c, r);
        let t = [far, near].into_iter().find(|t| ray.range.contains(*t))?;
        Some(on_sphere(ray, c, m, t))
    }),
    ("near root only", |ray, c, r, m| {
        let [near, _] = half_roots(ray, c, r);
        ray.range.contains(near).then(|| on_sphere(ray, c, m, near))
    }),
    ("a radius of 1", |ray, c, _, m| {
        first(half_roots, ray, c, 1.0, m)
    }),
    ("both roots must be in the range", |ray, c, r, m| {
        let all = half_roots(ray, c, r).iter().all(|t| ray.range.contains(*t));
        first(half_roots, ray, c, r, m).filter(|_| all)
    }),
    ("a range from 0", |ray, c, r, m| {
        first(half_roots, &ray.within(0.0, ray.range.max), c, r, m)
    }),
    ("a range without end", |ray, c, r, m| {
        first(
            half_roots,
            &ray.within(ray.range.min, f32::INFINITY),
            c,
            r,
            m,
        )
    }),
    ("hits behind", |ray, c, r, m| {
        first(
            half_roots,
            &ray.within(f32::NEG_INFINITY, ray.range.max),
            c,
            r,
            m,
        )
    }),
    (
        "the near root's point with the far root's t",
        |ray, c, r, m| {
            let [near, _] = half_roots(ray, c, r);
            let trace = first(half_roots, ray, c, r, m)?;
            Some(Trace {
                distance: near,
                ..trace
            })
        },
    ),
    (
        "uv of a direction that is not of length one",
        |ray, c, r, m| sphere_but(ray, c, r, m, |trace| trace.uv = uv(trace.position - c)),
    ),
    ("uv of the position", |ray, c, r, m| {
        sphere_but(ray, c, r, m, |trace| {
            trace.uv = uv(trace.position.normalize())
        })
    }),
    ("a normal as long as the radius", |ray, c, r, m| {
        sphere_but(ray, c, r, m, |trace| trace.normal = trace.position - c)
    }),
    ("flips the normal", |ray, c, r, m| {
        sphere_but(ray, c, r, m, |trace| {
            if trace.normal.dot(ray.dir) > 0.0 {
                trace.normal = -trace.normal;
            }
        })
    }),
    ("a position relative to the centre", |ray, c, r, m| {
        sphere_but(ray, c, r, m, |trace| trace.position -= c)
    }),
    ("an origin relative to the centre", |ray, c, r, m| {
        sphere_but(ray, c, r, m, |trace| trace.origin -= c)
    }),
    ("a radius that is not squared", |ray, c, r, m| {
        first(half_roots, ray, c, r.sqrt(), m)
    }),
    ("no material", |ray, c, r, m| {
        sphere_but(ray, c, r, m, |trace| trace.material = 0)
    }),
];
