//! PrairieLearn's `/grade/results/results.json`
//! (<https://prairielearn.readthedocs.io/en/latest/externalGrading/>, "Grading results").
//!
//! Where nothing compiles the attempt is not gradable, and costs the student no attempt.

use serde_json::{Value, json};

use crate::format::said::{headline, of_files, said, what};
use crate::format::size::{cut, within};
use crate::format::{Around, Seen};

/// What PrairieLearn takes, in bytes, with room to spare.
const MOST: usize = 1_000_000;

/// The whole file.
pub fn text(seen: &Seen, around: &Around) -> String {
    within(MOST, |longest| super::json(&results(seen, around, longest)))
}

fn results(seen: &Seen, around: &Around, longest: usize) -> Value {
    let said_of_files = cut(&of_files(seen), 4 * longest);
    let counted = seen.counted;
    if seen.nothing_compiled() {
        return json!({ "gradable": false, "score": 0.0, "format_errors": [said_of_files] });
    }
    let tests: Vec<Value> = seen
        .lines()
        .map(|(task, item)| {
            json!({
                "name": item.title,
                "description": task.title,
                "points": item.points,
                "max_points": item.max_points,
                "message": cut(&what(item), longest),
                "output": cut(&said(seen, item, around), longest),
            })
        })
        .collect();
    let message = seen.unfinished().unwrap_or_else(|| headline(seen));
    json!({
        "gradable": true,
        "score": f64::from(counted.points) / f64::from(counted.max_points.max(1)),
        "message": message,
        "output": said_of_files,
        "tests": tests,
    })
}
