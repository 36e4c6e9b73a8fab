//! The closest hit of a ray with a list of shapes: all of them, one after the other.

use protocol::Shape;

use super::bbox::Bounds;
use super::sphere::Sphere;
use super::{Intersection, Ray64, triangle};

/// Where the ray first meets this shape within its range.
pub fn intersect(beam: &Ray64, shape: &Shape) -> Option<Intersection> {
    match *shape {
        Shape::Triangle {
            ref vertices,
            material,
        } => triangle::intersect(beam, vertices, material),
        // Most facets are missed: their vertices are only made for those that are not.
        Shape::FlatTriangle { corners, material } => {
            let crossing =
                triangle::intersect_inside(beam, corners.map(|corner| corner.as_dvec3()))?;
            let vertices = Shape::flat_triangle_vertices(corners);
            Some(triangle::intersection_at(
                beam, &crossing, &vertices, material,
            ))
        }
        Shape::Sphere {
            center,
            radius,
            material,
        } => sphere(center, radius).intersect(beam, material),
    }
}

/// The closest of all meetings.
pub fn closest_hit<'a>(
    beam: &Ray64,
    shapes: impl IntoIterator<Item = &'a Shape>,
) -> Option<Intersection> {
    shapes
        .into_iter()
        .filter_map(|shape| intersect(beam, shape))
        .min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Shapes that very many rays are to scan, as pictures do.
#[derive(Debug)]
pub struct Scan<'a> {
    bounded_shapes: Vec<(Sphere, &'a Shape)>,
}

impl<'a> Scan<'a> {
    /// Puts a ball around each shape, a little larger than it has to be.
    pub fn new(shapes: &'a [Shape]) -> Self {
        let guarded = |shape| {
            let bounds = bounds(shape);
            let ball = Sphere {
                center: bounds.center(),
                radius: 0.500_001 * bounds.min.distance(bounds.max),
            };
            (ball, shape)
        };
        Scan {
            bounded_shapes: shapes.iter().map(guarded).collect(),
        }
    }

    /// The closest of all meetings: what [`closest`] finds, but only shapes whose balls the ray's
    /// line passes through are asked.
    pub fn closest_hit(&self, beam: &Ray64) -> Option<Intersection> {
        let passing = self
            .bounded_shapes
            .iter()
            .filter(|(ball, _)| ball.is_hit_by_line(beam));
        closest_hit(beam, passing.map(|&(_, shape)| shape))
    }
}

/// The tightest box around a shape.
pub fn bounds(shape: &Shape) -> Bounds {
    match *shape {
        Shape::Triangle { ref vertices, .. } => Bounds::around(triangle::corners(vertices)),
        Shape::FlatTriangle { corners, .. } => {
            Bounds::around(corners.map(|corner| corner.as_dvec3()))
        }
        Shape::Sphere { center, radius, .. } => {
            let Sphere { center, radius } = sphere(center, radius);
            Bounds {
                min: center - radius,
                max: center + radius,
            }
        }
    }
}

/// Whether it is beyond doubt, in single precision and by any formula, if and where the ray meets
/// this shape: nowhere near an edge, a tangent or an end of its range.
pub fn is_unambiguous(beam: &Ray64, shape: &Shape) -> bool {
    /// Of a distance to the ends of the range.
    const FROM_ENDS: f64 = 2e-2;
    /// Of the least weight to zero.
    const FROM_EDGES: f64 = 2e-2;
    /// Of the closest approach to a radius.
    const FROM_TANGENT: f64 = 3e-2;

    let from_ends = |t: f64| (t - beam.min).abs() >= FROM_ENDS && (t - beam.max).abs() >= FROM_ENDS;
    let corners = match *shape {
        Shape::Triangle { ref vertices, .. } => triangle::corners(vertices),
        Shape::FlatTriangle { corners, .. } => corners.map(|corner| corner.as_dvec3()),
        Shape::Sphere { center, radius, .. } => {
            let passage = sphere(center, radius).intersect_line(beam);
            return (passage.closest_approach - 1.0).abs() >= FROM_TANGENT
                && (passage.closest_approach > 1.0 || passage.roots.into_iter().all(from_ends));
        }
    };
    let [p0, p1, p2] = corners;
    let slope = (p1 - p0).cross(p2 - p0).normalize().dot(beam.dir).abs();
    match triangle::intersect_plane(beam, corners) {
        None => false,
        Some(crossing) if crossing.least_weight() < -FROM_EDGES && slope > 0.02 => true,
        Some(crossing) => {
            crossing.least_weight().abs() >= FROM_EDGES
                && slope > 0.1
                && from_ends(crossing.distance)
        }
    }
}

fn sphere(center: glam::Vec3, radius: f32) -> Sphere {
    Sphere {
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
            Shape::FlatTriangle {
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
        let met = closest_hit(&Ray64::from(&ray), &shapes()).unwrap();
        assert_eq!((met.distance, met.material), (5.0, 1));
        let met = closest_hit(&Ray64::from(&ray.within(6.0, 20.0)), &shapes()).unwrap();
        assert_eq!((met.distance, met.material), (7.0, 0));
    }

    #[test]
    fn bounding_spheres_do_not_change_the_result() {
        let mut draw = Seed(1).rng("scan");
        let shapes = shapes();
        let scan = Scan::new(&shapes);
        let mut hits = 0;
        for _ in 0..1000 {
            let target = draw.point(4.0) - 6.0 * DVec3::Z;
            let beam = Ray64 {
                origin: DVec3::ZERO,
                dir: target.normalize(),
                min: 0.0,
                max: f64::INFINITY,
            };
            let met = closest_hit(&beam, &shapes);
            assert_eq!(scan.closest_hit(&beam), met);
            hits += usize::from(met.is_some());
        }
        assert!((100..900).contains(&hits), "{hits} of 1000 hit");
    }

    #[test]
    fn edges_tangents_and_range_ends_are_ambiguous() {
        let clear = |x, max| {
            let ray = Ray::new(vec3(x, 0.0, 0.0), Vec3::NEG_Z).within(0.0, max);
            shapes().map(|shape| is_unambiguous(&Ray64::from(&ray), &shape))
        };
        assert_eq!(clear(0.0, 99.0), [true, true]);
        assert_eq!(clear(1.99, 99.0), [false, false]);
        assert_eq!(clear(0.0, 7.01), [false, true]);
        assert_eq!(clear(0.0, 5.01), [true, false]);
    }
}
