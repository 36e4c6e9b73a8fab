//! Triangles in single precision: several right formulas, and wrong ones.

use glam::{Vec3, vec2};
use protocol::{Ray, Trace, Vertex};

pub type TriangleHit = fn(&Ray, &[Vertex; 3], u32) -> Option<Trace>;

/// What a formula finds: t and the weights of the corners.
type Solution = (f32, [f32; 3]);

fn traced(ray: &Ray, v: &[Vertex; 3], material: u32, (t, w): Solution) -> Trace {
    Trace {
        distance: t,
        position: ray.at(t),
        normal: w[0] * v[0].normal + w[1] * v[1].normal + w[2] * v[2].normal,
        uv: w[0] * v[0].uv + w[1] * v[1].uv + w[2] * v[2].uv,
        origin: ray.origin,
        material,
    }
}

fn positions(v: &[Vertex; 3]) -> [Vec3; 3] {
    v.map(|vertex| vertex.position)
}

/// Cramer's rule as on the slides.
fn cramer(ray: &Ray, v: &[Vertex; 3]) -> Option<Solution> {
    let [p0, p1, p2] = positions(v);
    let (e1, e2, s) = (p1 - p0, p2 - p0, ray.origin - p0);
    let determinant = e1.cross(ray.dir).dot(e2);
    let u = -s.cross(e2).dot(ray.dir) / determinant;
    let v = e1.cross(ray.dir).dot(s) / determinant;
    let t = -s.cross(e2).dot(e1) / determinant;
    (determinant != 0.0).then_some((t, [1.0 - u - v, u, v]))
}

/// Möller and Trumbore's own order.
fn moeller_trumbore(ray: &Ray, v: &[Vertex; 3]) -> Option<Solution> {
    let [p0, p1, p2] = positions(v);
    let (e1, e2) = (p1 - p0, p2 - p0);
    let p = ray.dir.cross(e2);
    let inverse = 1.0 / e1.dot(p);
    let s = ray.origin - p0;
    let u = s.dot(p) * inverse;
    let q = s.cross(e1);
    let v = ray.dir.dot(q) * inverse;
    let t = e2.dot(q) * inverse;
    inverse.is_finite().then_some((t, [1.0 - u - v, u, v]))
}

/// The plane, then areas.
fn areas(ray: &Ray, v: &[Vertex; 3]) -> Option<Solution> {
    let [p0, p1, p2] = positions(v);
    let normal = (p1 - p0).cross(p2 - p0);
    let t = normal.dot(p0 - ray.origin) / normal.dot(ray.dir);
    let p = ray.at(t);
    let part = |a: Vec3, b: Vec3| (a - p).cross(b - p).dot(normal) / normal.length_squared();
    t.is_finite()
        .then_some((t, [part(p1, p2), part(p2, p0), part(p0, p1)]))
}

fn inside(ray: &Ray, (t, w): Solution) -> bool {
    w.iter().all(|w| *w >= 0.0) && ray.range.contains(t)
}

fn by(
    formula: fn(&Ray, &[Vertex; 3]) -> Option<Solution>,
    ray: &Ray,
    v: &[Vertex; 3],
    m: u32,
) -> Option<Trace> {
    let found = formula(ray, v).filter(|found| inside(ray, *found))?;
    Some(traced(ray, v, m, found))
}

pub const TRIANGLES: [(&str, TriangleHit); 3] = [
    ("Cramer's rule", |ray, v, m| by(cramer, ray, v, m)),
    ("Möller and Trumbore", |ray, v, m| {
        by(moeller_trumbore, ray, v, m)
    }),
    ("areas", |ray, v, m| by(areas, ray, v, m)),
];

/// Changes the right answer.
fn but(ray: &Ray, v: &[Vertex; 3], m: u32, change: impl FnOnce(&mut Trace)) -> Option<Trace> {
    let mut trace = by(cramer, ray, v, m)?;
    change(&mut trace);
    Some(trace)
}

pub const WRONG_TRIANGLES: [(&str, TriangleHit); 16] = [
    ("never", |_, _, _| None),
    ("no inside test", |ray, v, m| {
        let found = cramer(ray, v).filter(|(t, _)| ray.range.contains(*t))?;
        Some(traced(ray, v, m, found))
    }),
    ("only u and v are tested", |ray, v, m| {
        let (t, w) = cramer(ray, v)?;
        let inside = w[1] >= 0.0 && w[2] >= 0.0 && ray.range.contains(t);
        inside.then(|| traced(ray, v, m, (t, w)))
    }),
    ("a parallelogram", |ray, v, m| {
        let (t, w) = cramer(ray, v)?;
        let square = (0.0..=1.0).contains(&w[1]) && (0.0..=1.0).contains(&w[2]);
        (square && ray.range.contains(t)).then(|| traced(ray, v, m, (t, w)))
    }),
    ("weights in another order", |ray, v, m| {
        let (t, w) = cramer(ray, v).filter(|found| inside(ray, *found))?;
        Some(traced(ray, v, m, (t, [w[1], w[2], w[0]])))
    }),
    ("u and v swapped", |ray, v, m| {
        let (t, w) = cramer(ray, v).filter(|found| inside(ray, *found))?;
        Some(traced(ray, v, m, (t, [w[0], w[2], w[1]])))
    }),
    ("the face's normal", |ray, v, m| {
        let [p0, p1, p2] = positions(v);
        but(ray, v, m, |trace| trace.normal = (p1 - p0).cross(p2 - p0))
    }),
    ("flips the normal", |ray, v, m| {
        but(ray, v, m, |trace| {
            if trace.normal.dot(ray.dir) > 0.0 {
                trace.normal = -trace.normal;
            }
        })
    }),
    ("barycentrics for uv", |ray, v, m| {
        let (t, w) = cramer(ray, v).filter(|found| inside(ray, *found))?;
        let uv = vec2(w[1], w[2]);
        Some(Trace {
            uv,
            ..traced(ray, v, m, (t, w))
        })
    }),
    ("culls back faces", |ray, v, m| {
        let [p0, p1, p2] = positions(v);
        let front = (p1 - p0).cross(p2 - p0).dot(ray.dir) < 0.0;
        by(cramer, ray, v, m).filter(|_| front)
    }),
    ("a cutoff of 1e-5", |ray, v, m| {
        let [p0, p1, p2] = positions(v);
        let determinant = (p1 - p0).cross(ray.dir).dot(p2 - p0);
        by(cramer, ray, v, m).filter(|_| determinant.abs() > 1e-5)
    }),
    ("ignores the range's start", |ray, v, m| {
        by(cramer, &ray.within(0.0, ray.range.max), v, m)
    }),
    ("ignores the range's end", |ray, v, m| {
        by(cramer, &ray.within(ray.range.min, f32::INFINITY), v, m)
    }),
    ("hits behind", |ray, v, m| {
        by(cramer, &ray.within(f32::NEG_INFINITY, ray.range.max), v, m)
    }),
    ("no material", |ray, v, m| {
        but(ray, v, m, |trace| trace.material = 0)
    }),
    ("the position for the origin", |ray, v, m| {
        but(ray, v, m, |trace| trace.origin = trace.position)
    }),
];
