//! Tests of the captions for directions, densities and colours at surfaces and in maps.

use glam::{UVec2, Vec3, vec2, vec3};
use judging::exam::{ExamQuestion, ExpectedRows, Key};
use protocol::light::LightQuestion;
use protocol::light::environment::{MapImage, RandomPair};
use protocol::light::lambertian::{DirectionPair, Matte};
use protocol::light::specular::{GlassSample, Medium};
use protocol::{Answer, Density, ElementOutcome, LocalDirection, Scattered, Table};

use super::{caption, captions, table};

const OUT: LocalDirection = LocalDirection {
    direction: vec3(0.6, 0.0, 0.8),
};
const REFRACTED: Vec3 = vec3(-0.6, 0.0, -0.8);

fn value<T>(value: T) -> Vec<ElementOutcome<T>> {
    vec![ElementOutcome::Value(value)]
}

/// Returns the captions for directions. Some of the directions shouldn't exist.
pub(super) fn directions() -> String {
    let optional =
        |direction: Option<Vec3>| direction.map(|direction| LocalDirection { direction });
    let exam_question = |wanted: Option<Vec3>| {
        let rows = Table::of_list(Medium { ior: 1.0 }, vec![OUT]);
        table(
            LightQuestion::Refract(rows),
            &["direction", "unit_direction"],
            ExpectedRows::OptionalDirections(vec![optional(wanted)]),
        )
    };
    let answer = |got: Option<Vec3>| Answer::OptionalDirections(value(optional(got)));
    let directions = [
        None,
        Some(-REFRACTED),
        Some(vec3(-0.8, 0.0, -0.6)),
        Some(2.0 * REFRACTED),
        Some(Vec3::NAN),
        Some(REFRACTED),
    ];
    let panicked = Answer::OptionalDirections(vec![ElementOutcome::Skipped]);
    let lines = [
        captions(&exam_question(Some(REFRACTED)), directions.map(answer)),
        caption(&exam_question(Some(REFRACTED)), panicked),
        caption(&exam_question(None), answer(Some(REFRACTED))),
    ];
    lines.join("\n")
}

/// Returns the captions for densities and attenuations.
pub(super) fn values() -> String {
    let pair = DirectionPair {
        out: Vec3::Z,
        incoming: OUT.direction,
    };
    let matte = Matte { albedo: Vec3::ONE };
    let density = table(
        LightQuestion::LambertianPdf(Table::of_list(matte, vec![pair])),
        &["pdf"],
        ExpectedRows::Densities(vec![Density { pdf: 0.25 }]),
    );
    let scattered = Scattered {
        direction: REFRACTED,
        attenuation: Vec3::ONE,
        pdf: None,
    };
    let sample = GlassSample {
        out: OUT.direction,
        random: 0.5,
    };
    let glass = table(
        LightQuestion::GlassScatter(Table::of_list(Medium { ior: 1.0 }, vec![sample])),
        &["direction", "attenuation", "pdf"],
        ExpectedRows::Scattered(vec![scattered]),
    );
    let wrong = [
        Scattered {
            attenuation: Vec3::splat(0.5),
            ..scattered
        },
        Scattered {
            pdf: Some(1.0),
            ..scattered
        },
    ];
    let lines = [
        caption(&density, Answer::Densities(value(Density { pdf: 0.5 }))),
        captions(&glass, wrong.map(|one| Answer::Scattered(value(one)))),
    ];
    lines.join("\n")
}

/// Returns the captions for directions on the whole sphere.
pub(super) fn spheres() -> String {
    let random = vec2(0.5, 0.5);
    let pairs = vec![RandomPair { random }; 128];
    let even = ExamQuestion::new(
        LightQuestion::UniformSphere(Table::of_list((), pairs)).into(),
        Key::SpreadEvenly {
            max_chi_squared: 100.0,
        },
    );
    let map = MapImage {
        size: UVec2::new(2, 1),
        pixels: vec![Vec3::ONE, Vec3::ZERO],
    };
    let density = table(
        LightQuestion::EnvironmentPdf(Table::of_list(map, vec![OUT])),
        &["pdf"],
        ExpectedRows::Densities(vec![Density { pdf: 0.0 }]),
    );
    let all = |direction| {
        let direction = ElementOutcome::Value(LocalDirection { direction });
        Answer::Directions(vec![direction; 128])
    };
    let lines = [
        captions(&even, [Vec3::Y, 0.5 * Vec3::Y, Vec3::NAN].map(all)),
        caption(&density, Answer::Densities(value(Density { pdf: 0.5 }))),
    ];
    lines.join("\n")
}
