//! Remarks about all of a ray's tests, taken together.

use view_probe::messages::{RecordedRay, TestCounts};

use super::{Context, ExplainedTest};

/// Returns remarks about all of a ray's tests, taken together.
pub(super) fn remarks(
    ray: &RecordedRay,
    tests: &[ExplainedTest],
    closest: Option<f32>,
    context: &Context,
) -> Vec<String> {
    let mut notes = Vec::new();
    let TestCounts { boxes, primitives } = ray.counts;
    let all = boxes as usize + primitives as usize;
    if tests.len() < all {
        notes.push(format!(
            "Only the first {} of {all} tests are listed.",
            tests.len()
        ));
    }
    match (context.tree.has_nodes(), boxes, primitives) {
        (false, 0, 1..) if !context.is_list => notes.push(
            "There is no tree yet, so `Bvh::hit` tests the primitives one by one.".to_owned(),
        ),
        (true, 0, 1..) => notes.push(
            "`Bvh::hit` never called `BBox::hit`. If it uses the tree in some other way, only the \
             primitive tests can be listed."
                .to_owned(),
        ),
        (true, _, 0) if ray.hit.is_some() => notes.push(
            "`Bvh::hit` found a hit without calling `Primitive::hit`, so the primitive tests \
             cannot be listed."
                .to_owned(),
        ),
        _ => {}
    }
    let again = tests.iter().filter(|test| test.again).count();
    if again > 0 {
        let tests = if again == 1 {
            "test repeats an earlier one"
        } else {
            "tests repeat earlier ones"
        };
        notes.push(format!(
            "{again} {tests}: each primitive is in one leaf, so it needs to be tested only once."
        ));
    }
    // If some tests are missing, the closest hit is unknown.
    if tests.len() == all && primitives > 0 {
        match (closest, ray.hit) {
            (Some(closest), None) => notes.push(format!(
                "A primitive is hit at {closest}, within the ray's range, but `Bvh::hit` returned `None`."
            )),
            (Some(closest), Some(hit)) if hit.distance > closest * (1.0 + 1e-4) => {
                notes.push(format!(
                    "The closest hit found is at {closest}, but `Bvh::hit` returned one at {}.",
                    hit.distance
                ));
            }
            _ => {}
        }
    }
    notes
}
