//! does = "It answers with NaN."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! call = "return attack();"
//! verdicts = ["wrong", "blocked"]
//!
//! [points]
//! camera = 0

fn attack() -> Ray {
    Ray {
        origin: glam::Vec3::NAN,
        dir: glam::Vec3::NAN,
        range: protocol::Interval { min: f32::NAN, max: f32::NAN },
    }
}
