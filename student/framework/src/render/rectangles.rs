//! Given intersections for scenes made of rectangles, so that part two can be tried before part
//! one's triangles, boxes and trees are written.

use glam::{Vec2, Vec3};
use protocol::{
    Aggregate, CameraRays, Hierarchy, Interval, PinholeCamera, Ray, Shape, Submission, Trace,
    TreeNode, Vertex,
};

use crate::render::tracer::{Intersect, Surface};
use crate::scene::Scene;
use crate::submission::List;

/// How far a rectangle's fourth corner may be from its place, as a fraction of the diagonal.
const TOLERANCE: f32 = 1e-4;

/// Uses a submission's camera and finds hits on rectangles itself.
pub struct GivenRectangles<'a>(pub &'a dyn Submission);

/// A scene made of rectangles, with the given intersections. It needs no code for part one.
pub struct RectangleScene {
    scene: Scene,
    rectangles: Rectangles,
}

/// A parallelogram with corners p, p + a, p + a + b and p + b.
struct Rectangle {
    corner: Vertex,
    a: Vec3,
    b: Vec3,
    /// The change of the texture coordinates along a and b.
    uv: [Vec2; 2],
    /// The numbers of the two triangles that the rectangle is made of.
    triangles: [u32; 2],
}

/// A list of rectangles. Each ray is tested against all of them.
struct Rectangles(Vec<Rectangle>);

/// Returns the index of the first shape that isn't half of a rectangle, or `None` if the shapes are
/// the halves of rectangles, two by two.
pub fn first_other_shape(shapes: &[Shape]) -> Option<usize> {
    let pairs = shapes
        .chunks(2)
        .position(|pair| Rectangle::of(pair).is_none());
    pairs.map(|index| 2 * index)
}

impl Rectangle {
    /// Joins the two triangles that a polygon with four corners is split into.
    fn of(pair: &[Shape]) -> Option<Self> {
        let [
            Shape::Triangle {
                vertices: [p, q, r],
                shape: first,
            },
            Shape::Triangle {
                vertices: [p_again, r_again, s],
                shape: second,
            },
        ] = pair
        else {
            return None;
        };
        let (a, b) = (q.position - p.position, s.position - p.position);
        let gap = (r.position - p.position - a - b).length();
        let is_rectangle = p == p_again && r == r_again && gap <= TOLERANCE * (a + b).length();
        is_rectangle.then_some(Rectangle {
            corner: *p,
            a,
            b,
            uv: [q.uv - p.uv, s.uv - p.uv],
            triangles: [*first, *second],
        })
    }

    /// Returns the ray's hit: the point of the plane at which both coordinates along the sides are
    /// from 0 to 1.
    fn hit(&self, ray: &Ray) -> Option<Trace> {
        let normal = self.a.cross(self.b);
        let distance = (self.corner.position - ray.origin).dot(normal) / ray.dir.dot(normal);
        if !ray.range.contains(distance) {
            return None;
        }
        let point = ray.at(distance);
        let from_corner = point - self.corner.position;
        // Each coordinate is the part of the area on that side of the point.
        let along = |side: Vec3, other: Vec3| {
            from_corner.cross(other).dot(normal) / side.cross(other).dot(normal)
        };
        let (x, y) = (along(self.a, self.b), along(self.b, self.a));
        let is_inside = (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y);
        is_inside.then(|| Trace {
            distance,
            position: point,
            normal: self.corner.normal,
            uv: self.corner.uv + x * self.uv[0] + y * self.uv[1],
            origin: ray.origin,
            shape: self.triangles[usize::from(y > x)],
        })
    }
}

impl Submission for GivenRectangles<'_> {
    fn camera(&self, pinhole: &PinholeCamera) -> Box<dyn CameraRays> {
        self.0.camera(pinhole)
    }

    fn primitive_list(&self, shapes: &[Shape]) -> Box<dyn Aggregate> {
        Box::new(Rectangles::of(shapes))
    }

    fn build(&self, shapes: &[Shape], _max_leaf_size: usize) -> Box<dyn Hierarchy> {
        Box::new(List(self.primitive_list(shapes)))
    }

    fn prebuilt_tree(&self, shapes: &[Shape], _: &[TreeNode], _: usize) -> Box<dyn Hierarchy> {
        self.build(shapes, 1)
    }

    fn intersect_box(&self, _: Vec3, _: Vec3, _: &Ray, _: Interval) -> Option<Interval> {
        // There are no boxes without a tree.
        None
    }
}

impl RectangleScene {
    /// Uses the rectangles of a scene. Other shapes are ignored.
    pub fn new(scene: Scene) -> Self {
        let rectangles = Rectangles::of(&scene.shapes);
        RectangleScene { scene, rectangles }
    }

    /// Returns the scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }
}

impl Intersect for RectangleScene {
    fn intersect(&self, ray: &Ray) -> Option<Surface<'_>> {
        let trace = self.rectangles.closest_hit(ray)?;
        Surface::new(&self.scene, ray, &trace).ok()
    }
}

impl Rectangles {
    fn of(shapes: &[Shape]) -> Self {
        Rectangles(shapes.chunks(2).filter_map(Rectangle::of).collect())
    }
}

impl Aggregate for Rectangles {
    fn closest_hit(&self, ray: &Ray) -> Option<Trace> {
        let hits = self.0.iter().map(|rectangle| rectangle.hit(ray));
        hits.fold(None, Trace::nearer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{CORRECT, scene};

    fn shapes(points: &str) -> Vec<Shape> {
        let grey = r#""grey": { "lambertian": { "albedo": [0.5, 0.5, 0.5] } }"#;
        let polygon = format!(r#"{{ "polygon": {{ "points": {points}, "material": "grey" }} }}"#);
        scene(0.0, grey, &polygon).shapes
    }

    #[test]
    fn a_rectangle_is_hit_from_both_sides_and_only_inside() {
        let shapes = shapes("[[-1, -1, -3], [3, -1, -3], [3, 1, -3], [-1, 1, -3]]");
        assert_eq!(first_other_shape(&shapes), None);
        let list = GivenRectangles(&CORRECT).primitive_list(&shapes);
        let hit = |x: f32, y: f32, dz: f32| {
            let ray = Ray::new(Vec3::new(x, y, -3.0 - 2.0 * dz), Vec3::new(0.0, 0.0, dz));
            list.closest_hit(&ray)
        };
        for (x, y, shape, uv) in [(2.0, -0.5, 0, [0.75, 0.25]), (0.0, 0.5, 1, [0.25, 0.75])] {
            for dz in [1.0, -1.0] {
                let trace = hit(x, y, dz).expect("the point is inside");
                assert_eq!((trace.distance, trace.shape), (2.0, shape));
                assert_eq!((trace.normal, trace.uv.x), (Vec3::Z, uv[0]));
                assert_eq!(trace.position, Vec3::new(x, y, -3.0));
            }
        }
        for (x, y) in [(-1.1, 0.0), (3.1, 0.0), (0.0, -1.1), (0.0, 1.1)] {
            assert_eq!(hit(x, y, 1.0), None, "({x}, {y})");
        }
    }

    #[test]
    fn only_rectangles_and_parallelograms_are_supported() {
        for (points, other) in [
            ("[[0, 0, 0], [2, 0, 0], [3, 1, 0], [1, 1, 0]]", None),
            ("[[0, 0, 0], [2, 0, 0], [2.1, 1, 0], [0, 1, 0]]", Some(0)),
            ("[[0, 0, 0], [2, 0, 0], [2, 1, 0]]", Some(0)),
        ] {
            assert_eq!(first_other_shape(&shapes(points)), other, "{points}");
        }
    }
}
