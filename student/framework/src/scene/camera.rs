//! Reads the camera of a scene file, and places it in the scene.

use glam::{Mat3, UVec2, Vec3};
use protocol::{PinholeCamera, Ray};
use serde::Deserialize;

use super::{MAX_FILM_SIDE, number};

/// A camera and its position in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "CameraEntry")]
pub struct Camera {
    /// The parameters of the submission's `Camera`.
    pub pinhole: PinholeCamera,
    /// The transformation from camera space to world space.
    pub placement: Placement,
    /// Whether the scene file sets the aspect ratio of the sensor. If not, the aspect ratio of the
    /// film is used.
    pub fixed_aspect: bool,
}

/// A transformation from camera space to world space: a rotation, then a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The position of the camera in world space.
    pub position: Vec3,
    /// The camera's x-, y- and z-axes in world space, as columns. The camera looks along −z, with y
    /// up.
    pub axes: Mat3,
}

impl Camera {
    /// Implements [`Scene::on_film`](super::Scene::on_film).
    pub(super) fn on_film(self, film: UVec2) -> Camera {
        let aspect_ratio = if self.fixed_aspect {
            self.pinhole.aspect_ratio
        } else {
            aspect_of(film)
        };
        Camera {
            pinhole: PinholeCamera {
                aspect_ratio,
                film,
                ..self.pinhole
            },
            ..self
        }
    }
}

impl Placement {
    /// Transforms a ray from camera space to world space. The length of its direction is unchanged.
    pub fn to_world(&self, ray: &Ray) -> Ray {
        Ray {
            origin: self.position + self.axes * ray.origin,
            dir: self.axes * ray.dir,
            range: ray.range,
        }
    }
}

/// The entry `camera` of a scene file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraEntry {
    /// The full vertical field of view, in degrees.
    #[serde(deserialize_with = "number::positive")]
    vertical_fov: f32,
    /// The number of pixels, across and up.
    #[serde(deserialize_with = "number::film")]
    film: [u32; 2],
    /// The width of the sensor divided by its height; default: the aspect ratio of the film.
    #[serde(default, deserialize_with = "number::optional")]
    aspect_ratio: Option<f32>,
    #[serde(deserialize_with = "number::triple")]
    position: Vec3,
    #[serde(deserialize_with = "number::triple")]
    look_at: Vec3,
    /// The direction that points upward in the picture. It does not have to be perpendicular to the
    /// view direction.
    #[serde(deserialize_with = "number::triple")]
    up: Vec3,
}

/// An error in a camera whose numbers are individually valid.
#[derive(Debug, thiserror::Error)]
enum CameraError {
    #[error("`film` is {0} x {1} pixels: each side must be from 1 to {MAX_FILM_SIDE}")]
    Film(u32, u32),
    #[error("`vertical_fov` is {0}: it must be less than 180 degrees")]
    FieldOfView(f32),
    #[error("`look_at` and `position` are the same point: change one of them")]
    LooksAtItself,
    #[error("`up` is parallel to the view direction: change it")]
    UpAlongTheView,
}

impl TryFrom<CameraEntry> for Camera {
    type Error = CameraError;

    fn try_from(file: CameraEntry) -> Result<Self, CameraError> {
        let [width, height] = file.film;
        let side = 1..=MAX_FILM_SIDE;
        if !side.contains(&width) || !side.contains(&height) {
            return Err(CameraError::Film(width, height));
        }
        if file.vertical_fov >= 180.0 {
            return Err(CameraError::FieldOfView(file.vertical_fov));
        }
        let view = (file.look_at - file.position).try_normalize();
        let forward = view.ok_or(CameraError::LooksAtItself)?;
        // Both vectors have length one, so the length of their cross product is the sine of the
        // angle between them.
        let across = forward.cross(file.up.normalize_or_zero());
        if across.length() < 1e-4 {
            return Err(CameraError::UpAlongTheView);
        }
        let right = across.normalize();

        let film = UVec2::new(width, height);
        Ok(Camera {
            pinhole: PinholeCamera {
                vertical_fov: file.vertical_fov,
                aspect_ratio: file.aspect_ratio.unwrap_or(aspect_of(film)),
                film,
            },
            placement: Placement {
                position: file.position,
                axes: Mat3::from_cols(right, right.cross(forward), -forward),
            },
            fixed_aspect: file.aspect_ratio.is_some(),
        })
    }
}

fn aspect_of(film: UVec2) -> f32 {
    film.x as f32 / film.y as f32
}

#[cfg(test)]
mod tests {
    use glam::{uvec2, vec3};

    use super::*;

    fn camera(extra: &str) -> Camera {
        let text = format!(
            r#"{{ "vertical_fov": 90, "film": [4, 2], {extra}
                 "position": [1, 2, 3], "look_at": [5, 2, 3], "up": [1, 1, 0] }}"#
        );
        serde_json::from_str(&text).expect("the camera is valid")
    }

    #[test]
    fn axes_follow_from_look_at_and_up() {
        let ray = camera("")
            .placement
            .to_world(&Ray::new(Vec3::ZERO, vec3(0.0, 1.0, -1.0)));
        assert_eq!(ray.origin, vec3(1.0, 2.0, 3.0));
        let forward_and_up = vec3(1.0, 1.0, 0.0).normalize();
        assert!(ray.dir.abs_diff_eq(forward_and_up, 1e-6), "{ray:?}");
        // The camera looks along +x with y up, so +z is to the right.
        let right = camera("").placement.axes.x_axis;
        assert!(right.abs_diff_eq(Vec3::Z, 1e-6), "{right}");
    }

    #[test]
    fn the_aspect_ratio_follows_the_film_unless_it_is_given() {
        assert_eq!(camera("").pinhole.aspect_ratio, 2.0);
        assert_eq!(camera("").on_film(uvec2(3, 3)).pinhole.aspect_ratio, 1.0);
        let fixed = camera(r#""aspect_ratio": 1.5,"#).on_film(uvec2(3, 3));
        assert_eq!(fixed.pinhole.aspect_ratio, 1.5);
        assert_eq!(fixed.pinhole.film, uvec2(3, 3));
    }
}
