
fn attack() -> Ray {
    Ray {
        origin: glam::Vec3::NAN,
        dir: glam::Vec3::NAN,
        range: protocol::Interval { min: f32::NAN, max: f32::NAN },
    }
}
