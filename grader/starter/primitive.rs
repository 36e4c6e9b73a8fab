//! Given: the primitives that a BVH holds, which are triangles and spheres.

use protocol::{Ray, Shape, Trace};

use crate::bbox::BBox;
use crate::sphere::Sphere;
use crate::triangle::Triangle;

/// A shape that a ray can hit.
#[derive(Clone, Copy, Debug)]
pub enum Primitive {
    /// A triangle of a mesh.
    Triangle(Triangle),
    /// A sphere.
    Sphere(Sphere),
}

impl Primitive {
    /// Creates the primitive that a scene or a question describes.
    pub fn new(shape: &Shape) -> Self {
        match *shape {
            Shape::Triangle {
                vertices: [p0, p1, p2],
                shape,
            } => Primitive::Triangle(Triangle::new(p0, p1, p2, shape)),
            Shape::FlatTriangle { corners, shape } => {
                let [p0, p1, p2] = Shape::flat_triangle_vertices(corners);
                Primitive::Triangle(Triangle::new(p0, p1, p2, shape))
            }
            Shape::Sphere {
                center,
                radius,
                shape,
            } => Primitive::Sphere(Sphere::new(center, radius, shape)),
        }
    }

    /// Returns the tightest box around the primitive.
    pub fn bbox(&self) -> BBox {
        match self {
            Primitive::Triangle(triangle) => triangle.bbox(),
            Primitive::Sphere(sphere) => sphere.bbox(),
        }
    }

    /// Returns the ray's first hit on the primitive, or `None` if there is none within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        match self {
            Primitive::Triangle(triangle) => triangle.hit(ray),
            Primitive::Sphere(sphere) => sphere.hit(ray),
        }
    }

    /// Returns the number of the primitive's shape.
    pub fn number(&self) -> u32 {
        match self {
            Primitive::Triangle(triangle) => triangle.shape,
            Primitive::Sphere(sphere) => sphere.shape,
        }
    }
}
