//! Progress bars, since grading many solutions takes long.

use indicatif::{ProgressBar, ProgressStyle};

/// Returns a progress bar for this many units, such as "seeds".
pub(super) fn progress_bar(count: u64, unit: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {pos} of {len} {msg}, {eta} left");
    ProgressBar::new(count)
        .with_style(style.expect("the template is valid"))
        .with_message(unit)
}
