//! Mirrors and glass.

use glam::Vec3;

/// The mirror image of a direction. `normal` has length one and may point to either side.
pub(super) fn reflect(direction: Vec3, normal: Vec3) -> Vec3 {
    direction - 2.0 * direction.dot(normal) * normal
}

/// What an interface between two clear media does with a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interface {
    /// The share of light that is reflected.
    pub(super) reflectance: f32,
    /// Where the rest goes; `None` if there is no rest: total reflection.
    pub(super) refracted: Option<Vec3>,
}

/// An interface, after Fresnel for unpolarised light and Snell; Pharr, Jakob and Humphreys,
/// "Physically Based Rendering", 4th edition, section 9.3.
///
/// `direction` and `normal` have length one, and the normal points against the direction. `eta` is
/// the index of refraction behind the interface, divided by the one before it.
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
    fn head_on_glass_reflects_one_part_in_twenty_five() {
        for eta in [1.5, 1.0 / 1.5] {
            let met = interface(Vec3::NEG_Y, Vec3::Y, eta);
            assert!((met.reflectance - 0.04).abs() < 1e-6, "{met:?}");
            assert_eq!(met.refracted, Some(Vec3::NEG_Y));
        }
    }

    #[test]
    fn light_bends_by_snells_law() {
        let met = interface(slanted(0.6), Vec3::Y, 1.5);
        let refracted = met.refracted.expect("into glass there is always a way");
        assert!((refracted.x - 0.4).abs() < 1e-6, "{refracted}");
        assert!(refracted.is_normalized() && refracted.y < 0.0);
    }

    #[test]
    fn beyond_the_critical_angle_all_is_reflected() {
        let met = interface(slanted(0.7), Vec3::Y, 1.0 / 1.5);
        assert_eq!((met.reflectance, met.refracted), (1.0, None));
        assert!(
            interface(slanted(0.6), Vec3::Y, 1.0 / 1.5)
                .refracted
                .is_some()
        );
    }

    #[test]
    fn a_mirror_turns_what_is_along_the_normal() {
        let mirrored = reflect(slanted(0.6), Vec3::Y);
        assert!(
            mirrored.abs_diff_eq(Vec3::new(0.6, 0.8, 0.0), 1e-6),
            "{mirrored}"
        );
        assert_eq!(mirrored, reflect(slanted(0.6), Vec3::NEG_Y));
    }
}
