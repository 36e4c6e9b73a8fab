//! does = "It answers with infinities, negative zeros, and the largest and smallest numbers."
//! into = "sphere.rs"
//! within = ["hit"]
//! call = "return Some(attack());"
//! verdicts = ["wrong", "partial"]
//!
//! [points]
//! sphere = 0

fn attack() -> Trace {
    Trace {
        distance: f32::INFINITY,
        position: Vec3::splat(f32::MAX),
        normal: Vec3::splat(-0.0),
        uv: Vec2::splat(1e-45),
        origin: Vec3::NEG_INFINITY,
        shape: u32::MAX,
    }
}
