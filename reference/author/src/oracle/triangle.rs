//! Intersects rays with triangles by intersecting the ray with the triangle's plane and then
//! comparing areas.

use glam::{DVec2, DVec3};
use protocol::Vertex;

use super::{Intersection, Ray64};

/// The intersection of a ray's line and a triangle's plane.
#[derive(Clone, Copy, Debug)]
pub struct PlaneIntersection {
    /// The distance along the ray. May be negative.
    pub distance: f64,
    /// The barycentric weights of the corners. Inside the triangle, none of them are negative.
    pub weights: [f64; 3],
}

impl PlaneIntersection {
    /// Returns the smallest weight, which is positive inside the triangle and negative outside.
    pub fn least_weight(&self) -> f64 {
        self.weights.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Intersects the ray's line with the plane of the corners. Returns `None` if the corners define no
/// plane, or if the plane is parallel to the ray.
pub fn intersect_plane(ray: &Ray64, [p0, p1, p2]: [DVec3; 3]) -> Option<PlaneIntersection> {
    let normal = (p1 - p0).cross(p2 - p0);
    let slope = normal.dot(ray.dir);
    if slope == 0.0 {
        return None;
    }
    let distance = normal.dot(p0 - ray.origin) / slope;

    // The weight of a corner is the area of the triangle between the point and the other two
    // corners, divided by the area of the whole triangle.
    let point = ray.at(distance);
    let area = |a: DVec3, b: DVec3| (a - point).cross(b - point).dot(normal);
    let whole = normal.length_squared();
    Some(PlaneIntersection {
        distance,
        weights: [area(p1, p2), area(p2, p0), area(p0, p1)].map(|part| part / whole),
    })
}

/// Returns the corners of a triangle in double precision.
pub fn corners([p0, p1, p2]: &[Vertex; 3]) -> [DVec3; 3] {
    [p0, p1, p2].map(|vertex| vertex.position.as_dvec3())
}

/// Intersects the ray with the plane of the corners. Returns the intersection if it is inside the
/// triangle and in the ray's range.
pub fn intersect_inside(ray: &Ray64, corners: [DVec3; 3]) -> Option<PlaneIntersection> {
    intersect_plane(ray, corners).filter(|intersection| {
        ray.is_in_range(intersection.distance) && intersection.least_weight() >= 0.0
    })
}

/// Returns the intersection with the plane, with the normal and the texture coordinates
/// interpolated between the vertices.
pub fn intersection_at(
    ray: &Ray64,
    intersection: &PlaneIntersection,
    vertices: &[Vertex; 3],
    shape: u32,
) -> Intersection {
    let weighted = || intersection.weights.into_iter().zip(vertices);
    let normal: DVec3 = weighted().map(|(w, v)| w * v.normal.as_dvec3()).sum();
    let uv: DVec2 = weighted().map(|(w, v)| w * v.uv.as_dvec2()).sum();
    Intersection {
        distance: intersection.distance,
        position: ray.at(intersection.distance),
        normal: normal.normalize_or_zero(),
        uv,
        shape,
    }
}

/// Returns the intersection with the triangle, if it is in the ray's range.
pub fn intersect(ray: &Ray64, vertices: &[Vertex; 3], shape: u32) -> Option<Intersection> {
    let intersection = intersect_inside(ray, corners(vertices))?;
    Some(intersection_at(ray, &intersection, vertices, shape))
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3, dvec2, dvec3, vec2, vec3};
    use protocol::Ray;

    use super::*;

    fn triangle() -> [Vertex; 3] {
        [
            Vertex::new(Vec3::ZERO, Vec3::X, vec2(0.0, 0.0)),
            Vertex::new(vec3(4.0, 0.0, 0.0), Vec3::Y, vec2(1.0, 0.0)),
            Vertex::new(vec3(0.0, 4.0, 0.0), Vec3::Z, vec2(0.0, 2.0)),
        ]
    }

    #[test]
    fn interpolates_by_the_weights() {
        // At (1, 2, 0), the weights of p0, p1 and p2 are 1/4, 1/4 and 2/4.
        let ray = Ray::new(vec3(1.0, 2.0, 3.0), Vec3::NEG_Z);
        let hit = intersect(&Ray64::from(&ray), &triangle(), 5).unwrap();
        assert_eq!(hit.distance, 3.0);
        assert_eq!(hit.position, dvec3(1.0, 2.0, 0.0));
        assert_eq!(hit.uv, dvec2(0.25, 1.0));
        let normal = dvec3(0.25, 0.25, 0.5).normalize();
        assert!(hit.normal.abs_diff_eq(normal, 1e-15), "{hit:?}");
        assert_eq!(hit.shape, 5);
    }

    #[test]
    fn misses_outside_behind_parallel_and_out_of_range() {
        let miss = |ray: Ray| intersect(&Ray64::from(&ray), &triangle(), 0).is_none();
        assert!(miss(Ray::new(vec3(3.0, 3.0, 3.0), Vec3::NEG_Z)));
        assert!(miss(Ray::new(vec3(1.0, 1.0, 3.0), Vec3::Z)));
        assert!(miss(Ray::new(vec3(1.0, 1.0, 0.0), Vec3::X)));
        let ray = Ray::new(vec3(1.0, 1.0, 3.0), Vec3::NEG_Z);
        assert!(miss(ray.within(0.0, 2.0)) && miss(ray.within(4.0, 9.0)));
        assert!(!miss(ray.within(3.0, 3.0)));
    }

    #[test]
    fn a_triangle_without_area_is_never_hit() {
        let point = Vertex::new(Vec3::ONE, Vec3::X, Vec2::ZERO);
        let ray = Ray::new(Vec3::ZERO, Vec3::ONE);
        assert!(intersect(&Ray64::from(&ray), &[point; 3], 0).is_none());
    }
}
