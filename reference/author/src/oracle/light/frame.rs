//! The frame of a surface, in which +z is the normal.

use glam::DVec3;

/// Three perpendicular unit vectors.
#[derive(Clone, Copy, Debug)]
pub struct Frame64 {
    axes: [DVec3; 3],
}

impl Frame64 {
    /// Creates the frame around a normal that Duff et al. define in "Building an Orthonormal Basis,
    /// Revisited", JCGT 6(1), 2017. Here, it is computed as a rotation by the smallest angle, which
    /// takes the nearer of ±z to the normal. If that is −z, the frame's y-axis is reversed, so that
    /// the frame stays right-handed.
    ///
    /// The sign of z counts even if z is zero: the normals (1, 0, 0) and (1, 0, −0) have different
    /// frames.
    pub fn around(normal: DVec3) -> Frame64 {
        let sign = 1.0_f64.copysign(normal.z);
        let pole = sign * DVec3::Z;
        // The axis of the half-turn that takes the pole to the normal is halfway between them. A
        // vector perpendicular to the pole is first reversed by the half-turn around the pole.
        let halfway = (normal + pole).normalize();
        let rotate = |v: DVec3| v - 2.0 * halfway * halfway.dot(v);
        Frame64 {
            axes: [rotate(DVec3::X), sign * rotate(DVec3::Y), normal],
        }
    }

    /// Converts a direction from this frame to world space.
    pub fn to_world(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        v.x * x + v.y * y + v.z * z
    }

    /// Converts a direction from world space to this frame.
    pub fn to_local(&self, v: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(v)))
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;

    #[test]
    fn the_frame_is_right_handed_around_any_normal() {
        let slanted = dvec3(1.0, -2.0, -3.0).normalize();
        for normal in [
            DVec3::Z,
            DVec3::NEG_Z,
            DVec3::X,
            DVec3::NEG_Y,
            slanted,
            -slanted,
        ] {
            let Frame64 { axes: [x, y, z] } = Frame64::around(normal);
            assert!(x.cross(y).abs_diff_eq(z, 1e-15), "{normal}");
            assert!(x.dot(y).abs() < 1e-15 && x.is_normalized(), "{normal}");
            assert_eq!(z, normal);
        }
    }

    #[test]
    fn axes_match_the_published_formula() {
        let z = dvec3(2.0, -1.0, 2.0) / 3.0;
        for z in [z, -z, DVec3::X, dvec3(1.0, 0.0, -0.0)] {
            let sign = 1.0_f64.copysign(z.z);
            let a = -1.0 / (sign + z.z);
            let b = z.x * z.y * a;
            let x = dvec3(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x);
            let y = dvec3(b, sign + z.y * z.y * a, -z.y);
            let frame = Frame64::around(z);
            assert!(frame.axes[0].abs_diff_eq(x, 1e-15), "{z}");
            assert!(frame.axes[1].abs_diff_eq(y, 1e-15), "{z}");
        }
    }

    #[test]
    fn conversions_are_inverse() {
        let frame = Frame64::around(dvec3(0.6, 0.0, -0.8));
        let v = dvec3(0.1, 0.2, 0.3);
        assert!(frame.to_local(frame.to_world(v)).abs_diff_eq(v, 1e-15));
    }
}
