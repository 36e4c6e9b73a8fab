//! A snapshot test of the captions for common mistakes.

mod light;
mod rays;
mod trees;

use glam::{Vec3, vec2, vec3};
use judging::exam::{ExamQuestion, ExpectedRows, Key};
use protocol::{Answer, ElementOutcome, Question, Ray, Shape, Trace};

use crate::drawing::draw;

#[test]
fn captions_name_the_mistake() {
    let all = [
        ("missing or misplaced hits", rays::misplaced_hits()),
        ("hits with another wrong field", rays::wrong_fields()),
        ("box intervals", rays::box_intervals()),
        ("camera rays", rays::camera_rays()),
        ("built trees", trees::built_trees()),
        ("traversals", trees::traversals()),
        ("directions at a surface", light::directions()),
        ("densities and attenuations", light::values()),
        ("directions on the sphere", light::spheres()),
    ];
    let sections = all.map(|(title, captions)| format!("{title}:\n{captions}"));
    insta::assert_snapshot!(sections.join("\n\n"));
}

/// Returns a question about a table that judges these quantities.
fn table(question: impl Into<Question>, judged: &[&str], rows: ExpectedRows) -> ExamQuestion {
    ExamQuestion::new(question.into(), Key::table(judged, rows))
}

fn caption(question: &ExamQuestion, answer: Answer) -> String {
    let drawing = draw(question, 0, Some(&answer));
    drawing.map_or("(nothing)".to_owned(), |drawing| drawing.caption)
}

/// Returns the captions for several answers, one per line.
fn captions(question: &ExamQuestion, answers: impl IntoIterator<Item = Answer>) -> String {
    let answers = answers.into_iter();
    let lines: Vec<String> = answers.map(|answer| caption(question, answer)).collect();
    lines.join("\n")
}

fn ball(x: f32, shape: u32) -> Shape {
    Shape::Sphere {
        center: vec3(x, 0.0, -5.0),
        radius: 1.0,
        shape,
    }
}

fn ahead(min: f32, max: f32) -> Ray {
    Ray::new(Vec3::ZERO, Vec3::NEG_Z).within(min, max)
}

fn trace(distance: f32) -> Trace {
    Trace {
        distance,
        position: vec3(0.0, 0.0, -distance),
        normal: Vec3::Z,
        uv: vec2(0.25, 0.5),
        origin: Vec3::ZERO,
        shape: 7,
    }
}

fn hits(trace: Option<Trace>) -> Answer {
    Answer::Hits(vec![ElementOutcome::Value(trace)])
}
