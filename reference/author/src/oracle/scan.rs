//! Linear scans: find a ray's closest hit by testing every shape in a list.

use glam::DVec3;
use protocol::{Record, Shape, Value};

use super::bbox::Bounds;
use super::sphere::Sphere;
use super::{Intersection, Ray64, triangle};

/// Returns the first intersection with this shape in the ray's range.
pub fn intersect(ray: &Ray64, shape: &Shape) -> Option<Intersection> {
    match *shape {
        Shape::Triangle {
            ref vertices,
            shape,
        } => triangle::intersect(ray, vertices, shape),
        // Most rays miss, so the vertices are computed only after a hit.
        Shape::FlatTriangle { corners, shape } => {
            let intersection =
                triangle::intersect_inside(ray, corners.map(|corner| corner.as_dvec3()))?;
            let vertices = Shape::flat_triangle_vertices(corners);
            Some(triangle::intersection_at(
                ray,
                &intersection,
                &vertices,
                shape,
            ))
        }
        Shape::Sphere {
            center,
            radius,
            shape,
        } => sphere(center, radius).intersect(ray, shape),
    }
}

/// Returns the distance of the first intersection with this shape in the ray's range.
pub fn hit_distance(ray: &Ray64, shape: &Shape) -> Option<f64> {
    if let Shape::Sphere { center, radius, .. } = *shape {
        return sphere(center, radius).hit_distance(ray);
    }
    Some(triangle::intersect_inside(ray, corners(shape)?)?.distance)
}

/// Returns the closest intersection with any of the shapes.
pub fn closest_hit(ray: &Ray64, shapes: &[Shape]) -> Option<Intersection> {
    let hits = shapes
        .iter()
        .filter_map(|shape| Some((shape, hit_distance(ray, shape)?)));
    let (closest, _) = hits.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    intersect(ray, closest)
}

/// Returns the corners of a triangle, or `None` for any other shape.
pub fn corners(shape: &Shape) -> Option<[DVec3; 3]> {
    match shape {
        Shape::Triangle { vertices, .. } => Some(triangle::corners(vertices)),
        Shape::FlatTriangle { corners, .. } => Some(corners.map(|corner| corner.as_dvec3())),
        Shape::Sphere { .. } => None,
    }
}

/// Returns the tightest box around a shape.
pub fn bounds(shape: &Shape) -> Bounds {
    match *shape {
        Shape::Sphere { center, radius, .. } => {
            let Sphere { center, radius } = sphere(center, radius);
            Bounds {
                min: center - radius,
                max: center + radius,
            }
        }
        Shape::Triangle { .. } | Shape::FlatTriangle { .. } => {
            Bounds::around(corners(shape).into_iter().flatten())
        }
    }
}

/// Returns the box around a subject's shapes and points, enlarged by the subject's largest length,
/// such as a radius. Returns `None` if the subject contains no shapes or points.
pub fn extent(subject: &dyn Record) -> Option<Bounds> {
    let (mut boxes, mut margin) = (Vec::new(), 0.0_f64);
    for value in subject.values() {
        if let Value::Shapes(shapes) = value {
            boxes.extend(shapes.iter().map(bounds));
        } else if let Value::Point(point) = value {
            boxes.push(Bounds::new(point, point));
        } else if let Value::Length(length) = value {
            margin = margin.max(length.into());
        }
    }
    let all = boxes.into_iter().reduce(|all, next| all.union(&next))?;
    Some(Bounds {
        min: all.min - margin,
        max: all.max + margin,
    })
}

/// Returns whether all correct formulas in single precision agree on whether the ray hits this
/// shape. They do if the ray isn't close to an edge, a tangent or an end of the range.
pub fn is_unambiguous(ray: &Ray64, shape: &Shape) -> bool {
    /// The minimum difference between a distance and the ends of the range, as a multiple of the
    /// shape's size.
    const END_MARGIN: f64 = 1e-2;
    /// The minimum absolute value of the smallest weight.
    const EDGE_MARGIN: f64 = 2e-2;
    /// The minimum difference between the closest approach and the radius, as a multiple of the
    /// radius.
    const TANGENT_MARGIN: f64 = 3e-2;

    let bounds = bounds(shape);
    let margin = END_MARGIN * (bounds.max - bounds.min).max_element();
    let is_away_from_ends = |t: f64| (t - ray.min).abs() >= margin && (t - ray.max).abs() >= margin;
    if let Shape::Sphere { center, radius, .. } = shape {
        let line = sphere(*center, *radius).intersect_line(ray);
        return (line.closest_approach - 1.0).abs() >= TANGENT_MARGIN
            && (line.closest_approach > 1.0 || line.roots.into_iter().all(is_away_from_ends));
    }
    let Some(corners @ [p0, p1, p2]) = corners(shape) else {
        return false;
    };
    let slope = (p1 - p0).cross(p2 - p0).normalize().dot(ray.dir).abs();
    match triangle::intersect_plane(ray, corners) {
        None => false,
        Some(intersection) if intersection.least_weight() < -EDGE_MARGIN && slope > 0.02 => true,
        Some(intersection) => {
            intersection.least_weight().abs() >= EDGE_MARGIN
                && slope > 0.1
                && is_away_from_ends(intersection.distance)
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
    use glam::{Vec3, vec3};
    use protocol::Ray;

    use super::*;

    fn shapes() -> [Shape; 2] {
        [
            Shape::Sphere {
                center: vec3(0.0, 0.0, -9.0),
                radius: 2.0,
                shape: 0,
            },
            Shape::FlatTriangle {
                corners: [
                    vec3(-1.0, -1.0, -5.0),
                    vec3(3.0, -1.0, -5.0),
                    vec3(-1.0, 3.0, -5.0),
                ],
                shape: 1,
            },
        ]
    }

    #[test]
    fn the_nearest_shape_wins() {
        let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
        let hit = closest_hit(&Ray64::from(&ray), &shapes()).unwrap();
        assert_eq!((hit.distance, hit.shape), (5.0, 1));
        let hit = closest_hit(&Ray64::from(&ray.within(6.0, 20.0)), &shapes()).unwrap();
        assert_eq!((hit.distance, hit.shape), (7.0, 0));
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
