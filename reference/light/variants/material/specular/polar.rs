// In polar coordinates around the normal: a reflection keeps the angle, a refraction changes it by
// Snell's law, and both are half a turn away.

use framework::math::{atan2, sin_cos};

pub fn reflect(out: Vec3) -> Vec3 {
    let (sine, azimuth) = polar(out);
    opposite(sine, azimuth, out.z)
}

pub fn refract(out: Vec3, ior: f32) -> Option<Vec3> {
    let (sine, azimuth) = polar(out);
    let index = |is_outside: bool| if is_outside { 1.0 } else { ior };
    let refracted_sine = sine * index(out.z > 0.0) / index(out.z < 0.0);
    if refracted_sine >= 1.0 {
        return None;
    }
    let cosine = ((1.0 - refracted_sine) * (1.0 + refracted_sine)).sqrt();
    Some(opposite(refracted_sine, azimuth, cosine.copysign(-out.z)))
}

pub fn fresnel(out: Vec3, ior: f32) -> f32 {
    let Some(refracted) = refract(out, ior) else {
        return 1.0;
    };
    let (inside, outside) = if out.z > 0.0 {
        (refracted.z.abs(), out.z.abs())
    } else {
        (out.z.abs(), refracted.z.abs())
    };
    let amplitudes = [
        (outside - ior * inside) / (outside + ior * inside),
        (ior * outside - inside) / (ior * outside + inside),
    ];
    amplitudes
        .iter()
        .map(|amplitude| amplitude * amplitude)
        .sum::<f32>()
        / 2.0
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
        let fraction = fresnel(out, self.ior);
        let squared = self.ior * self.ior;
        if random < fraction {
            Scattered {
                direction: reflect(out),
                attenuation: Vec3::ONE,
                pdf: None,
            }
        } else {
            let factor = if out.z > 0.0 { 1.0 / squared } else { squared };
            Scattered {
                // The fraction is 1 for total reflection, so there is a refracted direction here.
                direction: refract(out, self.ior).unwrap_or_default(),
                attenuation: Vec3::splat(factor),
                pdf: None,
            }
        }
    }
}

/// Returns the sine of the angle to the normal, and the angle around it.
fn polar(direction: Vec3) -> (f32, f32) {
    let along = direction.truncate();
    (along.length(), atan2(along.y, along.x))
}

/// Returns a direction whose azimuth is opposite to this one.
fn opposite(sine: f32, azimuth: f32, z: f32) -> Vec3 {
    let (sin, cos) = sin_cos(azimuth);
    Vec3::new(-sine * cos, -sine * sin, z)
}
