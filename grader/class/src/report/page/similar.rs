//! The section about submissions that a similarity checker found similar.

use judging::sanitize::sanitize;
use maud::{Markup, html};

use super::submissions::report_link;
use super::{sanitized, section};
use crate::graded_class::GradedClass;
use crate::outcome::id_and_names;
use crate::similar_pairs::SimilarPair;
use crate::table::safe_cell;

/// Renders the pairs. The lines of the two files are shown side by side.
pub(super) fn similar(class: &GradedClass, pairs: &[SimilarPair]) -> Markup {
    let contents = html! {
        p {
            "A similarity checker compared the students' own lines. Code can be similar for "
            "reasons other than copying, so look at each pair yourself. This doesn't affect \
            points."
        }
        @for pair in pairs { (side_by_side(class, pair)) }
    };
    section("similar", "Similar submissions", &contents)
}

fn side_by_side(class: &GradedClass, pair: &SimilarPair) -> Markup {
    let results = pair.files.each_ref().map(|file| {
        let mut results = class.rows.iter().map(|row| &row.result);
        results.find(|result| safe_cell(&result.id) == file.submission)
    });
    let titles = [0, 1].map(|side| match results[side] {
        Some(result) => id_and_names(&result.id, &result.info.display_names()),
        None => format!("{}, no longer in the class", pair.files[side].submission),
    });
    html! {
        details {
            summary {
                (format!("{:.0}%, ", 100.0 * pair.similarity))
                code { (sanitized(&format!("{}.rs", pair.files[0].task))) }
                ": " (sanitized(&titles.join(" and ")))
            }
            div .pair { @for ((file, result), title) in pair.files.iter().zip(results).zip(&titles) {
                @let graded = result.filter(|result| result.score().is_some());
                div {
                    p { a href=[graded.map(|result| report_link(&result.id))] { (sanitized(title)) } }
                    pre tabindex="0" { code { (sanitize(&file.lines, 40_000)) } }
                }
            } }
        }
    }
}
