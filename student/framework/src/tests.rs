//! Test helpers: a scene, a temporary folder and a minimal submission.

use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};

use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, PinholeCamera, Ray, Shape, Trace, TreeNode};

use crate::scene::Scene;
use crate::submission::{Aggregate, CameraRays, Hierarchy, List, Submission};

/// Returns a scene with a camera at the origin that looks down −z.
pub(crate) fn scene(environment: f32, materials: &str, shapes: &str) -> Scene {
    let text = format!(
        r#"{{
            "camera": {{ "vertical_fov": 90, "film": [8, 8],
                "position": [0, 0, 0], "look_at": [0, 0, -1], "up": [0, 1, 0] }},
            "environment": [{environment}, {environment}, {environment}],
            "materials": {{ {materials} }},
            "shapes": [ {shapes} ]
        }}"#
    );
    Scene::from_text(&text).expect("the scene is valid")
}

/// A temporary folder that is removed at the end of the test.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("framework-{}-{number}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).expect("the folder can be created");
        Folder(folder)
    }

    pub(crate) fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, contents).expect("the file can be written");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // If this fails, the system removes the temporary folder later.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A submission that only supports spheres.
pub(crate) struct SphereSubmission {
    /// Returns the ray through a position on the film, whose coordinates range from −1 to 1.
    pub(crate) ray: fn(Vec2) -> Ray,
    /// Changes each hit.
    pub(crate) alter: fn(&mut Trace),
}

/// A submission that returns correct hits, and whose camera has a 90° field of view and a square
/// sensor.
pub(crate) const CORRECT: SphereSubmission = SphereSubmission {
    ray: |position| Ray::new(Vec3::ZERO, position.extend(-1.0)),
    alter: |_| {},
};

struct SquareCamera {
    film: UVec2,
    ray: fn(Vec2) -> Ray,
}

struct SphereList {
    shapes: Vec<Shape>,
    alter: fn(&mut Trace),
}

impl Submission for SphereSubmission {
    fn camera(&self, pinhole: &PinholeCamera) -> Box<dyn CameraRays> {
        Box::new(SquareCamera {
            film: pinhole.film,
            ray: self.ray,
        })
    }

    fn build(&self, shapes: &[Shape], _: usize) -> Box<dyn Hierarchy> {
        Box::new(List(self.primitive_list(shapes)))
    }

    fn primitive_list(&self, shapes: &[Shape]) -> Box<dyn Aggregate> {
        Box::new(SphereList {
            shapes: shapes.to_vec(),
            alter: self.alter,
        })
    }

    fn prebuilt_tree(&self, shapes: &[Shape], _: &[TreeNode], _: usize) -> Box<dyn Hierarchy> {
        self.build(shapes, 1)
    }

    fn intersect_box(&self, _: Vec3, _: Vec3, _: &Ray, _: Interval) -> Option<Interval> {
        None
    }
}

impl CameraRays for SquareCamera {
    fn ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        (self.ray)((pixel.as_vec2() + offset) / self.film.as_vec2() * 2.0 - 1.0)
    }
}

impl Aggregate for SphereList {
    fn closest_hit(&self, ray: &Ray) -> Option<Trace> {
        let hit = |shape: &Shape| intersect(shape, ray);
        let nearest = self.shapes.iter().map(hit).fold(None, Trace::nearer);
        nearest.map(|mut trace| {
            (self.alter)(&mut trace);
            trace
        })
    }
}

/// Intersects a ray with a sphere geometrically: finds the point on the ray that is closest to the
/// centre, then moves half a chord in either direction.
fn intersect(shape: &Shape, ray: &Ray) -> Option<Trace> {
    let Shape::Sphere {
        center,
        radius,
        shape,
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
        shape,
    })
}
