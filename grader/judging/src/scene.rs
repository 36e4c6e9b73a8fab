//! The scene of a question: the geometry that the question is about, taken from the fields of its
//! subject.

use std::borrow::Cow;

use glam::Vec3;
use protocol::{Question, Ray, Shape, TreeNode, Value};

/// The geometry a question is about.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QuestionScene<'a> {
    /// The shapes.
    pub shapes: Cow<'a, [Shape]>,
    /// The two corners of the question's box, if any.
    pub corners: Option<[Vec3; 2]>,
    /// The nodes of a tree over the shapes and the index of its root, if the exam provides the
    /// tree.
    pub tree: Option<(Cow<'a, [TreeNode]>, u32)>,
    /// The maximum number of shapes in a leaf, if the submission builds a tree over them.
    pub max_leaf_size: Option<u32>,
}

impl<'a> QuestionScene<'a> {
    /// Returns the scene of a question. Returns `None` for a rendered picture, which has a scene
    /// file, and for a question that isn't about shapes or a box.
    pub fn of(question: &'a Question) -> Option<Self> {
        if let Question::Build {
            shapes,
            max_leaf_size,
        } = question
        {
            return Some(QuestionScene {
                shapes: Cow::Borrowed(shapes),
                max_leaf_size: Some(*max_leaf_size),
                ..QuestionScene::default()
            });
        }
        let (mut scene, mut shapes, mut points) = (QuestionScene::default(), None, Vec::new());
        let (mut nodes, mut root) = (None, 0);
        for value in question.table()?.subject().values() {
            if let Value::Shapes(all) = value {
                shapes = Some(all);
            } else if let Value::Nodes(all) = value {
                nodes = Some(all);
            } else if let Value::Index(index) = value {
                root = index;
            } else if let Value::Count(count) = value {
                scene.max_leaf_size = Some(count);
            } else if let Value::Point(point) = value {
                points.push(point);
            }
        }
        scene.corners = points.try_into().ok();
        scene.tree = nodes.map(|nodes| (nodes, root));
        let is_something = shapes.is_some() || scene.corners.is_some();
        scene.shapes = shapes.unwrap_or_default();
        is_something.then_some(scene)
    }
}

/// Returns the ray in a row of a table, if any. If the row also has an interval, the ray is limited
/// to it.
pub fn ray(question: &Question, row: usize) -> Option<Ray> {
    let input = question.table()?.input(row)?;
    let (mut origin, mut dir, mut range) = (None, None, None);
    for value in input.values() {
        if let Value::Point(point) = value {
            origin = Some(point);
        } else if let Value::Direction(direction) = value {
            dir = Some(direction);
        } else if let Value::Range(whole) = value {
            range = range.or(Some(whole));
        } else if let Value::Interval(part) = value {
            range = Some(part);
        }
    }
    Some(Ray {
        origin: origin?,
        dir: dir?,
        range: range?,
    })
}

/// Returns whether a question has geometry to show: shapes, a box, or the scene of a path-traced
/// picture.
pub fn can_be_shown(question: &Question) -> bool {
    matches!(question, Question::Radiance { .. }) || QuestionScene::of(question).is_some()
}

#[cfg(test)]
mod tests {
    use glam::UVec2;
    use protocol::{Corners, Interval, LightQuestion, PinholeCamera, Query, Rows, Table};

    use super::*;
    use crate::tests::PART;

    #[test]
    fn only_questions_about_shapes_or_boxes_have_a_scene() {
        let camera = Table {
            subject: PinholeCamera {
                vertical_fov: 60.0,
                aspect_ratio: 1.0,
                film: UVec2::ONE,
            },
            rows: Rows::Picture(UVec2::ONE),
        };
        assert!(!can_be_shown(&Question::SampleRay(camera)));
        let mirror = Table::of_list((), Vec::new());
        assert!(!can_be_shown(&LightQuestion::Reflect(mirror).into()));
        for item in &PART.items {
            let is_shown = item.task.id() != "camera";
            for question in &item.questions {
                assert_eq!(can_be_shown(&question.question), is_shown, "{}", item.id);
            }
        }
    }

    #[test]
    fn a_box_has_corners_and_its_ray_has_only_the_times() {
        let ray = Ray::new(Vec3::NEG_X, Vec3::X);
        let times = Interval::new(1.0, 2.0);
        let (min, max) = (Vec3::ZERO, Vec3::ONE);
        let question = Question::boxes(Corners { min, max }, vec![Query { ray, times }]);
        let scene = QuestionScene::of(&question).unwrap();
        assert_eq!((scene.corners, scene.shapes.len()), (Some([min, max]), 0));
        let part = super::ray(&question, 0);
        assert_eq!(part, Some(ray.within(times.min, times.max)));
        assert_eq!(super::ray(&question, 1), None);
    }
}
