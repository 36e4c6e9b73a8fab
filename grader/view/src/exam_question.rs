//! Shows questions from the practice exam as scenes. Only the exam embedded in the grader is shown,
//! so this program never reads a file that could contain a final exam.

use std::sync::Arc;

use framework::render::renderer::PathSettings;
use framework::scene::{Camera, Environment, Material, Scene};
use glam::{UVec2, Vec3};
use grader::exam_source::ExamSource;
use grader::handed_out::HandedOut;
use grader::question_ref::QuestionRef;
use judging::describe;
use judging::exam::{ExamQuestion, Key};
use judging::judge::tree::bounds::Bounds;
use judging::scene::{self, QuestionScene};
use protocol::{PinholeCamera, Question, Ray, Shape, Tree};
use view_probe::scene_data::TreeSource;

use crate::error::ViewError;
use crate::model::viewpoint::Viewpoint;
use crate::subject::{ExamRay, Subject, bounds};

/// The film for drawing a question.
const FILM: UVec2 = UVec2::new(480, 360);
/// The vertical field of view, in degrees.
const FOV: f32 = 35.0;

/// Returns the subject that shows a question from the practice exam.
pub fn subject_of_question(
    handed_out: &HandedOut,
    reference: &QuestionRef,
    settings: PathSettings,
) -> Result<Subject, ViewError> {
    let exam = ExamSource::Practice
        .load(handed_out)
        .map_err(ViewError::machine)?
        .exam;
    let item = reference.find_item(&exam).map_err(ViewError::Usage)?;
    let number = reference.number.unwrap_or(1);
    let (question, element) = item.element(number).ok_or_else(|| {
        ViewError::Usage(format!(
            "{} has no question {number}: its questions are numbered from 1 to {count}",
            item.id,
            count = item.count(),
        ))
    })?;
    let name = format!("{}#{number}", item.id);
    subject(
        &name,
        &item.title,
        &item.questions[question],
        element,
        settings,
    )
}

fn subject(
    name: &str,
    title: &str,
    question: &ExamQuestion,
    element: usize,
    settings: PathSettings,
) -> Result<Subject, ViewError> {
    if let Question::Radiance { scene, .. } = &question.question {
        let scene = Scene::from_text(scene).map_err(ViewError::usage)?;
        return Ok(Subject::of_scene(name, scene, settings));
    }
    let Some(QuestionScene {
        shapes,
        corners,
        tree,
        max_leaf_size,
    }) = QuestionScene::of(&question.question)
    else {
        return Err(ViewError::Usage(format!(
            "{name} involves neither shapes nor a box, so there is no scene to show: run `cargo grade \
             --replay {name}` instead"
        )));
    };
    let tree = match tree {
        Some((nodes, root)) => TreeSource::Prebuilt(Tree {
            nodes: nodes.into_owned(),
            root,
            order: Vec::new(),
        }),
        None if max_leaf_size.is_some() => TreeSource::Build,
        None => TreeSource::List,
    };
    let boxes: Vec<[Vec3; 2]> = corners.into_iter().collect();
    let ray = scene::ray(&question.question, element);
    // Leave out the ray, since it may start far away.
    let boxes_seen = boxes.iter().map(|[min, max]| Bounds {
        min: min.as_dvec3(),
        max: max.as_dvec3(),
    });
    let bounds = bounds(shapes.iter().map(Bounds::of_shape).chain(boxes_seen));
    let exam_ray = ExamRay {
        ray,
        boxes,
        asked: describe::element(&question.question, element),
        wanted: describe::answer::wanted(question, element),
    };
    let viewpoint = viewpoint(&bounds, ray.as_ref());
    let scene = Scene {
        about: title.to_owned(),
        camera: Camera {
            pinhole: PinholeCamera {
                vertical_fov: FOV,
                aspect_ratio: aspect_ratio(),
                film: FILM,
            },
            placement: viewpoint.placement,
            fixed_aspect: false,
        },
        environment: Environment::Constant(Vec3::splat(0.8)),
        materials: vec![Material::Lambertian {
            albedo: Vec3::splat(0.7),
        }],
        shape_materials: vec![0; shapes.len()],
        shapes: numbered(shapes.into_owned()),
        max_leaf_size: max_leaf_size.unwrap_or(1) as usize,
    };
    let sweep_cost = if let Key::Tree { sweep_cost, .. } = question.key {
        sweep_cost
    } else {
        None
    };
    let mut subject = Subject::of_scene(name, scene, settings);
    Arc::make_mut(&mut subject.data).tree = tree;
    Ok(Subject {
        bounds,
        viewpoint,
        question: Some(exam_ray),
        sweep_cost,
        ..subject
    })
}

/// Returns a viewpoint that shows the ray from the side, slightly from behind and above.
fn viewpoint(bounds: &Bounds, ray: Option<&Ray>) -> Viewpoint {
    let along = ray.map_or(Vec3::new(-0.4, -0.3, -1.0), |ray| ray.dir);
    let up = if along.y.abs() < 0.9 {
        Vec3::Y
    } else {
        Vec3::Z
    };
    let aside = along.cross(up).normalize_or(Vec3::X);
    let toward = match ray {
        Some(_) => -aside + 0.35 * along - 0.35 * up,
        None => along,
    };
    Viewpoint::looking(toward, up, bounds, FOV, aspect_ratio())
}

fn aspect_ratio() -> f32 {
    FILM.x as f32 / FILM.y as f32
}

/// Numbers the shapes in order, like the shapes in a scene, and returns them.
fn numbered(mut shapes: Vec<Shape>) -> Vec<Shape> {
    for (index, shape) in (0..).zip(&mut shapes) {
        match shape {
            Shape::Triangle { shape, .. }
            | Shape::FlatTriangle { shape, .. }
            | Shape::Sphere { shape, .. } => *shape = index,
        }
    }
    shapes
}
