//! The camera's position and the ways to move it.

use std::f32::consts::FRAC_PI_2;

use framework::math::{atan2, sin_cos, tan};
use framework::scene::{Camera, Placement};
use glam::{Mat3, Quat, Vec3};
use judging::judge::tree::bounds::Bounds;
use serde::Deserialize;

/// The maximum angle between the view direction and the horizon, which keeps the camera from
/// turning upside down.
const MAX_PITCH: f32 = FRAC_PI_2 - 0.01;

/// A camera position and the point that the camera turns around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// The position and the axes.
    pub placement: Placement,
    /// The distance to the point that the camera turns around.
    distance: f32,
    /// The direction that stays up.
    up: Vec3,
}

/// A movement of the camera.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Movement {
    /// Turns the camera around the point in the middle of the picture by two angles in radians: to
    /// the right and up.
    Orbit(f32, f32),
    /// Moves the camera parallel to the picture, to the right and up. The distances are fractions
    /// of the picture's height.
    Pan(f32, f32),
    /// Multiplies the distance to the point in the middle by a factor. A factor below 1 moves the
    /// camera closer.
    Dolly(f32),
    /// Moves the camera and the point in the middle forward by a fraction of the distance between
    /// them.
    Fly(f32),
    /// Turns the camera in place by two angles in radians: to the right and up.
    Turn(f32, f32),
}

/// A direction to view a scene from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// From +z.
    Front,
    /// From −z.
    Back,
    /// From −x.
    Left,
    /// From +x.
    Right,
    /// From above.
    Top,
}

impl Viewpoint {
    /// Returns the viewpoint of a scene's camera. The camera turns around the point in front of it
    /// that is closest to the middle of the scene.
    pub fn of_scene(camera: &Camera, bounds: &Bounds) -> Self {
        let placement = camera.placement;
        let forward = -placement.axes.z_axis;
        let ahead = (bounds.center().as_vec3() - placement.position).dot(forward);
        let axes = [Vec3::X, Vec3::Y, Vec3::Z];
        let y = placement.axes.y_axis;
        let nearest = axes
            .into_iter()
            .max_by(|a, b| a.dot(y).abs().total_cmp(&b.dot(y).abs()));
        let up = nearest.unwrap_or(Vec3::Y);
        Viewpoint {
            placement,
            distance: ahead.max(0.05 * bounds.diagonal() as f32).max(1e-3),
            up: if up.dot(y) < 0.0 { -up } else { up },
        }
    }

    /// Returns a viewpoint from this side that shows the entire box, given the vertical field of
    /// view in degrees.
    pub fn from_side(side: Side, bounds: &Bounds, vertical_fov: f32, aspect_ratio: f32) -> Self {
        let (toward, up) = match side {
            Side::Front => (Vec3::NEG_Z, Vec3::Y),
            Side::Back => (Vec3::Z, Vec3::Y),
            Side::Left => (Vec3::X, Vec3::Y),
            Side::Right => (Vec3::NEG_X, Vec3::Y),
            Side::Top => (Vec3::NEG_Y, Vec3::NEG_Z),
        };
        Viewpoint::looking(toward, up, bounds, vertical_fov, aspect_ratio)
    }

    /// Returns a viewpoint that looks in a direction and shows the entire box.
    pub fn looking(
        toward: Vec3,
        up: Vec3,
        bounds: &Bounds,
        vertical_fov: f32,
        aspect_ratio: f32,
    ) -> Self {
        let slope = tan(0.5 * vertical_fov.to_radians()) * aspect_ratio.min(1.0);
        // The sphere around the box fits into the cone of view.
        let distance =
            (0.55 * bounds.diagonal() as f32 / slope * (1.0 + slope * slope).sqrt()).max(1e-3);
        let forward = toward.normalize_or(Vec3::NEG_Z);
        Viewpoint {
            placement: Placement {
                position: bounds.center().as_vec3() - distance * forward,
                axes: axes(forward, up),
            },
            distance,
            up,
        }
    }

    /// Returns the viewpoint after a movement. `height` is the height of the picture at a distance
    /// of 1. Movements with numbers that aren't finite are ignored.
    pub fn moved(self, movement: Movement, height: f32) -> Self {
        let Placement { position, axes } = self.placement;
        let forward = -axes.z_axis;
        let target = position + self.distance * forward;
        let moved = match movement {
            Movement::Orbit(right, up) => {
                let forward = self.turned(right, -up);
                self.at(target - self.distance * forward, forward)
            }
            Movement::Turn(right, up) => self.at(position, self.turned(-right, up)),
            Movement::Pan(right, up) => {
                let scale = self.distance * height;
                self.at(
                    position + scale * (right * axes.x_axis + up * axes.y_axis),
                    forward,
                )
            }
            Movement::Dolly(factor) => {
                let distance = (self.distance * factor.clamp(0.01, 100.0)).clamp(1e-6, 1e9);
                let nearer = self.at(target - distance * forward, forward);
                Viewpoint { distance, ..nearer }
            }
            Movement::Fly(ahead) => self.at(position + ahead * self.distance * forward, forward),
        };
        let Placement { position, axes } = moved.placement;
        let columns = [axes.x_axis, axes.y_axis, axes.z_axis];
        if position.is_finite() && columns.iter().all(|axis| axis.is_normalized()) {
            moved
        } else {
            self
        }
    }

    fn at(self, position: Vec3, forward: Vec3) -> Self {
        let placement = Placement {
            position,
            axes: axes(forward, self.up),
        };
        Viewpoint { placement, ..self }
    }

    /// Returns the view direction after turning it left (counter-clockwise as seen from above) and
    /// up.
    fn turned(&self, left: f32, up: f32) -> Vec3 {
        let forward = -self.placement.axes.z_axis;
        let right = self.placement.axes.x_axis;
        let sin = forward.dot(self.up).clamp(-1.0, 1.0);
        let pitch = atan2(sin, (1.0 - sin * sin).max(0.0).sqrt());
        let up = (pitch + up).clamp(-MAX_PITCH, MAX_PITCH) - pitch;
        let horizon = forward
            .reject_from(self.up)
            .normalize_or(self.up.cross(right));
        let (sin, cos) = sin_cos(pitch + up);
        let tilted = cos * horizon + sin * self.up;
        Quat::from_axis_angle(self.up, left) * tilted
    }
}

/// Returns the axes of a camera that looks in a direction.
fn axes(forward: Vec3, up: Vec3) -> Mat3 {
    let right = forward.cross(up).try_normalize();
    let right = right.unwrap_or_else(|| forward.any_orthonormal_vector());
    Mat3::from_cols(right, right.cross(forward), -forward)
}

#[cfg(test)]
mod tests {
    use glam::vec3;

    use super::*;

    fn cube() -> Bounds {
        Bounds {
            min: glam::DVec3::NEG_ONE,
            max: glam::DVec3::ONE,
        }
    }

    fn front() -> Viewpoint {
        Viewpoint::from_side(Side::Front, &cube(), 90.0, 1.0)
    }

    #[test]
    fn all_corners_are_in_view_from_each_side() {
        for side in [Side::Front, Side::Back, Side::Left, Side::Right, Side::Top] {
            for fov in [20.0, 90.0, 150.0] {
                let Placement { position, axes } =
                    Viewpoint::from_side(side, &cube(), fov, 0.5).placement;
                let slope = tan(0.5_f32 * f32::to_radians(fov));
                for corner in [
                    vec3(1.0, 1.0, 1.0),
                    vec3(-1.0, 1.0, -1.0),
                    vec3(1.0, -1.0, -1.0),
                ] {
                    let seen = axes.transpose() * (corner - position);
                    assert!(seen.z < 0.0, "{side:?} {fov}");
                    let (x, y) = (seen.x / -seen.z / slope / 0.5, seen.y / -seen.z / slope);
                    assert!(x.abs() <= 1.0 && y.abs() <= 1.0, "{side:?} {fov} {x} {y}");
                }
            }
        }
    }

    #[test]
    fn orbiting_keeps_the_distance_and_the_horizon() {
        let target = Vec3::ZERO;
        let start = front().placement.position.distance(target);
        let moved = front().moved(Movement::Orbit(0.7, 0.4), 2.0).placement;
        assert!((moved.position.distance(target) - start).abs() < 1e-4);
        assert!(moved.axes.x_axis.y.abs() < 1e-5, "the horizon is level");
        // Orbiting to the right and up moves the camera itself to +x and +y.
        assert!(
            moved.position.x > 0.1 && moved.position.y > 0.1,
            "{moved:?}"
        );
        let pole = front().moved(Movement::Orbit(0.0, 99.0), 2.0).placement;
        assert!(pole.axes.y_axis.y > 0.0, "up stays up");
    }

    #[test]
    fn movements_can_be_undone() {
        let there = front().moved(Movement::Pan(0.3, -0.2), 2.0);
        let back = there.moved(Movement::Pan(-0.3, 0.2), 2.0);
        assert!(
            back.placement
                .position
                .abs_diff_eq(front().placement.position, 1e-5)
        );
        let near = front().moved(Movement::Dolly(0.5), 2.0);
        let half = 0.5 * front().placement.position.length();
        assert!((near.placement.position.length() - half).abs() < 1e-4);
        let far = near.moved(Movement::Fly(-1.0), 2.0);
        assert!((far.placement.position.length() - 2.0 * half).abs() < 1e-4);
    }

    #[test]
    fn numbers_that_are_not_finite_change_nothing() {
        for movement in [
            Movement::Orbit(f32::NAN, 0.0),
            Movement::Pan(f32::INFINITY, 0.0),
            Movement::Dolly(f32::NAN),
            Movement::Turn(0.0, f32::NAN),
        ] {
            assert_eq!(front().moved(movement, 2.0), front(), "{movement:?}");
        }
    }
}
