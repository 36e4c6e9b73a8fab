//! A surface with a variable number of triangles, and rays to trace.

use glam::Vec3;
use protocol::{Ray, Shape};

use crate::numbers::SplitMix64;

/// Returns a ball with bumps, made from a cube of 12 · pieces² triangles. It is computed with only
/// the four basic arithmetic operations and square roots, whose results are the same on every
/// machine.
pub fn bumpy_ball(pieces: u32) -> Vec<Shape> {
    let coordinate = |i: u32| 2.0 * i as f32 / pieces as f32 - 1.0;
    let mut shapes = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let point = |i: u32, j: u32| {
                let mut corner = Vec3::ZERO;
                corner[axis] = side;
                corner[(axis + 1) % 3] = coordinate(i);
                corner[(axis + 2) % 3] = coordinate(j);
                bumpy(corner.normalize())
            };
            for i in 0..pieces {
                for j in 0..pieces {
                    let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                    let [a, b, c, d] = corners.map(|(i, j)| point(i, j));
                    shapes.extend(
                        [[a, b, c], [a, c, d]]
                            .map(|corners| Shape::FlatTriangle { corners, shape: 0 }),
                    );
                }
            }
        }
    }
    shapes
}

fn bumpy(dir: Vec3) -> Vec3 {
    let bumps = 4.0 * dir.x * dir.y * dir.z + dir.x * dir.x * dir.z;
    (1.0 + 0.3 * bumps) * dir
}

/// Returns rays from a sphere around the ball to random points in the unit ball.
pub fn rays(count: usize) -> Vec<Ray> {
    let mut numbers = SplitMix64(1);
    let ray = |_| {
        let origin = 3.0 * numbers.in_ball().normalize();
        Ray::new(origin, numbers.in_ball() - origin)
    };
    (0..count).map(ray).collect()
}
