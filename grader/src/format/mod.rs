//! Output formats for learning platforms and CI services. Each renderer is a pure function of a
//! [`StudentView`] and a [`FormatContext`]. It never gets the score itself, so no format can leak
//! what the policy hides.
//!
//! A format consists of a file that declares its [`FormatSpec`] and an entry in [`FORMATS`].

mod check50;
mod classroom50;
pub mod github;
mod gradescope;
pub mod html;
mod item_text;
mod item_view;
mod json;
mod junit;
pub mod outputs;
mod prairielearn;
mod redact;
mod sentence;
mod size;
mod spec;
mod student_view;
mod text;

pub use item_view::ItemView;
pub use spec::{FormatContext, FormatSpec, MethodLocation, OutputSpec};
pub use student_view::StudentView;

/// All formats, in the order that `--help` lists them.
pub static FORMATS: [&FormatSpec; 9] = [
    &json::FORMAT,
    &text::FORMAT,
    &html::FORMAT,
    &gradescope::FORMAT,
    &classroom50::FORMAT,
    &junit::FORMAT,
    &github::FORMAT,
    &check50::FORMAT,
    &prairielearn::FORMAT,
];

/// Returns a value as JSON, with a newline at the end.
fn to_json(value: &serde_json::Value) -> String {
    format!("{value:#}\n")
}

#[cfg(test)]
mod tests;
