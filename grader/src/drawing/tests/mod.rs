//! Tests that any answer from a submission results in a small, well-formed drawing or in no drawing
//! at all.

mod captions;

use std::mem::discriminant;
use std::sync::LazyLock;

use glam::{Vec2, Vec3};
use judging::exam::ExamQuestion;
use proptest::prelude::*;
use protocol::light::LightQuestion;
use protocol::{
    Answer, Color, Density, ElementOutcome, Fraction, Interval, LocalDirection, Panic, Question,
    Ray, Scattered, Trace, Tree, TreeNode,
};
use roxmltree::Document;

use super::{Drawing, draw};
use crate::handed_out::{LIGHT, RAYS};
use crate::inputs::exam_source::ExamSource;

/// An answer that doesn't fit any question that has a drawing.
const NO_PICTURE: Answer = Answer::Picture(ElementOutcome::Skipped);

/// A size that no drawing reaches.
const MAX_BYTES: usize = 130_000;

/// The first question of each item in both practice exams.
static QUESTIONS: LazyLock<Vec<ExamQuestion>> = LazyLock::new(|| {
    let exams = [&RAYS, &LIGHT].map(|handed_out| ExamSource::Practice.load(handed_out));
    let exams = exams.map(|exam| exam.expect("the practice exam is embedded").exam);
    let items = exams.into_iter().flat_map(|exam| exam.items);
    let first = items.filter_map(|item| item.questions.into_iter().next());
    first.collect()
});

/// Generates numbers that a submission's answer may contain, including extreme values.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => -5.0f32..5.0,
        2 => prop::num::f32::ANY,
        1 => prop::sample::select(vec![0.0, -0.0, f32::NAN, f32::INFINITY, 1e38, -1e38, 1e-40]),
    ]
}

fn point() -> impl Strategy<Value = Vec3> {
    [number(), number(), number()].prop_map(Vec3::from_array)
}

fn interval() -> impl Strategy<Value = Interval> {
    [number(), number()].prop_map(|[min, max]| Interval::new(min, max))
}

fn outcome<T: Clone + std::fmt::Debug>(
    value: impl Strategy<Value = T>,
) -> impl Strategy<Value = ElementOutcome<T>> {
    let panic = Panic {
        message: "<script>\"&".to_owned(),
        location: "bvh.rs:1".to_owned(),
    };
    prop_oneof![
        8 => value.prop_map(ElementOutcome::Value),
        1 => Just(ElementOutcome::Panicked(panic)),
        1 => Just(ElementOutcome::Skipped),
    ]
}

fn trace() -> impl Strategy<Value = Trace> {
    let fields = (
        point(),
        point(),
        point(),
        number(),
        [number(), number()],
        0..30u32,
    );
    fields.prop_map(|(position, normal, origin, distance, uv, shape)| Trace {
        distance,
        position,
        normal,
        uv: Vec2::from_array(uv),
        origin,
        shape,
    })
}

fn scattered() -> impl Strategy<Value = Scattered> {
    let fields = (point(), point(), prop::option::of(number()));
    fields.prop_map(|(direction, attenuation, pdf)| Scattered {
        direction,
        attenuation,
        pdf,
    })
}

fn tree() -> impl Strategy<Value = Tree> {
    let node = (point(), point(), [0..9u32, 0..9u32, 0..9u32, 0..9u32]);
    let node = node.prop_map(|(min, max, [start, size, l, r])| TreeNode {
        min,
        max,
        start,
        size,
        l,
        r,
    });
    let order = prop::collection::vec(0..12u32, 0..12);
    (prop::collection::vec(node, 0..9), 0..9u32, order).prop_map(|(nodes, root, order)| Tree {
        nodes,
        root,
        order,
    })
}

/// Generates the index of a question, the element to draw, and an answer.
fn any_answer() -> impl Strategy<Value = (usize, usize, Answer)> {
    let ray = (point(), point(), interval());
    let ray = ray.prop_map(|(origin, dir, range)| Ray { origin, dir, range });
    let answers = (
        outcome(ray),
        outcome(prop::option::of(trace())),
        outcome(prop::option::of(interval())),
        outcome(tree()),
        outcome(scattered()),
    );
    let indices = (0..QUESTIONS.len(), any::<prop::sample::Index>());
    (indices, answers).prop_map(|((index, element), (ray, hit, span, tree, scattered))| {
        let ExamQuestion { question, key, .. } = &QUESTIONS[index];
        let count = question.count();
        let direction = |one: &Scattered| LocalDirection {
            direction: one.direction,
        };
        let optional_direction = |one: &Scattered| one.pdf.map(|_| direction(one));
        let value = |one: &Scattered| one.attenuation;
        let color = |one| Color { value: value(one) };
        let density = |one| Density { pdf: value(one).x };
        let fraction = |one| Fraction {
            fraction: value(one).x,
        };
        let of_each_kind = [
            Answer::Rays(vec![ray; count]),
            Answer::Hits(vec![hit; count]),
            Answer::Spans(vec![span; count]),
            Answer::Directions(vec![scattered.map(direction); count]),
            Answer::OptionalDirections(vec![scattered.map(optional_direction); count]),
            Answer::Colors(vec![scattered.map(color); count]),
            Answer::Densities(vec![scattered.map(density); count]),
            Answer::Fractions(vec![scattered.map(fraction); count]),
            Answer::Scattered(vec![scattered; count]),
            Answer::Tree(tree),
            NO_PICTURE,
        ];
        let expected = match (key.answer(), question) {
            (Some(answer), _) => answer,
            (None, Question::Light(_)) => Answer::Directions(Vec::new()),
            (None, _) => Answer::Tree(ElementOutcome::Skipped),
        };
        let is_of_kind = |answer: &Answer| discriminant(answer) == discriminant(&expected);
        let answer = of_each_kind.into_iter().find(is_of_kind);
        let answer = answer.expect("every kind is in the list");
        (index, element.index(count.max(1)), answer)
    })
}

fn assert_well_formed(drawing: &Drawing) {
    let svg = &drawing.svg;
    assert!(svg.len() < MAX_BYTES, "{} bytes", svg.len());
    let document = Document::parse(svg).expect("well-formed XML");
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "svg");
    assert_eq!(root.attribute("role"), Some("img"));
    for name in ["title", "desc"] {
        let mut children = root.children();
        let found = children.find(|child| child.tag_name().name() == name);
        let text = found.and_then(|found| found.text());
        assert!(text.is_some(), "no {name}");
    }
    for element in root.descendants().filter(|node| node.is_element()) {
        let name = element.tag_name().name();
        let known = ["svg", "title", "desc", "path", "rect", "circle", "text"];
        assert!(known.contains(&name), "<{name}>");
        for attribute in element.attributes() {
            let (name, value) = (attribute.name(), attribute.value());
            assert_ne!(name, "id", "ids would clash: a page has several drawings");
            let wild = ["NaN", "inf"].iter().any(|word| value.contains(word));
            assert!(!wild, "{name}={value}");
        }
    }
    assert!(!drawing.caption.is_empty() && drawing.caption.len() < 400);
    assert!(!svg.contains("script") && !drawing.caption.contains("script"));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_answer_gives_a_small_well_formed_drawing_or_none((index, element, answer) in any_answer()) {
        if let Some(drawing) = draw(&QUESTIONS[index], element, Some(&answer)) {
            assert_well_formed(&drawing);
        }
    }
}

#[test]
fn draws_the_expected_result_without_an_answer() {
    for question in QUESTIONS.iter() {
        let drawing = draw(question, 0, None);
        drawing.iter().for_each(assert_well_formed);
        let is_ray = matches!(
            &question.question,
            Question::SampleRay(_) | Question::Hit(_) | Question::BBoxHit(_)
        );
        // Direct light isn't drawn, and how directions are spread is up to the submission.
        let is_light = matches!(&question.question, Question::Light(table) if !matches!(
            table,
            LightQuestion::Direct(_) | LightQuestion::UniformSphere(_)
        ));
        if is_ray || is_light {
            assert!(drawing.is_some(), "{:?}", question.key);
        }
    }
}

#[test]
fn ignores_missing_elements_and_answers_of_another_kind() {
    for question in QUESTIONS.iter() {
        assert_eq!(draw(question, usize::MAX, Some(&NO_PICTURE)), None);
        if let Some(drawing) = draw(question, 0, Some(&NO_PICTURE)) {
            assert_well_formed(&drawing);
        }
    }
}
