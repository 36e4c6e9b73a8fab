// The Fresnel equations in the form with sines and tangents of the sum and the difference of both
// angles. Along the normal, both are 0 / 0, so the indices themselves decide.

use framework::math::{atan2, sin_cos, tan};

pub fn reflect(out: Vec3) -> Vec3 {
    (-out.truncate()).extend(out.z)
}

pub fn refract(out: Vec3, ior: f32) -> Option<Vec3> {
    let ratio = ratio(out, ior);
    let along = -ratio * out.truncate();
    let height = 1.0 - along.length_squared();
    if height <= 0.0 {
        return None;
    }
    Some(along.extend(-out.z.signum() * height.sqrt()).normalize())
}

pub fn fresnel(out: Vec3, ior: f32) -> f32 {
    let Some(refracted) = refract(out, ior) else {
        return 1.0;
    };
    if ior == 1.0 {
        return 0.0;
    }
    let angle = |v: Vec3| atan2(v.truncate().length(), v.z.abs());
    let (theta, other) = (angle(out), angle(refracted));
    if theta < 0.01 {
        let amplitude = (ior - 1.0) / (ior + 1.0);
        return amplitude * amplitude;
    }
    let perpendicular = sin_cos(theta - other).0 / sin_cos(theta + other).0;
    let parallel = tan(theta - other) / tan(theta + other);
    0.5 * (perpendicular * perpendicular + parallel * parallel)
}

impl Mirror {
    pub fn scatter(&self, out: Vec3) -> Scattered {
        Scattered {
            direction: reflect(out),
            attenuation: self.reflectance,
            pdf: None,
        }
    }
}

impl Glass {
    pub fn scatter(&self, out: Vec3, random: f32) -> Scattered {
        let is_reflected = random < fresnel(out, self.ior);
        let refracted = refract(out, self.ior);
        let ratio = ratio(out, self.ior);
        let choice = if is_reflected { None } else { refracted };
        Scattered {
            direction: choice.unwrap_or_else(|| reflect(out)),
            attenuation: choice.map_or(Vec3::ONE, |_| Vec3::ONE * ratio * ratio),
            pdf: None,
        }
    }
}

/// Returns the index on the side of `out` divided by the one on the other side.
fn ratio(out: Vec3, ior: f32) -> f32 {
    if out.z > 0.0 { ior.recip() } else { ior }
}
