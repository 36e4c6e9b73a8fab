//! Given: one kind of thing for the tree to hold, whichever shape it is.

use protocol::{Ray, Shape, Trace};

use crate::bbox::BBox;
use crate::sphere::Sphere;
use crate::triangle::Triangle;

/// Anything that a ray can hit.
#[derive(Clone, Copy, Debug)]
pub enum Primitive {
    /// A triangle of a mesh.
    Triangle(Triangle),
    /// A sphere.
    Sphere(Sphere),
}

impl Primitive {
    /// The primitive that a scene or a question describes.
    pub fn new(shape: &Shape) -> Self {
        match *shape {
            Shape::Triangle {
                vertices: [p0, p1, p2],
                material,
            } => Primitive::Triangle(Triangle::new(p0, p1, p2, material)),
            Shape::FlatTriangle { corners, material } => {
                let [p0, p1, p2] = Shape::flat_triangle_vertices(corners);
                Primitive::Triangle(Triangle::new(p0, p1, p2, material))
            }
            Shape::Sphere {
                center,
                radius,
                material,
            } => Primitive::Sphere(Sphere::new(center, radius, material)),
        }
    }

    /// The tightest box around the primitive.
    pub fn bbox(&self) -> BBox {
        match self {
            Primitive::Triangle(triangle) => triangle.bbox(),
            Primitive::Sphere(sphere) => sphere.bbox(),
        }
    }

    /// Where the ray first meets the primitive within `ray.range`, if anywhere.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        match self {
            Primitive::Triangle(triangle) => triangle.hit(ray),
            Primitive::Sphere(sphere) => sphere.hit(ray),
        }
    }

    /// What the primitive is made of.
    pub fn material(&self) -> u32 {
        match self {
            Primitive::Triangle(triangle) => triangle.material,
            Primitive::Sphere(sphere) => sphere.material,
        }
    }
}
