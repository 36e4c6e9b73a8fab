//! The closest hit of a ray with a list of shapes: all of them, one after the other.

use protocol::Shape;

use super::bbox::Bounds;
use super::sphere::Ball;
use super::{Beam, Meeting, triangle};

/// Where the ray first meets this shape within its range.
pub fn meet(beam: &Beam, shape: &Shape) -> Option<Meeting> {
    match *shape {
        Shape::Triangle {
            ref vertices,
            material,
        } => triangle::meet(beam, vertices, material),
        // Most facets are missed: their vertices are only made for those that are not.
        Shape::Facet { corners, material } => {
            let crossing = triangle::passage(beam, corners.map(|corner| corner.as_dvec3()))?;
            let vertices = Shape::facet_vertices(corners);
            Some(triangle::meeting(beam, &crossing, &vertices, material))
        }
        Shape::Sphere {
            center,
            radius,
            material,
        } => ball(center, radius).meet(beam, material),
    }
}

/// The closest of all meetings.
pub fn closest<'a>(beam: &Beam, shapes: impl IntoIterator<Item = &'a Shape>) -> Option<Meeting> {
    shapes
        .into_iter()
        .filter_map(|shape| meet(beam, shape))
        .min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Shapes that very many rays are to scan, as pictures do.
#[derive(Debug)]
pub struct Scan<'a> {
    guarded: Vec<(Ball, &'a Shape)>,
}

impl<'a> Scan<'a> {
    /// Puts a ball around each shape, a little larger than it has to be.
    pub fn of(shapes: &'a [Shape]) -> Self {
        let guarded = |shape| {
            let bounds = bounds(shape);
            let ball = Ball {
                center: bounds.center(),
                radius: 0.500_001 * bounds.min.distance(bounds.max),
            };
            (ball, shape)
        };
        Scan {
            guarded: shapes.iter().map(guarded).collect(),
        }
    }

    /// The closest of all meetings: what [`closest`] finds, but only shapes whose balls the ray's
    /// line passes through are asked.
    pub fn closest(&self, beam: &Beam) -> Option<Meeting> {
        let passing = self.guarded.iter().filter(|(ball, _)| ball.is_passed(beam));
        closest(beam, passing.map(|&(_, shape)| shape))
    }
}

/// The tightest box around a shape.
pub fn bounds(shape: &Shape) -> Bounds {
    match *shape {
        Shape::Triangle { ref vertices, .. } => Bounds::around(triangle::corners(vertices)),
        Shape::Facet { corners, .. } => Bounds::around(corners.map(|corner| corner.as_dvec3())),
        Shape::Sphere { center, radius, .. } => {
            let Ball { center, radius } = ball(center, radius);
            Bounds {
                min: center - radius,
                max: center + radius,
            }
        }
    }
}

/// Whether it is beyond doubt, in single precision and by any formula, if and where the ray meets
/// this shape: nowhere near an edge, a tangent or an end of its range.
pub fn is_clear(beam: &Beam, shape: &Shape) -> bool {
    /// Of a distance to the ends of the range.
    const FROM_ENDS: f64 = 2e-2;
    /// Of the least weight to zero.
    const FROM_EDGES: f64 = 2e-2;
    /// Of the closest approach to a radius.
    const FROM_TANGENT: f64 = 3e-2;

    let from_ends = |t: f64| (t - beam.min).abs() >= FROM_ENDS && (t - beam.max).abs() >= FROM_ENDS;
    let corners = match *shape {
        Shape::Triangle { ref vertices, .. } => triangle::corners(vertices),
        Shape::Facet { corners, .. } => corners.map(|corner| corner.as_dvec3()),
        Shape::Sphere { center, radius, .. } => {
            let passage = ball(center, radius).passage(beam);
            return (passage.approach - 1.0).abs() >= FROM_TANGENT
                && (passage.approach > 1.0 || passage.roots.into_iter().all(from_ends));
        }
    };
    let [p0, p1, p2] = corners;
    let slope = (p1 - p0).cross(p2 - p0).normalize().dot(beam.dir).abs();
    match triangle::crossing(beam, corners) {
        None => false,
        Some(crossing) if crossing.depth() < -FROM_EDGES && slope > 0.02 => true,
        Some(crossing) => {
            crossing.depth().abs() >= FROM_EDGES && slope > 0.1 && from_ends(crossing.distance)
        }
    }
}

fn ball(center: glam::Vec3, radius: f32) -> Ball {
    Ball {
        center: center.as_dvec3(),
        radius: radius.into(),
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3, vec3};
    use protocol::Ray;

    use super::*;
    use crate::seed::Seed;

    fn shapes() -> [Shape; 2] {
        [
            Shape::Sphere {
                center: vec3(0.0, 0.0, -9.0),
                radius: 2.0,
                material: 0,
            },
            Shape::Facet {
                corners: [
                    vec3(-1.0, -1.0, -5.0),
                    vec3(3.0, -1.0, -5.0),
                    vec3(-1.0, 3.0, -5.0),
                ],
                material: 1,
            },
        ]
    }

    #[test]
    fn the_nearest_shape_wins() {
        let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
        let met = closest(&Beam::from(&ray), &shapes()).unwrap();
        assert_eq!((met.distance, met.material), (5.0, 1));
        let met = closest(&Beam::from(&ray.within(6.0, 20.0)), &shapes()).unwrap();
        assert_eq!((met.distance, met.material), (7.0, 0));
    }

    #[test]
    fn balls_around_shapes_change_nothing() {
        let mut draw = Seed(1).draw("scan");
        let shapes = shapes();
        let scan = Scan::of(&shapes);
        let mut hits = 0;
        for _ in 0..1000 {
            let target = draw.point(4.0) - 6.0 * DVec3::Z;
            let beam = Beam {
                origin: DVec3::ZERO,
                dir: target.normalize(),
                min: 0.0,
                max: f64::INFINITY,
            };
            let met = closest(&beam, &shapes);
            assert_eq!(scan.closest(&beam), met);
            hits += usize::from(met.is_some());
        }
        assert!((100..900).contains(&hits), "{hits} of 1000 hit");
    }

    #[test]
    fn edges_tangents_and_ends_are_doubtful() {
        let clear = |x, max| {
            let ray = Ray::new(vec3(x, 0.0, 0.0), Vec3::NEG_Z).within(0.0, max);
            shapes().map(|shape| is_clear(&Beam::from(&ray), &shape))
        };
        assert_eq!(clear(0.0, 99.0), [true, true]);
        assert_eq!(clear(1.99, 99.0), [false, false]);
        assert_eq!(clear(0.0, 7.01), [false, true]);
        assert_eq!(clear(0.0, 5.01), [true, false]);
    }
}
