//! Mirrors and glass. Directions are in the surface's frame. The normal of glass points out of the
//! glass, and the index of refraction outside is 1.

use glam::{DVec2, DVec3};

use super::Scattered64;

/// Mirrors a direction about the normal: the parts along the normal are equal, and the parts across
/// it are opposite.
pub fn reflect(out: DVec3) -> DVec3 {
    2.0 * out.dot(DVec3::Z) * DVec3::Z - out
}

/// Returns the direction on the other side of the surface, or `None` for total reflection.
///
/// Computed from the angles to the normal by Snell's law: η₁ sin θ₁ = η₂ sin θ₂. Both directions
/// are in one plane with the normal, on opposite sides of it.
pub fn refract(out: DVec3, ior: f64) -> Option<DVec3> {
    let (_, theta) = angles(out, ior)?;
    let (sine, cosine) = libm::sincos(theta);
    let across = DVec2::new(out.x, out.y).normalize_or_zero();
    Some((-sine * across).extend(-cosine.copysign(out.z)))
}

/// Returns the fraction of unpolarised light that is reflected, which is 1 for total reflection.
///
/// Computed by Fresnel's sine and tangent laws (Born and Wolf, *Principles of Optics*, section
/// 1.5.2): the amplitudes of the two polarisations are sin(θ₁ − θ₂) / sin(θ₁ + θ₂) and
/// tan(θ₁ − θ₂) / tan(θ₁ + θ₂).
pub fn fresnel(out: DVec3, ior: f64) -> f64 {
    /// Below this angle, both laws are replaced by their limit. The error is of the order of the
    /// squared angle.
    const SMALL: f64 = 1e-5;
    let Some((near, far)) = angles(out, ior) else {
        return 1.0;
    };
    if near < SMALL {
        let limit = (ior - 1.0) / (ior + 1.0);
        return limit * limit;
    }
    let sines = libm::sin(near - far) / libm::sin(near + far);
    let tangents = libm::tan(near - far) / libm::tan(near + far);
    0.5 * (sines * sines + tangents * tangents)
}

/// Returns the reflected path of a mirror.
pub fn mirror_scatter(reflectance: DVec3, out: DVec3) -> Scattered64 {
    Scattered64 {
        direction: reflect(out),
        attenuation: reflectance,
        pdf: None,
    }
}

/// Returns the continuation of a path at the surface of glass. It is reflected if `random` is less
/// than [`fresnel`], and refracted otherwise.
///
/// Radiance divided by the squared index of refraction is constant along a ray (Born and Wolf,
/// section 3.1.2), so the attenuation of a refracted path is the squared index on the side of `out`
/// divided by the squared index on the other side.
pub fn glass_scatter(ior: f64, out: DVec3, random: f64) -> Scattered64 {
    let (direction, attenuation) = match refract(out, ior) {
        Some(refracted) if fresnel(out, ior) <= random => {
            let (near, far) = indices(out, ior);
            (refracted, (near * near) / (far * far))
        }
        Some(_) | None => (reflect(out), 1.0),
    };
    Scattered64 {
        direction,
        attenuation: DVec3::splat(attenuation),
        pdf: None,
    }
}

/// Returns how far the cosine of a direction is from that of the critical angle, or infinity if
/// there is no total reflection on this side.
pub fn critical_margin(out: DVec3, ior: f64) -> f64 {
    let (near, far) = indices(out, ior);
    if near <= far {
        return f64::INFINITY;
    }
    let critical = libm::cos(libm::asin(far / near));
    (out.z.abs() - critical).abs()
}

/// Returns the margin of [`glass_scatter`]: how far the direction is from the surface itself and
/// from the critical angle, and how far `random` is from the reflected fraction, whichever is less.
/// For total reflection, `random` doesn't matter.
pub fn glass_margin(ior: f64, out: DVec3, random: f64) -> f64 {
    let to_fraction = match refract(out, ior) {
        Some(_) => (random - fresnel(out, ior)).abs(),
        None => f64::INFINITY,
    };
    to_fraction.min(critical_margin(out, ior)).min(out.z.abs())
}

/// Returns the indices of refraction on the side of `out` and on the other side.
fn indices(out: DVec3, ior: f64) -> (f64, f64) {
    if out.z > 0.0 { (1.0, ior) } else { (ior, 1.0) }
}

/// Returns the angles to the normal on the side of `out` and on the other side, or `None` for total
/// reflection.
fn angles(out: DVec3, ior: f64) -> Option<(f64, f64)> {
    let (near, far) = indices(out, ior);
    let theta = libm::atan2(libm::hypot(out.x, out.y), out.z.abs());
    let sine = near * libm::sin(theta) / far;
    (sine < 1.0).then(|| (theta, libm::asin(sine)))
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;

    /// Returns directions on both sides of the surface.
    fn directions() -> impl Iterator<Item = DVec3> {
        let above = (0..40).map(|n| {
            let (theta, phi) = (0.039 * f64::from(n), 0.7 * f64::from(n));
            let (sine, cosine) = libm::sincos(theta);
            dvec3(sine * libm::cos(phi), sine * libm::sin(phi), cosine)
        });
        above.flat_map(|out| [out, -out])
    }

    const INDICES: [f64; 5] = [0.6, 1.0, 1.33, 1.5, 2.4];

    #[test]
    fn a_reversed_ray_comes_back_with_the_same_reflected_fraction() {
        for (out, ior) in directions().flat_map(|out| INDICES.map(|ior| (out, ior))) {
            assert!(reflect(reflect(out)).abs_diff_eq(out, 1e-15));
            let Some(refracted) = refract(out, ior) else {
                assert_eq!(fresnel(out, ior), 1.0);
                continue;
            };
            assert!(refracted.is_normalized() && refracted.z * out.z < 0.0);
            let back = refract(refracted, ior).expect("the ray comes back");
            assert!(back.abs_diff_eq(out, 1e-9), "{out} {ior}: {back}");
            let [there, back] = [out, refracted].map(|direction| fresnel(direction, ior));
            assert!((there - back).abs() < 1e-9, "{out} {ior}: {there} {back}");
        }
    }

    #[test]
    fn an_index_of_one_changes_nothing() {
        for out in directions() {
            let straight = refract(out, 1.0).expect("nothing is reflected");
            assert!(straight.abs_diff_eq(-out, 1e-14));
            assert!(fresnel(out, 1.0) < 1e-20);
        }
    }

    #[test]
    fn reflected_fractions_match_known_values() {
        assert!((fresnel(DVec3::Z, 1.5) - 0.04).abs() < 1e-15);
        // On both sides of the limit for small angles.
        let slightly_off = dvec3(2e-5, 0.0, 1.0).normalize();
        assert!((fresnel(slightly_off, 1.5) - 0.04).abs() < 1e-9);
        // At Brewster's angle, whose tangent is the index, only one polarisation is reflected.
        let brewster = dvec3(1.5, 0.0, 1.0).normalize();
        let sines = (1.5_f64.powi(2) - 1.0) / (1.5_f64.powi(2) + 1.0);
        assert!((fresnel(brewster, 1.5) - 0.5 * sines * sines).abs() < 1e-14);
    }

    #[test]
    fn no_light_is_lost_at_the_surface() {
        // Radiance is multiplied by the attenuation, and the beam's projected solid angle changes
        // by the inverse factor. So a path that enters and leaves has an attenuation of 1.
        for (out, ior) in directions().flat_map(|out| INDICES.map(|ior| (out, ior))) {
            let entered = glass_scatter(ior, out, 0.999_999);
            if entered.direction.z * out.z > 0.0 {
                assert_eq!(entered.attenuation, DVec3::ONE);
                continue;
            }
            let left = glass_scatter(ior, entered.direction, 0.999_999);
            let product = entered.attenuation * left.attenuation;
            assert!(product.abs_diff_eq(DVec3::ONE, 1e-15), "{out} {ior}");
        }
    }

    #[test]
    fn margins_are_distances_to_the_decisions() {
        assert!((glass_margin(1.5, DVec3::Z, 0.05) - 0.01).abs() < 1e-14);
        assert_eq!(critical_margin(DVec3::Z, 1.5), f64::INFINITY);
        let critical = libm::sqrt(1.0 - 1.0 / 2.25);
        let inside = dvec3(libm::sqrt(1.0 - 0.49), 0.0, -0.7);
        assert!((critical_margin(inside, 1.5) - (critical - 0.7).abs()).abs() < 1e-14);
        assert_eq!(refract(inside, 1.5), None);
        assert!((glass_margin(1.5, inside, 0.999) - (critical - 0.7).abs()).abs() < 1e-14);
    }
}
