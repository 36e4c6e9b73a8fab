//! The source files in which the handout's names are looked up.

/// A source file.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// The path relative to the workspace's root, with `/` as the separator.
    pub path: String,
    /// The whole text.
    pub text: String,
}
