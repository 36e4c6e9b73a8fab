// Snell's law and reflection with vectors and a normal on the side of `out`, as for surfaces that
// have no frame of their own.

pub fn reflect(out: Vec3) -> Vec3 {
    2.0 * out.dot(Vec3::Z) * Vec3::Z - out
}

pub fn refract(out: Vec3, ior: f32) -> Option<Vec3> {
    let (normal, ratio) = if out.z > 0.0 {
        (Vec3::Z, 1.0 / ior)
    } else {
        (Vec3::NEG_Z, ior)
    };
    let cosine = out.dot(normal);
    let along = ratio * (cosine * normal - out);
    let squared = 1.0 - along.length_squared();
    (squared > 0.0).then(|| (along - squared.sqrt() * normal).normalize())
}

pub fn fresnel(out: Vec3, ior: f32) -> f32 {
    let (near, far) = if out.z > 0.0 { (1.0, ior) } else { (ior, 1.0) };
    match refract(out, ior) {
        None => 1.0,
        Some(refracted) => {
            let (cos_near, cos_far) = (out.z.abs(), refracted.z.abs());
            let s = (near * cos_near - far * cos_far) / (near * cos_near + far * cos_far);
            let p = (far * cos_near - near * cos_far) / (far * cos_near + near * cos_far);
            (s * s + p * p) / 2.0
        }
    }
}

impl Mirror {
    pub fn scatter(&self, out: Vec3) -> Scattered {
        let (direction, attenuation) = (reflect(out), self.reflectance);
        Scattered {
            direction,
            attenuation,
            pdf: None,
        }
    }
}

impl Glass {
    pub fn scatter(&self, out: Vec3, random: f32) -> Scattered {
        let (direction, factor) = match refract(out, self.ior) {
            Some(refracted) if random >= fresnel(out, self.ior) => {
                let ratio = if out.z > 0.0 {
                    1.0
                } else {
                    self.ior * self.ior
                };
                let other = if out.z > 0.0 {
                    self.ior * self.ior
                } else {
                    1.0
                };
                (refracted, ratio / other)
            }
            _ => (reflect(out), 1.0),
        };
        Scattered {
            direction,
            attenuation: Vec3::splat(factor),
            pdf: None,
        }
    }
}
