// Handles only the outside. From inside, the surface is turned over: the other side has the index
// 1 / ior, seen from there.

pub fn reflect(out: Vec3) -> Vec3 {
    out * Vec3::new(-1.0, -1.0, 1.0)
}

pub fn refract(out: Vec3, ior: f32) -> Option<Vec3> {
    if out.z < 0.0 {
        return refract(turned(out), 1.0 / ior).map(turned);
    }
    let sine_squared = (1.0 - out.z * out.z) / (ior * ior);
    let cosine = (sine_squared < 1.0).then(|| (1.0 - sine_squared).sqrt())?;
    let refracted = Vec3::new(-out.x / ior, -out.y / ior, -cosine);
    Some(refracted / refracted.length())
}

pub fn fresnel(out: Vec3, ior: f32) -> f32 {
    if out.z < 0.0 {
        return fresnel(turned(out), 1.0 / ior);
    }
    let far = match refract(out, ior) {
        Some(refracted) => -refracted.z,
        None => return 1.0,
    };
    let parallel = (ior * out.z - far) / (ior * out.z + far);
    let perpendicular = (out.z - ior * far) / (out.z + ior * far);
    (parallel.powi(2) + perpendicular.powi(2)) * 0.5
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
        if out.z < 0.0 {
            let inverse = Glass {
                ior: 1.0 / self.ior,
            };
            let scattered = inverse.scatter(turned(out), random);
            return Scattered {
                direction: turned(scattered.direction),
                ..scattered
            };
        }
        let reflected = Scattered {
            direction: reflect(out),
            attenuation: Vec3::ONE,
            pdf: None,
        };
        if random < fresnel(out, self.ior) {
            return reflected;
        }
        refract(out, self.ior).map_or(reflected, |direction| Scattered {
            direction,
            attenuation: Vec3::splat(1.0 / (self.ior * self.ior)),
            pdf: None,
        })
    }
}

/// Mirrors a direction about the surface.
fn turned(direction: Vec3) -> Vec3 {
    Vec3::new(direction.x, direction.y, -direction.z)
}
