//! The source files in which the handout's names are looked up.

/// A source file in which names are looked up.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// The path relative to the workspace's root, with `/` as the separator.
    pub path: String,
    /// The complete text of the file.
    pub text: String,
}
