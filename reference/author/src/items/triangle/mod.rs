//! Items of task 2, step 1: triangles.

mod aim;
mod hits;
mod scene;
mod surface;

use aim::{Side, hitting_ray, random_triangle, ray_through, shape, weights_beyond_edge};
use judging::exam::ExamQuestion;
use protocol::{Ray, Vertex};

use crate::items::place::Place;
use crate::items::{DeclaredItem, draw_items};
use crate::seed::{Rng, Seed};

/// Returns the items of the task `triangle`.
pub fn items(seed: Seed) -> Vec<DeclaredItem> {
    let all = [
        hits::INSIDE,
        hits::OUTSIDE,
        surface::POSITION,
        surface::NORMAL,
        surface::UV,
        surface::UV_CORNERS,
        hits::FROM_BEHIND,
        surface::NORMAL_FROM_BEHIND,
        hits::RANGE_MAX,
        hits::RANGE_MIN,
        hits::BEHIND_THE_RAY,
        hits::TINY,
        hits::DEGENERATE,
        surface::ORIGIN_AND_MATERIAL,
        scene::PICTURE,
    ];
    draw_items(seed, &all)
}

/// Creates one question for each of four triangles, with rays that hit the triangle from this side
/// and some rays that miss. The last triangle is as large and as far from the origin as those of the
/// Cornell box.
fn table_questions(rng: &mut Rng, judged: &[&str], side: Side) -> Vec<ExamQuestion> {
    let mut table = || {
        let vertices = random_triangle(rng);
        let mut rays: Vec<Ray> = (0..8).map(|_| hitting_ray(rng, &vertices, side)).collect();
        // These rays pass beyond each edge in turn.
        rays.extend((0..4).map(|i| {
            let weights = weights_beyond_edge(rng, i % 3);
            ray_through(rng, &vertices, weights, side)
        }));
        (shape(&vertices, 0), rng.shuffled(rays))
    };
    let [first, second, third, last] = [table(), table(), table(), table()];
    let last = Place::room(rng).table(&last);
    let question = |(shape, rays)| super::shape_question(judged, shape, rays);
    [first, second, third, last].map(question).to_vec()
}

/// Creates a question about a triangle whose hits are compared by their distances.
fn distance_question(vertices: &[Vertex; 3], rays: impl IntoIterator<Item = Ray>) -> ExamQuestion {
    super::shape_question(&["distance"], shape(vertices, 0), rays)
}
