//! Tests of the captions for rays, shapes and boxes.

use glam::{UVec2, Vec2, Vec3, vec2, vec3};
use judging::drawing_data::DrawingData;
use judging::exam::{ExamQuestion, ExpectedRows, Key};
use protocol::{
    Answer, Corners, ElementOutcome, Geometry, Interval, PinholeCamera, Query, Question, Ray,
    Sample, Table, Trace,
};

use super::{ahead, ball, caption, captions, hits, table, trace};

fn sphere(ray: Ray, judged: &str, hit: Option<Trace>) -> ExamQuestion {
    let shapes = vec![ball(0.0, 7)];
    let question = Question::hits(Geometry::List { shapes }, vec![ray]);
    table(question, &[judged], ExpectedRows::Hits(vec![hit]))
}

/// Returns the captions for missing or misplaced hits.
pub(super) fn misplaced_hits() -> String {
    let near = sphere(ahead(0.0, f32::INFINITY), "distance", Some(trace(4.0)));
    let far = sphere(ahead(4.5, 9.0), "distance", Some(trace(6.0)));
    let none = sphere(ahead(0.0, 3.0), "distance", None);
    let of_near = [
        None,
        Some(trace(6.0)),
        Some(trace(-4.0)),
        Some(trace(f32::NAN)),
    ];
    let lines = [
        captions(&near, of_near.map(hits)),
        caption(&near, Answer::Hits(vec![ElementOutcome::Skipped])),
        captions(&far, [None, Some(trace(4.0))].map(hits)),
        captions(&none, [Some(trace(4.0))].map(hits)),
    ];
    lines.join("\n")
}

/// Returns the captions for hits in which another field is wrong.
pub(super) fn wrong_fields() -> String {
    let ray = ahead(0.0, f32::INFINITY);
    type Change = fn(&mut Trace);
    let cases: [(&str, Change); 8] = [
        ("position", |trace| trace.position.z = 4.0),
        ("normal", |trace| trace.normal = Vec3::NEG_Z),
        ("normal", |trace| trace.normal = vec3(0.0, 1.0, 1.0)),
        ("normal", |trace| trace.normal = Vec3::ZERO),
        ("unit_normal", |trace| trace.normal *= 2.0),
        ("uv", |trace| trace.uv = vec2(0.5, 0.25)),
        ("origin", |trace| trace.origin = Vec3::ONE),
        ("shape", |trace| trace.shape = 0),
    ];
    let lines = cases.map(|(judged, change)| {
        let mut wrong = trace(4.0);
        change(&mut wrong);
        caption(&sphere(ray, judged, Some(trace(4.0))), hits(Some(wrong)))
    });
    lines.join("\n")
}

/// Returns the captions for box intervals.
pub(super) fn box_intervals() -> String {
    let corners = Corners {
        min: vec3(2.0, -1.0, -1.0),
        max: vec3(4.0, 1.0, 1.0),
    };
    let query = Query {
        ray: Ray::new(Vec3::ZERO, Vec3::X),
        times: Interval::AHEAD,
    };
    let question = Question::boxes(corners, vec![query]);
    let always = Interval::new(f32::NEG_INFINITY, f32::INFINITY);
    let exam_question = |span| ExamQuestion {
        question: question.clone(),
        key: Key::spans(vec![span]),
        drawing_data: DrawingData::Slabs(vec![[Interval::new(2.0, 4.0), always, always]]),
    };
    let span = |min, max| Some(Interval::new(min, max));
    let answer = |span| Answer::Spans(vec![ElementOutcome::Value(span)]);
    let lines = [
        captions(
            &exam_question(span(2.0, 4.0)),
            [None, span(0.0, f32::INFINITY)].map(answer),
        ),
        captions(&exam_question(None), [span(4.0, 2.0)].map(answer)),
    ];
    lines.join("\n")
}

/// Returns the captions for camera rays.
pub(super) fn camera_rays() -> String {
    let camera = PinholeCamera {
        vertical_fov: 90.0,
        aspect_ratio: 1.0,
        film: UVec2::new(4, 4),
    };
    let sample = Sample {
        pixel: UVec2::new(2, 2),
        offset: Vec2::ZERO,
    };
    let exam_question = table(
        Question::SampleRay(Table::of_list(camera, vec![sample])),
        &["direction", "unit_direction"],
        ExpectedRows::Rays(vec![Vec3::NEG_Z]),
    );
    let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
    let dir = |dir| Ray { dir, ..ray };
    let rays = [
        Ray::new(Vec3::ZERO, vec3(0.25, -0.5, -1.0)),
        dir(Vec3::Z),
        dir(Vec3::NAN),
        dir(ray.dir * 2.0),
        Ray {
            origin: Vec3::ONE,
            ..ray
        },
        ray.within(0.0, 1.0),
    ];
    let answers = rays.map(|ray| Answer::Rays(vec![ElementOutcome::Value(ray)]));
    captions(&exam_question, answers)
}
