//! A submission to test the framework with: no real one is at hand here.

use glam::{UVec2, Vec2, Vec3};
use protocol::{Answer, Question, Ray, Shape, Trace, Tree};

use crate::scene::Scene;
use crate::submission::{Submission, World};

/// Spheres only, by a formula of our own; `spoil` is applied to every answer.
pub(crate) struct Balls {
    pub(crate) spoil: fn(Trace) -> Trace,
}

/// Answers as it should.
pub(crate) const HONEST: Balls = Balls {
    spoil: |trace| trace,
};

struct BallsWorld {
    shapes: Vec<Shape>,
    film: UVec2,
    spoil: fn(Trace) -> Trace,
}

impl Submission for Balls {
    fn world(&self, scene: &Scene) -> Box<dyn World> {
        Box::new(BallsWorld {
            shapes: scene.shapes.clone(),
            film: scene.camera.lens.film,
            spoil: self.spoil,
        })
    }

    fn answer(&self, _: &Question) -> Answer {
        Answer::Done
    }
}

impl World for BallsWorld {
    /// A field of view of 90° on a square sensor.
    fn camera_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let place = (pixel.as_vec2() + offset) / self.film.as_vec2() * 2.0 - 1.0;
        Ray::new(Vec3::ZERO, place.extend(-1.0))
    }

    fn hit(&self, ray: &Ray) -> Option<Trace> {
        let meet = |shape: &Shape| meet(shape, ray);
        let nearest = self.shapes.iter().map(meet).fold(None, Trace::nearer);
        nearest.map(self.spoil)
    }

    fn tree(&self) -> Tree {
        Tree::default()
    }
}

/// Geometrically: the closest approach to the centre, then half a chord to either side.
fn meet(shape: &Shape, ray: &Ray) -> Option<Trace> {
    let Shape::Sphere {
        center,
        radius,
        material,
    } = *shape
    else {
        return None;
    };
    let along = (center - ray.origin).dot(ray.dir);
    let miss = (center - ray.origin) - along * ray.dir;
    let half_chord = (radius * radius - miss.length_squared()).max(0.0).sqrt();
    let times = [along - half_chord, along + half_chord];
    let touches = miss.length() <= radius;
    let distance = times
        .into_iter()
        .find(|&t| ray.range.contains(t) && touches)?;
    let position = ray.at(distance);
    Some(Trace {
        distance,
        position,
        normal: (position - center) / radius,
        uv: Vec2::ZERO,
        origin: ray.origin,
        material,
    })
}
