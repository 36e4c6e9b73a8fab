// In double precision.

use glam::DVec3;

pub fn reflect(out: Vec3) -> Vec3 {
    Vec3::new(-out.x, -out.y, out.z)
}

pub fn refract(out: Vec3, ior: f32) -> Option<Vec3> {
    let (out, ratio) = prepared(out, ior);
    let refracted = refract_precisely(out, ratio)?;
    Some(refracted.as_vec3())
}

pub fn fresnel(out: Vec3, ior: f32) -> f32 {
    let (out, ratio) = prepared(out, ior);
    let Some(refracted) = refract_precisely(out, ratio) else {
        return 1.0;
    };
    let (near, far) = (out.z.abs(), refracted.z.abs());
    let square = |a: f64, b: f64| ((a - b) / (a + b)).powi(2);
    (0.5 * (square(ratio * near, far) + square(near, ratio * far))) as f32
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
        let mut scattered = Scattered {
            direction: reflect(out),
            attenuation: Vec3::ONE,
            pdf: None,
        };
        if random >= fresnel(out, self.ior)
            && let Some(refracted) = refract(out, self.ior)
        {
            let (_, ratio) = prepared(out, self.ior);
            scattered.direction = refracted;
            scattered.attenuation = Vec3::splat((ratio * ratio) as f32);
        }
        scattered
    }
}

/// Returns the direction with length one, and the ratio of the index on its side to the other one.
fn prepared(out: Vec3, ior: f32) -> (DVec3, f64) {
    let ior = f64::from(ior);
    let ratio = if out.z > 0.0 { 1.0 / ior } else { ior };
    (out.as_dvec3().normalize(), ratio)
}

fn refract_precisely(out: DVec3, ratio: f64) -> Option<DVec3> {
    let along = -ratio * out.truncate();
    let squared = 1.0 - along.length_squared();
    (squared > 0.0).then(|| along.extend(-squared.sqrt().copysign(out.z)))
}
