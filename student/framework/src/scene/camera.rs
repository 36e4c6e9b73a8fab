//! Reads the camera of a scene file and places it in the scene.

use glam::{Mat3, UVec2, Vec3};
use protocol::{PinholeCamera, Ray};
use serde::{Deserialize, Serialize};

use super::MAX_FILM_SIDE;
use super::error::SceneError;
use super::value::Value;

/// A camera and its position in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// The parameters of the submission's `Camera`.
    pub pinhole: PinholeCamera,
    /// The transformation from camera space to world space.
    pub placement: Placement,
    /// Whether the scene file sets the sensor's aspect ratio. If not, the film's aspect ratio is
    /// used.
    pub fixed_aspect: bool,
}

/// A transformation from camera space to world space: a rotation, then a translation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placement {
    /// The position of the camera in world space.
    pub position: Vec3,
    /// The camera's x-, y- and z-axes in world space, as columns. The camera looks along −z, with y
    /// up.
    pub axes: Mat3,
}

impl Camera {
    /// Reads the value of `camera` in a scene file.
    pub(super) fn read(value: &Value) -> Result<Camera, SceneError> {
        let keys = value.object(&[
            "vertical_fov",
            "film",
            "aspect_ratio",
            "position",
            "look_at",
            "up",
        ])?;
        let vertical_fov = keys.required("vertical_fov", |value| {
            let expected = "an angle in degrees, greater than 0 and less than 180";
            value.number(expected, |degrees| degrees > 0.0 && degrees < 180.0)
        })?;
        let film = keys.required("film", |value| {
            let expected = format!(
                "two whole numbers from 1 to {MAX_FILM_SIDE}: the width and height in pixels"
            );
            let is_valid = |side: &u32| (1..=MAX_FILM_SIDE).contains(side);
            value.parsed(&expected, |film: &[u32; 2]| film.iter().all(is_valid))
        })?;
        let film = UVec2::from_array(film);
        // The width of the sensor divided by its height.
        let aspect_ratio = keys.optional("aspect_ratio", Value::positive)?;
        let position = keys.required("position", Value::point)?;
        let look_at = keys.required("look_at", Value::point)?;
        // The direction that points upward in the picture. It doesn't have to be perpendicular to
        // the view direction.
        let up = keys.required("up", Value::point)?;

        let Some(forward) = (look_at - position).try_normalize() else {
            let message = "`look_at` and `position` are the same point: change one of them";
            return Err(keys.value("look_at")?.error(message));
        };
        // Both vectors have length one, so the length of their cross product is the sine of the
        // angle between them.
        let across = forward.cross(up.normalize_or_zero());
        if across.length() < 1e-4 {
            let message = "`up` is parallel to the view direction: change `up`";
            return Err(keys.value("up")?.error(message));
        }
        let right = across.normalize();
        Ok(Camera {
            pinhole: PinholeCamera {
                vertical_fov,
                aspect_ratio: aspect_ratio.unwrap_or(aspect_of(film)),
                film,
            },
            placement: Placement {
                position,
                axes: Mat3::from_cols(right, right.cross(forward), -forward),
            },
            fixed_aspect: aspect_ratio.is_some(),
        })
    }

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
        let value = Value::parse(&text).expect("the text is JSON");
        Camera::read(&value).expect("the camera is valid")
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
