//! Data for the drawings in a report: the intermediate results of a correct solution, shown next to
//! a wrong answer. The data is added to an exam after its questions have been generated.

use judging::drawing_data::{DrawingData, TraversalStep};
use judging::exam::Exam;
use protocol::{Interval, LightQuestion, Question, Ray, Rows};

use crate::oracle::bbox::Bounds;
use crate::oracle::light::numbers_of_path;
use crate::oracle::light::path_steps::path_steps;
use crate::oracle::light::room::Room;
use crate::oracle::{Ray64, scan, sweep};
use crate::tree::Tree;
use crate::tree::traversal::{Traversal, TraversalRule};

/// The rule for the traversal that is drawn. It describes the correct traversal that a student is
/// most likely to write.
const RULE: TraversalRule = TraversalRule {
    left_first: true,
    tests_on_entry: false,
    conservative: false,
};

/// Adds the data for drawings to every question that has a drawing.
pub fn with_drawing_data(mut exam: Exam) -> Exam {
    for asked in exam.items.iter_mut().flat_map(|item| &mut item.questions) {
        asked.drawing_data = drawing_data(&asked.question);
    }
    exam
}

fn drawing_data(question: &Question) -> DrawingData {
    if let Some((tree, Rows::List(rays))) = Tree::in_question(question) {
        let steps = rays.iter().map(|ray| traversal_steps(&tree, ray));
        return DrawingData::Traversals(steps.collect());
    }
    if let Question::BBoxHit(table) = question {
        let bounds = Bounds::new(table.subject.min, table.subject.max);
        let queries = table.rows.to_vec();
        return DrawingData::Slabs(
            queries
                .iter()
                .map(|query| slabs(&bounds, &query.ray))
                .collect(),
        );
    }
    // Costs are relative to the root's area, and an empty tree has no root.
    if let Question::Build {
        shapes,
        max_leaf_size,
    } = question
        && !shapes.is_empty()
    {
        let boxes: Vec<Bounds> = shapes.iter().map(scan::bounds).collect();
        return DrawingData::Sweep(sweep::upper_levels(&boxes, *max_leaf_size as usize));
    }
    if let Question::Light(LightQuestion::Radiance(table)) = question {
        let room = Room::in_question(&table.subject);
        let calls = table.rows.to_vec();
        let paths = calls.iter().map(|call| {
            let numbers = numbers_of_path(call);
            path_steps(&room, &Ray64::from(&call.ray), &numbers)
        });
        return DrawingData::Paths(paths.collect());
    }
    DrawingData::None
}

/// For each axis, returns the interval in which the ray's line is between the box's two planes
/// perpendicular to that axis.
fn slabs(bounds: &Bounds, ray: &Ray) -> [Interval; 3] {
    let line = Ray64::from(ray).within(Interval::new(f32::NEG_INFINITY, f32::INFINITY));
    [0, 1, 2].map(|axis| match bounds.slab(axis).span(&line) {
        Some((enter, leave)) => Interval::new(enter as f32, leave as f32),
        None => Interval::new(f32::INFINITY, f32::NEG_INFINITY),
    })
}

fn traversal_steps(tree: &Tree, ray: &Ray) -> Vec<TraversalStep> {
    let ray64 = Ray64::from(ray);
    let traversal = Traversal::correct(tree, &ray64, RULE);
    let step = |&(index, is_entered): &(usize, bool)| TraversalStep {
        node: index as u32,
        is_entered,
        span: tree
            .bounds(index)
            .span(&ray64.ahead())
            .map(|(enter, leave)| Interval::new(enter as f32, leave as f32)),
    };
    traversal.reached_nodes.iter().map(step).collect()
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3, vec3};

    use super::*;
    use crate::items::{self, meshes};
    use crate::tree::construction;

    #[test]
    fn an_axis_parallel_ray_is_between_the_other_planes_always_or_never() {
        let bounds = Bounds {
            min: DVec3::NEG_ONE,
            max: DVec3::ONE,
        };
        let ray = Ray::new(vec3(-3.0, 0.5, 7.0), Vec3::X);
        let always = Interval::new(f32::NEG_INFINITY, f32::INFINITY);
        let never = Interval::new(f32::INFINITY, f32::NEG_INFINITY);
        let expected = [Interval::new(2.0, 4.0), always, never];
        assert_eq!(slabs(&bounds, &ray), expected);
    }

    #[test]
    fn traversal_visits_the_nearer_leaf_first_and_prunes_the_farther() {
        let wall = |x: f64, shape| {
            let corner = |y: f64, z: f64| DVec3::new(x + 0.1 * y, y, z);
            let corners = [corner(-2.0, -1.0), corner(2.0, -1.0), corner(0.0, 2.0)];
            meshes::flat_triangle(corners, shape)
        };
        let tree = construction::median_split(vec![wall(1.0, 0), wall(5.0, 1)], 1);
        let steps = traversal_steps(&tree, &Ray::new(Vec3::ZERO, Vec3::X));
        let reached: Vec<_> = steps
            .iter()
            .map(|step| (step.node, step.is_entered))
            .collect();
        assert_eq!(reached, [(2, true), (0, true), (1, false)]);
        assert!(
            steps[2].span.is_some(),
            "the ray hits its box, beyond the closest hit"
        );
    }

    #[test]
    fn drawing_data_fits_its_questions() {
        let exam = with_drawing_data(items::exam_of_boxes());
        for question in exam.items.iter().flat_map(|item| &item.questions) {
            assert!(!question.drawing_data.is_none());
            assert_eq!(question.drawing_data.problem(&question.question), None);
        }
    }
}
