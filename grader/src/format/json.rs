//! The score file, for staff. It is always written to the output folder, so this format has nothing
//! to render.

use crate::format::FormatSpec;

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "json",
    file: "score.json",
    ..FormatSpec::EMPTY
};
