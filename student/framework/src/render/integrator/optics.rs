//! Reflection and refraction, for mirrors and glass.

use glam::Vec3;

/// Reflects a direction. `normal` must have length one and can point to either side.
pub(super) fn reflect(direction: Vec3, normal: Vec3) -> Vec3 {
    direction - 2.0 * direction.dot(normal) * normal
}

/// The reflection and refraction of a ray at an interface between two dielectrics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interface {
    /// The fraction of light that is reflected.
    pub(super) reflectance: f32,
    /// The direction of the refracted light, or `None` for total internal reflection.
    pub(super) refracted: Option<Vec3>,
}

/// Computes reflection and refraction by the Fresnel equations for unpolarised light and Snell's
/// law. See Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th edition, section 9.3.
///
/// `direction` and `normal` must have length one, and the normal must point against the direction.
/// `eta` is the index of refraction behind the interface divided by the index in front of it.
pub(super) fn interface(direction: Vec3, normal: Vec3, eta: f32) -> Interface {
    let cos_before = -direction.dot(normal);
    let sin_squared = (1.0 - cos_before * cos_before).max(0.0) / (eta * eta);
    if sin_squared >= 1.0 {
        return Interface {
            reflectance: 1.0,
            refracted: None,
        };
    }
    let cos_behind = (1.0 - sin_squared).sqrt();
    let parallel = (eta * cos_before - cos_behind) / (eta * cos_before + cos_behind);
    let perpendicular = (cos_before - eta * cos_behind) / (cos_before + eta * cos_behind);
    let refracted = direction / eta + (cos_before / eta - cos_behind) * normal;
    Interface {
        reflectance: 0.5 * (parallel * parallel + perpendicular * perpendicular),
        refracted: Some(refracted.normalize()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slanted(sine: f32) -> Vec3 {
        Vec3::new(sine, -(1.0 - sine * sine).sqrt(), 0.0)
    }

    #[test]
    fn at_normal_incidence_glass_reflects_four_percent() {
        for eta in [1.5, 1.0 / 1.5] {
            let glass = interface(Vec3::NEG_Y, Vec3::Y, eta);
            assert!((glass.reflectance - 0.04).abs() < 1e-6, "{glass:?}");
            assert_eq!(glass.refracted, Some(Vec3::NEG_Y));
        }
    }

    #[test]
    fn refraction_follows_snells_law() {
        let glass = interface(slanted(0.6), Vec3::Y, 1.5);
        let refracted = glass.refracted.expect("light can always enter glass");
        assert!((refracted.x - 0.4).abs() < 1e-6, "{refracted}");
        assert!(refracted.is_normalized() && refracted.y < 0.0);
    }

    #[test]
    fn beyond_the_critical_angle_all_light_is_reflected() {
        let glass = interface(slanted(0.7), Vec3::Y, 1.0 / 1.5);
        assert_eq!((glass.reflectance, glass.refracted), (1.0, None));
        assert!(
            interface(slanted(0.6), Vec3::Y, 1.0 / 1.5)
                .refracted
                .is_some()
        );
    }

    #[test]
    fn reflection_reverses_the_component_along_the_normal() {
        let mirrored = reflect(slanted(0.6), Vec3::Y);
        assert!(
            mirrored.abs_diff_eq(Vec3::new(0.6, 0.8, 0.0), 1e-6),
            "{mirrored}"
        );
        assert_eq!(mirrored, reflect(slanted(0.6), Vec3::NEG_Y));
    }
}
