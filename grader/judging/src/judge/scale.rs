//! The scale of a question: how large the numbers are with which an answer is computed. Rounding
//! errors grow with them, so lengths are compared relative to the scale, never absolutely.

use glam::Vec3;
use protocol::{Question, Ray, Rays, Shape};

/// Returns the scale of hits with these shapes: the largest of the ray's distance to the expected
/// hit, if there is one, and the coordinates of its origin and of all shapes.
pub(crate) fn of_hit(shapes: &[Shape], ray: &Ray, distance: Option<f32>) -> f32 {
    let shapes = shapes.iter().map(of_shape);
    let scale = shapes.fold(of_point(ray.origin), f32::max);
    distance.map_or(scale, |distance| scale.max(distance.abs()))
}

/// Returns the scale of a picture of these shapes: the largest coordinate of the eye and of all
/// shapes.
pub(crate) fn of_picture(shapes: &[Shape], rays: &Rays) -> f32 {
    let eye = match rays {
        Rays::List(list) => list.first().map_or(Vec3::ZERO, |ray| ray.origin),
        Rays::View(view) => view.eye,
    };
    shapes.iter().map(of_shape).fold(of_point(eye), f32::max)
}

/// Returns the scale of the times at which a ray enters and leaves a box: its largest coordinate.
pub(crate) fn of_box(min: Vec3, max: Vec3, ray: &Ray) -> f32 {
    let corners = of_point(min).max(of_point(max));
    corners.max(of_point(ray.origin))
}

/// Returns the shapes that a question with rays is about.
pub(crate) fn shapes(question: &Question) -> &[Shape] {
    match question {
        Question::Shapes { shapes, .. }
        | Question::Traverse { shapes, .. }
        | Question::BuildAndTraverse { shapes, .. }
        | Question::Build { shapes, .. } => shapes,
        Question::Camera { .. }
        | Question::BBox { .. }
        | Question::Radiance { .. }
        | Question::Done => &[],
    }
}

fn of_shape(shape: &Shape) -> f32 {
    match shape {
        Shape::Triangle { vertices, .. } => {
            let corners = vertices.iter().map(|vertex| of_point(vertex.position));
            corners.fold(0.0, f32::max)
        }
        Shape::FlatTriangle { corners, .. } => {
            corners.map(of_point).into_iter().fold(0.0, f32::max)
        }
        Shape::Sphere { center, radius, .. } => of_point(*center) + radius,
    }
}

fn of_point(point: Vec3) -> f32 {
    point.abs().max_element()
}

#[cfg(test)]
mod tests {
    use glam::vec3;
    use protocol::Interval;

    use super::*;

    #[test]
    fn the_largest_number_is_the_scale() {
        let sphere = crate::tests::sphere(vec3(0.0, -4.0, 1.0), 0.5);
        let ray = Ray::new(vec3(3.0, 0.0, 0.0), Vec3::X);
        assert_eq!(of_hit(&[], &ray, None), 3.0);
        assert_eq!(of_hit(&[sphere], &ray, None), 4.5);
        assert_eq!(of_hit(&[sphere], &ray, Some(7.0)), 7.0);
        assert_eq!(of_hit(&[sphere], &ray, Some(-7.0)), 7.0);
        assert_eq!(of_box(Vec3::splat(-8.0), Vec3::ONE, &ray), 8.0);
        assert_eq!(of_box(Vec3::ONE, Vec3::splat(8.0), &ray), 8.0);
        let far = Ray {
            origin: Vec3::splat(-20.0),
            range: Interval::AHEAD,
            ..ray
        };
        assert_eq!(of_box(Vec3::ZERO, Vec3::ONE, &far), 20.0);
        let spheres = vec![sphere];
        for (eye, expected) in [(ray, 4.5), (far, 20.0)] {
            let rays = Rays::List(vec![eye]);
            assert_eq!(of_picture(&spheres, &rays), expected);
            let shapes = spheres.clone();
            assert_eq!(super::shapes(&Question::Shapes { shapes, rays }), spheres);
        }
    }
}
