//! The domain of `Camera::sample_ray`.

mod aspects;
mod draw;

use protocol::{PinholeCamera, Question, Sample};

use self::aspects::ASPECTS;
use super::{FunctionDomain, not_asked};

pub use aspects::{ASPECT_RATIOS, FIELDS_OF_VIEW, ROUND_ANGLES};
pub use draw::{
    almost_equal_cameras, almost_usual_cameras, cameras, common_films, drawn, extreme_views,
    films_of_few_pixels, offset, sample, side,
};

/// The domain of `Camera::sample_ray`.
pub static CAMERA: FunctionDomain<CameraCall> = FunctionDomain {
    aspects: &[ASPECTS],
    pairs: &[
        ["angle", "sensor"],
        ["angle", "rows of the film"],
        ["sensor", "columns of the film"],
        ["sensor", "rows of the film"],
    ],
    not_asked: &[not_asked(&[
        "wide pixel",
        "high pixel",
        "round field of view",
        "usual aspect ratio",
        "pixels",
        "film",
        "film of few pixels",
        "film of a common size",
        "view",
        "sample before",
    ])
    .columns(OTHER_QUANTITIES)
    .because("These aspects affect only the ray's direction.")],
    ..FunctionDomain::new("Camera::sample_ray", calls)
};

/// The quantities of a ray other than its direction.
const OTHER_QUANTITIES: &[&str] = &["origin", "range", "unit_direction"];

/// A call to `Camera::sample_ray`.
#[derive(Clone, Copy, Debug)]
pub struct CameraCall {
    camera: PinholeCamera,
    sample: Sample,
    /// The sample of the previous call, if that call was on the same camera.
    before: Option<Sample>,
}

fn calls(question: &Question) -> Vec<CameraCall> {
    let Question::SampleRay(table) = question else {
        return Vec::new();
    };
    let camera = table.subject;
    let rows = table.rows.to_vec();
    let before = std::iter::once(None).chain(rows.iter().copied().map(Some));
    let calls = rows.iter().zip(before).map(|(&sample, before)| CameraCall {
        camera,
        sample,
        before,
    });
    calls.collect()
}
