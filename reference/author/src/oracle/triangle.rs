//! Rays and triangles: the plane first, then areas.

use glam::{DVec2, DVec3};
use protocol::Vertex;

use super::{Intersection, Ray64};

/// Where a ray crosses a triangle's plane.
#[derive(Clone, Copy, Debug)]
pub struct PlaneIntersection {
    /// Along the ray; may be negative.
    pub distance: f64,
    /// The weights of the corners there; all of them at least zero inside the triangle.
    pub weights: [f64; 3],
}

impl PlaneIntersection {
    /// The least weight: how far inside (positive) or outside the triangle.
    pub fn least_weight(&self) -> f64 {
        self.weights.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Where the ray crosses the plane of the corners; `None` if there is no plane or it is parallel.
pub fn intersect_plane(beam: &Ray64, [p0, p1, p2]: [DVec3; 3]) -> Option<PlaneIntersection> {
    let normal = (p1 - p0).cross(p2 - p0);
    let slope = normal.dot(beam.dir);
    if slope == 0.0 {
        return None;
    }
    let distance = normal.dot(p0 - beam.origin) / slope;

    // A corner weighs as much as the triangle between the point and the other two, of the whole.
    let point = beam.at(distance);
    let area = |a: DVec3, b: DVec3| (a - point).cross(b - point).dot(normal);
    let whole = normal.length_squared();
    Some(PlaneIntersection {
        distance,
        weights: [area(p1, p2), area(p2, p0), area(p0, p1)].map(|part| part / whole),
    })
}

/// The corners of a triangle, exactly.
pub fn corners([p0, p1, p2]: &[Vertex; 3]) -> [DVec3; 3] {
    [p0, p1, p2].map(|vertex| vertex.position.as_dvec3())
}

/// Where the ray passes through the triangle within its range.
pub fn intersect_inside(beam: &Ray64, corners: [DVec3; 3]) -> Option<PlaneIntersection> {
    intersect_plane(beam, corners)
        .filter(|crossing| beam.is_in_range(crossing.distance) && crossing.least_weight() >= 0.0)
}

/// What is met there.
pub fn intersection_at(
    beam: &Ray64,
    crossing: &PlaneIntersection,
    vertices: &[Vertex; 3],
    material: u32,
) -> Intersection {
    let weighted = || crossing.weights.into_iter().zip(vertices);
    let normal: DVec3 = weighted().map(|(w, v)| w * v.normal.as_dvec3()).sum();
    let uv: DVec2 = weighted().map(|(w, v)| w * v.uv.as_dvec2()).sum();
    Intersection {
        distance: crossing.distance,
        position: beam.at(crossing.distance),
        normal: normal.normalize_or_zero(),
        uv,
        material,
    }
}

/// Where the ray meets the triangle within its range.
pub fn intersect(beam: &Ray64, vertices: &[Vertex; 3], material: u32) -> Option<Intersection> {
    let crossing = intersect_inside(beam, corners(vertices))?;
    Some(intersection_at(beam, &crossing, vertices, material))
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, Vec2, Vec3, dvec2, dvec3, vec2, vec3};
    use protocol::Ray;

    use super::*;
    use crate::seed::Seed;

    fn triangle() -> [Vertex; 3] {
        [
            Vertex::new(Vec3::ZERO, Vec3::X, vec2(0.0, 0.0)),
            Vertex::new(vec3(4.0, 0.0, 0.0), Vec3::Y, vec2(1.0, 0.0)),
            Vertex::new(vec3(0.0, 4.0, 0.0), Vec3::Z, vec2(0.0, 2.0)),
        ]
    }

    #[test]
    fn interpolates_by_the_weights() {
        // At (1, 2, 0): p1 weighs 1/4, p2 weighs 2/4, p0 the rest.
        let ray = Ray::new(vec3(1.0, 2.0, 3.0), Vec3::NEG_Z);
        let met = intersect(&Ray64::from(&ray), &triangle(), 5).unwrap();
        assert_eq!(met.distance, 3.0);
        assert_eq!(met.position, dvec3(1.0, 2.0, 0.0));
        assert_eq!(met.uv, dvec2(0.25, 1.0));
        let normal = dvec3(0.25, 0.25, 0.5).normalize();
        assert!(met.normal.abs_diff_eq(normal, 1e-15), "{met:?}");
        assert_eq!(met.material, 5);
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

    #[test]
    fn solves_the_three_linear_equations() {
        // o + t·d = p0 + u·e1 + v·e2, by inverting the matrix.
        let mut draw = Seed(1).rng("oracle");
        for _ in 0..1000 {
            let corners = [draw.point(2.0), draw.point(2.0), draw.point(2.0)];
            let beam = Ray64 {
                origin: draw.point(5.0),
                dir: draw.direction(),
                min: 0.0,
                max: f64::INFINITY,
            };
            let [p0, p1, p2] = corners;
            let equations = DMat3::from_cols(p1 - p0, p2 - p0, -beam.dir);
            if equations.determinant().abs() < 1e-3 {
                continue;
            }
            let solved = equations.inverse() * (beam.origin - p0);
            let crossing = intersect_plane(&beam, corners).unwrap();
            let [_, u, v] = crossing.weights;
            let found = dvec3(u, v, crossing.distance);
            assert!((found - solved).length() < 1e-8 * (1.0 + solved.length()));
            assert!((crossing.weights.iter().sum::<f64>() - 1.0).abs() < 1e-8);
        }
    }
}
