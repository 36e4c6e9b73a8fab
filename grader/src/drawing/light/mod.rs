//! Draws the questions of part two: directions at a surface, samples and densities seen from above,
//! directions in an environment map, lights seen from a point, and paths.

mod disk;
mod lights;
mod map;
mod path;
mod row;
mod spread;
mod surface;

use judging::drawing_data::DrawingData;
use judging::exam::{ExamQuestion, Key};
use protocol::Answer;
use protocol::light::LightQuestion;

use super::Drawing;
use row::RowComparison;

/// Draws one row of a question about part two. Returns `None` for direct light, where the exam
/// stores only the light that arrives.
pub(super) fn draw(
    table: &LightQuestion,
    question: &ExamQuestion,
    row: usize,
    answer: Option<&Answer>,
) -> Option<Drawing> {
    let comparison = || RowComparison::new(question, row, answer);
    match table {
        LightQuestion::Evaluate(_)
        | LightQuestion::LambertianPdf(_)
        | LightQuestion::LambertianScatter(_) => disk::draw(question, row, answer),
        LightQuestion::Reflect(_)
        | LightQuestion::Refract(_)
        | LightQuestion::Fresnel(_)
        | LightQuestion::MirrorScatter(_)
        | LightQuestion::GlassScatter(_) => surface::draw(&comparison()?),
        LightQuestion::EnvironmentSample(table) => map::draw(&table.subject, &comparison()?),
        LightQuestion::EnvironmentPdf(table) => map::draw(&table.subject, &comparison()?),
        LightQuestion::UniformSphere(_) => {
            if let (Key::SpreadEvenly { .. }, Answer::Directions(answer)) = (&question.key, answer?)
            {
                answer.get(row)?;
                return Some(spread::draw(answer, row));
            }
            None
        }
        LightQuestion::AreaLightPdf(table) => lights::draw(&table.subject.lights, &comparison()?),
        LightQuestion::LightsSample(table) => lights::draw(&table.subject.lights, &comparison()?),
        LightQuestion::LightsPdf(table) => lights::draw(&table.subject.lights, &comparison()?),
        LightQuestion::Radiance(table) => {
            let DrawingData::Paths(paths) = &question.drawing_data else {
                return None;
            };
            path::draw(&table.rows.get(row)?.ray, paths.get(row)?, &comparison()?)
        }
        LightQuestion::Direct(_) => None,
    }
}
